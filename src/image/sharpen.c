#include "image/sharpen.h"

#include "base/vec.h"

#define STEP (1.0f / 255.0f)
#define OVERSHOOT 0.2f // of the neighbourhood's range

static float luma(const Image *image, int x, int y)
{
    x = x < 0 ? 0 : x >= image->width ? image->width - 1 : x;
    y = y < 0 ? 0 : y >= image->height ? image->height - 1 : y;
    const float *p = image->pixel + ((int64_t)y * image->width + x) * image->channels;
    return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
}

// What sharpening adds to the pixel's luma.
static float detail(const Image *image, int x, int y, float strength)
{
    static const float WEIGHT[3] = {0.25f, 0.5f, 0.25f};
    float own = luma(image, x, y), mean = 0.0f, low = own, high = own;
    for (int j = -1; j <= 1; j++) {
        for (int i = -1; i <= 1; i++) {
            float l = luma(image, x + i, y + j);
            mean += WEIGHT[i + 1] * WEIGHT[j + 1] * l;
            low = l < low ? l : low;
            high = l > high ? l : high;
        }
    }
    float difference = own - mean, size = fabsf(difference);
    difference *= smoothstepf(0.5f * STEP, 2.0f * STEP, size);
    float margin = OVERSHOOT * (high - low);
    return clampf(own + strength * difference, low - margin, high + margin) - own;
}

Image *image_sharpen(const Image *image, float strength, Error *e)
{
    Image *out = image_new(image->width, image->height, image->channels, e);
    if (!out) {
        return NULL;
    }
#pragma omp parallel for schedule(static)
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            int64_t at = ((int64_t)y * image->width + x) * image->channels;
            float add = strength > 0.0f ? detail(image, x, y, strength) : 0.0f;
            for (int c = 0; c < image->channels; c++) {
                float value = image->pixel[at + c];
                out->pixel[at + c] = c < 3 ? clampf(value + add, 0.0f, 1.0f) : value;
            }
        }
    }
    return out;
}
