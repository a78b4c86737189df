#include "image/denoise_guides.h"

#include "base/memory.h"
#include "image/denoise_parts.h"

#include <stdlib.h>
#include <string.h>

enum {
    WINDOW = 4,          // half width of the search window, pixels
    BORDER = WINDOW + 1, // mirrored pixels around the image: window and patch never leave it
    ROWS = 8,            // of a band
    VALUES = 6           // albedo and normal
};

typedef struct Planes {
    int width, height;
    int64_t stride;
    float *data;
    float *value[VALUES];               // address of pixel (0, 0) of each
    float *albedo_noise, *normal_noise; // variances
    float *tolerance;                   // factor on them
} Planes;

static bool planes_new(Planes *p, int width, int height, Error *e)
{
    *p = (Planes){.width = width, .height = height, .stride = width + 2 * BORDER};
    int64_t size = p->stride * (height + 2 * BORDER);
    p->data = memory_alloc(size * (VALUES + 3), sizeof *p->data, e);
    float **plane[VALUES + 3] = {&p->value[0],     &p->value[1],     &p->value[2],
                                 &p->value[3],     &p->value[4],     &p->value[5],
                                 &p->albedo_noise, &p->normal_noise, &p->tolerance};
    for (int k = 0; p->data && k < VALUES + 3; k++) {
        *plane[k] = p->data + size * k + p->stride * BORDER + BORDER;
    }
    return p->data;
}

static void fill_pixel(const Planes *p, const DenoiseInput *g, float strength, int x, int y)
{
    int i = denoise_mirror(x, p->width), j = denoise_mirror(y, p->height);
    int64_t from = (int64_t)j * p->width + i, to = y * p->stride + x;
    for (int c = 0; c < 3; c++) {
        p->value[c][to] = g->albedo->pixel[3 * from + c];
        p->value[3 + c][to] = denoise_finite(g->normal->pixel[3 * from + c]);
    }
    p->albedo_noise[to] = denoise_variance(g->guide_variance, 0, i, j);
    p->normal_noise[to] =
        denoise_variance(g->guide_variance, 1, i, j) * (1.0f / 3.0f); // of a component
    p->tolerance[to] = denoise_tolerance(g->samples ? g->samples->pixel[from] : INFINITY, strength);
}

// Squared difference beyond what the variances explain, relative to them (Rousselle 2012, eq. 2).
static float beyond(float square, float noise0, float noise1, float tolerance)
{
    float least = noise0 < noise1 ? noise0 : noise1;
    return (square - (noise0 + least)) / (1e-6f + tolerance * (noise0 + noise1));
}

// Workspace of a band of rows: sums over neighbours, and distances of rows with a pixel and a row
// more on each side.
typedef struct Band {
    float *sum[VALUES], *weight; // ROWS * width each
    float *distance;             // (ROWS + 2) * (width + 2)
    float *data;
} Band;

static bool band_new(Band *b, int width)
{
    int64_t size = (int64_t)ROWS * width;
    b->data = memory_alloc(size * (VALUES + 1) + (ROWS + 2) * (int64_t)(width + 2), sizeof *b->data,
                           NULL);
    for (int k = 0; b->data && k < VALUES; k++) {
        b->sum[k] = b->data + size * k;
    }
    b->weight = b->data ? b->data + size * VALUES : NULL;
    b->distance = b->data ? b->weight + size : NULL;
    return b->data;
}

static void find_distances(const Planes *p, const Band *b, int y0, int rows, int64_t offset)
{
    for (int row = 0; row < rows + 2; row++) {
        int64_t at = (y0 + row - 1) * p->stride;
        float *restrict out = b->distance + (int64_t)row * (p->width + 2);
        for (int x = -1; x <= p->width; x++) {
            int64_t i = at + x, j = i + offset;
            float albedo = 0.0f, normal = 0.0f;
            for (int c = 0; c < 3; c++) {
                float da = p->value[c][i] - p->value[c][j];
                float dn = p->value[3 + c][i] - p->value[3 + c][j];
                albedo += da * da;
                normal += dn * dn;
            }
            float tolerance = 0.5f * (p->tolerance[i] + p->tolerance[j]);
            float a =
                beyond(albedo * (1.0f / 3.0f), p->albedo_noise[i], p->albedo_noise[j], tolerance);
            float n =
                beyond(normal * (1.0f / 3.0f), p->normal_noise[i], p->normal_noise[j], tolerance);
            out[x + 1] = a > n ? a : n;
        }
    }
}

