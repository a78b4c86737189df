#include "image/downsample.h"

#include "image/tone_curve.h"

// The mean of the factor x factor pixels whose first is at `first`.
static void mean_of(const Image *image, const float *first, int factor, float *out)
{
    int channels = image->channels;
    float sum[3] = {0.0f, 0.0f, 0.0f}, cover = 0.0f;
    for (int i = 0; i < factor * factor; i++) {
        int64_t pixel = (int64_t)(i / factor) * image->width + i % factor;
        const float *p = first + pixel * channels;
        float alpha = channels == 4 ? p[3] : 1.0f;
        for (int c = 0; c < 3; c++) {
            sum[c] += alpha * tone_linear_from_srgb(p[c]);
        }
        cover += alpha;
    }
    for (int c = 0; c < 3; c++) {
        out[c] = cover > 0.0f ? tone_srgb_from_linear(sum[c] / cover) : 0.0f;
    }
    if (channels == 4) {
        out[3] = cover / (float)(factor * factor);
    }
}

Image *image_downsample(const Image *image, int factor, Error *e)
{
    int width = image->width / factor, height = image->height / factor;
    Image *out = image_new(width, height, image->channels, e);
    if (!out) {
        return NULL;
    }
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            int64_t first = ((int64_t)y * image->width + x) * factor;
            mean_of(image, image->pixel + first * image->channels, factor,
                    out->pixel + ((int64_t)y * width + x) * image->channels);
        }
    }
    return out;
}
