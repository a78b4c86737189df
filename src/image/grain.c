#include "image/grain.h"

#include "base/color.h"
#include "base/random.h"

#include <math.h>

#define SHARED 0.9f  // of the variance: common to the three layers of emulsion
#define SPREAD 0.15f // of a grain's weight on each of two neighbours along an axis

// Independent normal values for each pixel and channel, of which channels share a part.
static void fill_noise(Image *noise, uint64_t key)
{
    float common = sqrtf(SHARED), own = sqrtf(1.0f - SHARED);
    int64_t count = (int64_t)noise->width * noise->height;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < count; i++) {
        uint64_t pixel = random_key(key, (uint64_t)i);
        float shared = random_normal(random_key(pixel, 3));
        for (int c = 0; c < 3; c++) {
            noise->pixel[3 * i + c] =
                common * shared + own * random_normal(random_key(pixel, (uint64_t)c));
        }
    }
}

static const float *repeat_edge(const Image *noise, int x, int y)
{
    x = x < 0 ? 0 : x >= noise->width ? noise->width - 1 : x;
    y = y < 0 ? 0 : y >= noise->height ? noise->height - 1 : y;
    return noise->pixel + 3 * ((int64_t)y * noise->width + x);
}

// The noise of a pixel and its neighbours, weighted to a variance of 1.
static Vec3 grain_at(const Image *noise, int x, int y)
{
    static const float WEIGHT[3] = {SPREAD, 1.0f - 2.0f * SPREAD, SPREAD};
    const float deviation = 2.0f * SPREAD * SPREAD + WEIGHT[1] * WEIGHT[1];
    Vec3 sum = {0};
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            const float *p = repeat_edge(noise, x + i - 1, y + j - 1);
            sum = vec3_add(sum, vec3_scale(vec3(p[0], p[1], p[2]), WEIGHT[i] * WEIGHT[j]));
        }
    }
    return vec3_scale(sum, 1.0f / deviation);
}

// from, to: a pixel of the image and of the result.
static void add_grain(const float *from, float *to, int channels, float strength, Vec3 grain)
{
    const float add[3] = {grain.x, grain.y, grain.z};
    float luma = clampf(luminance_rgb(from), 0.0f, 1.0f);
    float deviation = strength * sqrtf(8.0f * luma) * (1.0f - luma);
    for (int c = 0; c < channels; c++) {
        to[c] = c < 3 ? clampf(from[c] + deviation * add[c], 0.0f, 1.0f) : from[c];
    }
}

Image *image_grain(const Image *image, float strength, uint64_t key, Error *e)
{
    int channels = image->channels;
    Image *out = image_new(image->width, image->height, channels, e);
    Image *noise = out ? image_new(image->width, image->height, 3, e) : NULL;
    if (!noise) {
        image_free(out);
        return NULL;
    }
    fill_noise(noise, key);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            int64_t at = ((int64_t)y * image->width + x) * channels;
            add_grain(image->pixel + at, out->pixel + at, channels, strength,
                      grain_at(noise, x, y));
        }
    }
    image_free(noise);
    return out;
}