// Adds a neighbour of each pixel of a band, with weights e^-distance (as (1 - d/8)^8).
static void add_neighbour(const Planes *p, const Band *b, int y0, int rows, int64_t offset)
{
    find_distances(p, b, y0, rows, offset);
    for (int row = 0; row < rows; row++) {
        const float *restrict d = b->distance + (int64_t)row * (p->width + 2);
        int64_t next = p->width + 2, at = (y0 + row) * p->stride + offset;
        int64_t to = (int64_t)row * p->width;
        for (int x = 0; x < p->width; x++) {
            float patch = 0.0f;
            for (int k = 0; k < 3; k++) {
                patch += d[x + k] + d[next + x + k] + d[2 * next + x + k];
            }
            float w = 1.0f - (patch > 0.0f ? patch * (1.0f / 72.0f) : 0.0f);
            w = w > 0.0f ? w : 0.0f;
            w *= w;
            w *= w;
            w *= w;
            b->weight[to + x] += w;
            for (int c = 0; c < VALUES; c++) {
                b->sum[c][to + x] += w * p->value[c][at + x];
            }
        }
    }
}

static void filter_band(const Planes *p, const Band *b, int y0, Image *albedo, Image *normal)
{
    int rows = p->height - y0 < ROWS ? p->height - y0 : ROWS;
    memset(b->data, 0, (size_t)ROWS * (size_t)p->width * (VALUES + 1) * sizeof *b->data);
    for (int k = 0; k < (2 * WINDOW + 1) * (2 * WINDOW + 1); k++) {
        int dx = k % (2 * WINDOW + 1) - WINDOW, dy = k / (2 * WINDOW + 1) - WINDOW;
        add_neighbour(p, b, y0, rows, dy * p->stride + dx);
    }
    for (int64_t i = 0; i < (int64_t)rows * p->width; i++) {
        int64_t at = (y0 + i / p->width) * p->stride + i % p->width;
        int64_t pixel = (int64_t)y0 * p->width + i;
        bool noisy = p->albedo_noise[at] > 0.0f || p->normal_noise[at] > 0.0f;
        for (int c = 0; c < VALUES; c++) {
            Image *out = c < 3 ? albedo : normal;
            out->pixel[3 * pixel + c % 3] = noisy ? b->sum[c][i] / b->weight[i] : p->value[c][at];
        }
    }
}

static bool filter(const Planes *p, const Run *run, Image *albedo, Image *normal, Error *e)
{
    bool short_of_memory = false;
#pragma omp parallel num_threads(run->threads)
    {
        Band band;
        bool made = band_new(&band, p->width);
        if (!made) {
#pragma omp atomic write
            short_of_memory = true;
        }
#pragma omp for schedule(dynamic, 1)
        for (int y = 0; y < p->height; y += ROWS) {
            if (made && !run_is_cancelled(run)) {
                filter_band(p, &band, y, albedo, normal);
            }
        }
        free(band.data);
    }
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    return !short_of_memory || error_set(e, ERROR_MEMORY, "out of memory while denoising");
}

bool denoise_guides(const DenoiseInput *input, float strength, const Run *run, Image **albedo,
                    Image **normal, Error *e)
{
    int width = input->color->width, height = input->color->height;
    *albedo = image_new(width, height, 3, e);
    *normal = *albedo ? image_new(width, height, 3, e) : NULL;
    Planes planes = {0};
    bool done = *normal && planes_new(&planes, width, height, e);
    if (done) {
#pragma omp parallel for num_threads(run->threads) schedule(static)
        for (int y = -BORDER; y < height + BORDER; y++) {
            for (int x = -BORDER; x < width + BORDER; x++) {
                fill_pixel(&planes, input, strength, x, y);
            }
        }
        done = filter(&planes, run, *albedo, *normal, e);
    }
    free(planes.data);
    if (!done) {
        image_free(*albedo);
        image_free(*normal);
    }
    return done;
}
