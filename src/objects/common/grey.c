#include "objects/common/grey.h"

#include "base/vec.h"

Image *grey_read(const char *file, const Run *run, Error *e)
{
    Image *image = image_read(file, run, e);
    if (!image) {
        return NULL;
    }
    int64_t count = (int64_t)image->width * image->height;
    int colours = image->channels < 3 ? 1 : 3;
    for (int64_t i = 0; i < count;
         i++) { // in place: writes stay behind the pixels still to be read
        float sum = 0.0f;
        for (int c = 0; c < colours; c++) {
            sum += image->pixel[i * image->channels + c];
        }
        image->pixel[i] = sum / (float)colours;
    }
    image->channels = 1;
    return image;
}

float grey_at(const Image *grey, float u, float v)
{
    int width = grey->width, height = grey->height;
    float x = clampf(u * (float)width - 0.5f, 0.0f, (float)(width - 1));
    float y = clampf(v * (float)height - 0.5f, 0.0f, (float)(height - 1));
    int column = (int)x, row = (int)y;
    int next_column = column + 1 < width ? column + 1 : column;
    int next_row = row + 1 < height ? row + 1 : row;
    const float *p = grey->pixel;
    float above = lerpf(p[(int64_t)row * width + column], p[(int64_t)row * width + next_column],
                        x - (float)column);
    float below = lerpf(p[(int64_t)next_row * width + column],
                        p[(int64_t)next_row * width + next_column], x - (float)column);
    return lerpf(above, below, y - (float)row);
}
