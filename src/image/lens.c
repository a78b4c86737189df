#include "image/lens.h"

#include <math.h>
#include <string.h>

// Mirrors an index at the borders, so that light blurred out of the image returns.
static int mirror(int i, int count)
{
    int period = 2 * count;
    i %= period;
    i = i < 0 ? i + period : i;
    return i < count ? i : period - 1 - i;
}

// Running mean of 2 radius + 1 entries over count entries of 3 channels, `stride` floats apart.
static void blur_line(const float *in, float *out, int count, int64_t stride, int radius)
{
    double sum[3] = {0.0, 0.0, 0.0};
    double scale = 1.0 / (2.0 * radius + 1.0);
    int period = 2 * count, periods = (2 * radius + 1) / period; // 0 unless the image is narrow
    for (int i = 0; i < count && periods > 0; i++) {             // which holds each entry twice
        for (int c = 0; c < 3; c++) {
            sum[c] += 2.0 * periods * (double)in[i * stride + c];
        }
    }
    for (int i = -radius; i <= radius - periods * period; i++) {
        const float *p = in + mirror(i, count) * stride;
        for (int c = 0; c < 3; c++) {
            sum[c] += (double)p[c];
        }
    }
    for (int i = 0; i < count; i++) {
        const float *enters = in + mirror(i + radius + 1, count) * stride;
        const float *leaves = in + mirror(i - radius, count) * stride;
        for (int c = 0; c < 3; c++) {
            out[i * stride + c] = (float)(sum[c] * scale);
            sum[c] += (double)enters[c] - (double)leaves[c];
        }
    }
}

static void blur_rows(const Image *in, Image *out, int radius)
{
#pragma omp parallel for schedule(static)
    for (int y = 0; y < in->height; y++) {
        int64_t row = (int64_t)y * in->width * in->channels;
        blur_line(in->pixel + row, out->pixel + row, in->width, in->channels, radius);
    }
}

static void blur_columns(const Image *in, Image *out, int radius)
{
#pragma omp parallel for schedule(static)
    for (int x = 0; x < in->width; x++) {
        int64_t column = (int64_t)x * in->channels;
        blur_line(in->pixel + column, out->pixel + column, in->height,
                  (int64_t)in->width * in->channels, radius);
    }
}

// Three box blurs in each direction approximate a Gaussian.
static void blur(Image *image, Image *scratch, int radius)
{
    for (int pass = 0; pass < 3; pass++) {
        blur_rows(image, scratch, radius);
        blur_columns(scratch, image, radius);
    }
}

static void add_scaled(Image *sum, const Image *image, float scale)
{
    int64_t count = (int64_t)sum->width * sum->height;
    for (int64_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            sum->pixel[i * sum->channels + c] += scale * image->pixel[i * sum->channels + c];
        }
    }
}

static void add_colors(Image *sum, const Image *image)
{
    int64_t count = (int64_t)sum->width * sum->height;
    for (int64_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            sum->pixel[i * sum->channels + c] += image->pixel[i * image->channels + c];
        }
    }
}

bool lens_bloom(Image *image, const Image *excess, float share, Error *e)
{
    static const float width[3] = {0.003f, 0.012f, 0.05f}; // relative to the image's height
    static const float weight[3] = {0.5f, 0.3f, 0.2f};
    Image *blurred = image_new(image->width, image->height, image->channels, e);
    Image *scratch = image_new(image->width, image->height, image->channels, e);
    bool done = blurred && scratch;
    if (done) {
        size_t bytes =
            (size_t)image->width * (size_t)image->height * (size_t)image->channels * sizeof(float);
        memcpy(blurred->pixel, image->pixel, bytes);
        if (excess) {
            add_colors(blurred, excess);
        }
        int64_t count = (int64_t)image->width * image->height;
        for (int64_t i = 0; i < count; i++) {
            for (int c = 0; c < 3; c++) {
                image->pixel[i * image->channels + c] *= 1.0f - share;
            }
        }
        for (int k = 0; k < 3; k++) { // each blur starts from the previous one, so widths add up
            int radius = (int)fmaxf(1.0f, roundf(width[k] * (float)image->height));
            blur(blurred, scratch, radius);
            add_scaled(image, blurred, share * weight[k]);
        }
    }
    image_free(blurred);
    image_free(scratch);
    return done;
}

float lens_vignette(const Image *image, int x, int y, float strength)
{
    float half_width = 0.5f * (float)image->width, half_height = 0.5f * (float)image->height;
    float dx = (float)x + 0.5f - half_width, dy = (float)y + 0.5f - half_height;
    float r2 = (dx * dx + dy * dy) / (half_width * half_width + half_height * half_height);
    // cos^4 of an angle, with the tangent that gives 1 - strength in the corners
    float tangent2 = 1.0f / sqrtf(fmaxf(1.0f - strength, 0.01f)) - 1.0f;
    float cosine2 = 1.0f / (1.0f + tangent2 * r2);
    return cosine2 * cosine2;
}
