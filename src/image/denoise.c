// Denoising at several scales. The filter's window removes noise of some pixels' width; what is
// wider stays, as blotches in fog and clouds. The input is therefore also denoised at half its
// size, where blotches are as narrow as grain, and again at half of that, and each scale takes its
// low frequencies from the one below (Delbracio 2014).
#include "image/denoise.h"

#include "base/color.h"
#include "image/denoise_guides.h"
#include "image/denoise_parts.h"

#include <math.h>
#include <string.h>

enum {
    SCALES = 3,
    LEAST_SIDE = 16 // pixels: smaller scales are left out
};

// Variances of a block's mean by which its correction may differ, squared: what noise cannot
// explain is detail that the scale below has lost.
#define EXPLAINED 0.15f

// An input at half the size: means over blocks of 2 x 2 pixels. Owned.
typedef struct Half {
    Image *color, *albedo, *normal, *depth, *variance;
    Image *samples; // NULL if they are not known
} Half;

// Sums over a block; color and variance are divided by the albedo.
typedef struct Block {
    float color[3], albedo[3], normal[3], depth, variance, samples;
    int count, hit; // pixels; those with a depth
} Block;

static void half_clear(Half *h)
{
    image_free(h->color);
    image_free(h->albedo);
    image_free(h->normal);
    image_free(h->depth);
    image_free(h->variance);
    image_free(h->samples);
}

static bool half_new(Half *h, const DenoiseInput *g, Error *e)
{
    int width = (g->color->width + 1) / 2, height = (g->color->height + 1) / 2;
    *h = (Half){0};
    return (h->color = image_new(width, height, 3, e)) &&
           (h->albedo = image_new(width, height, 3, e)) &&
           (h->normal = image_new(width, height, 3, e)) &&
           (h->depth = image_new(width, height, 1, e)) &&
           (h->variance = image_new(width, height, 1, e)) &&
           (!g->samples || (h->samples = image_new(width, height, 1, e)));
}

static void add_pixel(Block *b, const DenoiseInput *g, int64_t at)
{
    float divisor[3];
    denoise_divisor(g->albedo->pixel + 3 * at, divisor);
    float scale = luminance_rgb(divisor), depth = g->depth->pixel[at];
    for (int c = 0; c < 3; c++) {
        b->color[c] += denoise_finite(g->color->pixel[at * g->color->channels + c]) / divisor[c];
        b->albedo[c] += g->albedo->pixel[3 * at + c];
        b->normal[c] += denoise_finite(g->normal->pixel[3 * at + c]);
    }
    b->variance += denoise_finite(g->variance->pixel[at]) / (scale * scale);
    b->samples += g->samples ? g->samples->pixel[at] : 0.0f;
    b->depth += denoise_finite(depth);
    b->hit += isfinite(depth);
    b->count++;
}

static void set_half_pixel(const Half *h, const Block *b, int64_t to)
{
    float divisor[3], count = (float)b->count;
    for (int c = 0; c < 3; c++) {
        h->albedo->pixel[3 * to + c] = b->albedo[c] / count;
        h->normal->pixel[3 * to + c] = b->normal[c] / count;
    }
    denoise_divisor(h->albedo->pixel + 3 * to, divisor);
    float scale = luminance_rgb(divisor);
    for (int c = 0; c < 3; c++) {
        h->color->pixel[3 * to + c] = b->color[c] / count * divisor[c];
    }
    h->variance->pixel[to] = b->variance / (count * count) * scale * scale;
    h->depth->pixel[to] = 2 * b->hit >= b->count ? b->depth / (float)b->hit : INFINITY;
    if (h->samples) {
        h->samples->pixel[to] = b->samples;
    }
}

static void fill_half(const Half *h, const DenoiseInput *g, const Run *run)
{
    int width = h->color->width, height = h->color->height;
#pragma omp parallel for num_threads(run->threads) schedule(static)
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            Block block = {0};
            for (int k = 0; k < 4; k++) {
                int i = 2 * x + k % 2, j = 2 * y + k / 2;
                if (i < g->color->width && j < g->color->height) {
                    add_pixel(&block, g, (int64_t)j * g->color->width + i);
                }
            }
            set_half_pixel(h, &block, (int64_t)y * width + x);
        }
    }
}

// What a block's mean over albedo lacks, as far as its noise explains it, and behind it what it is
// at the scale below. fine: denoised at the full size.
static void find_correction(const DenoiseInput *g, const Half *h, const Image *fine,
                            const Image *coarse, int x, int y, float correction[6])
{
    float mean[3] = {0}, divisor[3], weight[3], count = 0.0f;
    for (int k = 0; k < 4; k++) {
        int i = 2 * x + k % 2, j = 2 * y + k / 2;
        if (i < fine->width && j < fine->height) {
            int64_t at = (int64_t)j * fine->width + i;
            denoise_divisor(g->albedo->pixel + 3 * at, divisor);
            for (int c = 0; c < 3; c++) {
                mean[c] += fine->pixel[at * fine->channels + c] / divisor[c];
            }
            count++;
        }
    }
    int64_t block = (int64_t)y * coarse->width + x;
    denoise_divisor(h->albedo->pixel + 3 * block, divisor);
    denoise_weights(divisor, weight);
    float square = 0.0f, scale = luminance_rgb(divisor);
    for (int c = 0; c < 3; c++) {
        correction[3 + c] = coarse->pixel[3 * block + c] / divisor[c];
        correction[c] = correction[3 + c] - mean[c] / count;
        square += weight[c] * correction[c] * correction[c] * (1.0f / 3.0f);
    }
    float variance = denoise_variance(h->variance, 0, x, y) / (scale * scale);
    float kept = expf(-square / (EXPLAINED * variance + 1e-20f));
    for (int c = 0; c < 3; c++) {
        correction[c] *= kept;
    }
}

