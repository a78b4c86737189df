#include "golden/heat.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define BLOCK_SCALE 6.0f         // z; a difference by chance seldom reaches 5
#define SHARE_IN_SCALE 0.999     // of the pixels
#define MIN_SCALE (2.0 / 255.0f) // below that, only rounding to 8 bits is visible

// Colour of a value in -1..1.
static void heat_color(float value, float *rgb)
{
    static const float white[3] = {0.97f, 0.97f, 0.97f}, red[3] = {0.7f, 0.04f, 0.1f},
                       blue[3] = {0.06f, 0.25f, 0.68f};
    float v = isnan(value) ? 1.0f : fminf(fabsf(value), 1.0f);
    const float *end = value < 0.0f ? blue : red;
    for (int c = 0; c < 3; c++) {
        rgb[c] = white[c] + (end[c] - white[c]) * sqrtf(v); // the root keeps faint differences
                                                            // visible
    }
}

static float largest_of_pixel(const float *a, const float *b)
{
    float largest = 0.0f;
    for (int c = 0; c < 3; c++) {
        float d = a[c] - b[c];
        largest = isnan(d) || fabsf(d) > fabsf(largest) ? d : largest;
    }
    return largest;
}

static int by_size(const void *x, const void *y)
{
    float a = *(const float *)x, b = *(const float *)y;
    return a < b ? -1 : a > b;
}

// Rounds up to 1, 2 or 5 times a power of ten.
static double rounded_up(double value)
{
    double power = pow(10.0, floor(log10(value)));
    const double steps[] = {1.0, 2.0, 5.0};
    for (int i = 0; i < 3; i++) {
        if (value <= steps[i] * power * (1.0 + 1e-9)) {
            return steps[i] * power;
        }
    }
    return 10.0 * power;
}

// Colour scale of these differences, which it sorts.
static double scale_of(float *sizes, int64_t count)
{
    qsort(sizes, (size_t)count, sizeof *sizes, by_size);
    double most = (double)sizes[(int64_t)(SHARE_IN_SCALE * (double)(count - 1))];
    return most > MIN_SCALE ? rounded_up(fmin(most, 1.0)) : rounded_up(MIN_SCALE);
}

Image *heat_of_difference(const Image *ours, const Image *stored, double *scale, Error *e)
{
    int64_t count = (int64_t)ours->width * ours->height;
    float *sizes = memory_alloc(count, sizeof *sizes, e);
    Image *heat = sizes ? image_new(ours->width, ours->height, 3, e) : NULL;
    for (int64_t i = 0; heat && i < count; i++) {
        float d = largest_of_pixel(ours->pixel + 3 * i, stored->pixel + 3 * i);
        sizes[i] = isnan(d) ? 1.0f : fabsf(d);
    }
    *scale = heat ? scale_of(sizes, count) : 1.0;
    for (int64_t i = 0; heat && i < count; i++) {
        float d = largest_of_pixel(ours->pixel + 3 * i, stored->pixel + 3 * i);
        heat_color(d / (float)*scale, heat->pixel + 3 * i);
    }
    free(sizes);
    return heat;
}

Image *heat_of_blocks(const Image *z, int block, int width, int height, double *scale, Error *e)
{
    Image *heat = image_new(width, height, 3, e);
    *scale = (double)BLOCK_SCALE;
    for (int y = 0; heat && y < height; y++) {
        for (int x = 0; x < width; x++) {
            float value = z->pixel[(int64_t)(y / block) * z->width + x / block];
            heat_color(value / BLOCK_SCALE, heat->pixel + 3 * ((int64_t)y * width + x));
        }
    }
    return heat;
}