// Adds corrections, interpolated between the middles of blocks, to a pixel: what is darker than
// the scale below is not darkened further, as beside a glint that its block has too much of.
static void correct_pixel(const DenoiseInput *g, const Image *correction, int x, int y, Image *fine)
{
    int64_t at = (int64_t)y * fine->width + x;
    int column[2] = {x / 2, denoise_mirror(x / 2 + (x % 2 ? 1 : -1), correction->width)};
    int row[2] = {y / 2, denoise_mirror(y / 2 + (y % 2 ? 1 : -1), correction->height)};
    float divisor[3], sum[6] = {0};
    for (int k = 0; k < 4; k++) {
        int64_t block = (int64_t)row[k / 2] * correction->width + column[k % 2];
        float share = (k % 2 ? 0.25f : 0.75f) * (k / 2 ? 0.25f : 0.75f);
        for (int c = 0; c < 6; c++) {
            sum[c] += share * correction->pixel[6 * block + c];
        }
    }
    denoise_divisor(g->albedo->pixel + 3 * at, divisor);
    for (int c = 0; c < 3 && g->variance->pixel[at] > 0.0f; c++) {
        float *to = fine->pixel + at * fine->channels + c;
        float floor = fminf(*to, divisor[c] * sum[3 + c]);
        *to = fmaxf(*to + divisor[c] * sum[c], fmaxf(floor, 0.0f));
    }
}

static bool correct(const DenoiseInput *g, const Half *h, const Image *coarse, const Run *run,
                    Image *fine, Error *e)
{
    Image *correction = image_new(coarse->width, coarse->height, 6, e);
    if (!correction) {
        return false;
    }
#pragma omp parallel num_threads(run->threads)
    {
#pragma omp for schedule(static)
        for (int y = 0; y < coarse->height; y++) {
            for (int x = 0; x < coarse->width; x++) {
                int64_t block = (int64_t)y * coarse->width + x;
                find_correction(g, h, fine, coarse, x, y, correction->pixel + 6 * block);
            }
        }
#pragma omp for schedule(static)
        for (int y = 0; y < fine->height; y++) {
            for (int x = 0; x < fine->width; x++) {
                correct_pixel(g, correction, x, y, fine);
            }
        }
    }
    image_free(correction);
    return true;
}

static Image *denoise_scales(const DenoiseInput *g, int scales, float strength, const Run *run,
                             Error *e)
{
    Image *fine = denoise_filter(g, strength, run, e);
    if (!fine || scales == 1 || fine->width < 2 * LEAST_SIDE || fine->height < 2 * LEAST_SIDE) {
        return fine;
    }
    Half half;
    Image *coarse = NULL;
    if (half_new(&half, g, e)) {
        fill_half(&half, g, run);
        DenoiseInput smaller = {.color = half.color,
                                .albedo = half.albedo,
                                .normal = half.normal,
                                .depth = half.depth,
                                .variance = half.variance,
                                .samples = half.samples};
        coarse = denoise_scales(&smaller, scales - 1, strength, run, e);
    }
    bool done = coarse && correct(g, &half, coarse, run, fine, e);
    image_free(coarse);
    half_clear(&half);
    if (!done) {
        image_free(fine);
        return NULL;
    }
    return fine;
}

static bool fits(const Image *color, const Image *guide, int channels)
{
    return guide->width == color->width && guide->height == color->height &&
           guide->channels == channels;
}

static bool check_input(const DenoiseInput *g, Error *e)
{
    bool good = g->color->channels == 3 || g->color->channels == 4;
    good = good && fits(g->color, g->albedo, 3) && fits(g->color, g->normal, 3);
    good = good && fits(g->color, g->depth, 1) && fits(g->color, g->variance, 1);
    good = good && (!g->samples || fits(g->color, g->samples, 1));
    good = good && (!g->guide_variance || fits(g->color, g->guide_variance, 2));
    return good || error_set(e, ERROR_INPUT,
                             "cannot denoise: color, albedo, normal, depth, variance, samples and "
                             "guide variance must be of one size and have 3 or 4, 3, 3, 1, 1, 1 "
                             "and 2 channels");
}

static Image *copy_of(const Image *color, Error *e)
{
    Image *copy = image_new(color->width, color->height, color->channels, e);
    int64_t size = (int64_t)color->width * color->height * color->channels;
    if (copy) {
        memcpy(copy->pixel, color->pixel, (size_t)size * sizeof(float));
    }
    return copy;
}

// With guides that are free of noise.
static Image *denoise_guided(const DenoiseInput *input, float strength, const Run *run, Error *e)
{
    Image *albedo, *normal;
    if (!denoise_guides(input, strength, run, &albedo, &normal, e)) {
        return NULL;
    }
    DenoiseInput guided = *input;
    guided.albedo = albedo;
    guided.normal = normal;
    Image *clean = denoise_scales(&guided, SCALES, strength, run, e);
    image_free(albedo);
    image_free(normal);
    return clean;
}

Image *image_denoise(const DenoiseInput *input, float strength, const Run *run, Error *e)
{
    if (!check_input(input, e)) {
        return NULL;
    }
    if (strength <= 0.0f) {
        return copy_of(input->color, e);
    }
    return input->guide_variance ? denoise_guided(input, strength, run, e)
                                 : denoise_scales(input, SCALES, strength, run, e);
}
