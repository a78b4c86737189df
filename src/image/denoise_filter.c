#include "base/color.h"
#include "base/memory.h"
#include "image/denoise_parts.h"
#include "image/regression.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    WINDOW = 7,          // half width of the search window, pixels
    BORDER = WINDOW + 1, // mirrored pixels around the image: window and patch never leave it
    NEIGHBOURS = (2 * WINDOW + 1) * (2 * WINDOW + 1),
    ROWS = 4, // of a tile, which is LANES pixels wide
    CANDIDATES = 2
};

// Divisors of color distances: the first candidate looks for neighbours of the same color, the
// second leaves nearly all to the guides.
static const float WIDER[CANDIDATES] = {1.25f, 16.0f};
#define RIDGE 0.2f // of the regression

// Per-pixel features, in planes of floats with a border.
enum {
    PLANE_COLOR,        // 3: radiance over albedo
    PLANE_VARIANCE = 3, // of each
    PLANE_TOLERANCE,    // k^2 times the variance
    PLANE_ALBEDO,       // 3
    PLANE_NORMAL = 8,   // 3
    PLANE_DEPTH = 11,   // logarithm of m; 0 is 1 m
    PLANE_SLACK,        // square of the depth difference allowed between neighbouring pixels
    PLANE_WEIGHT,       // 3: of the channels' squared differences
    PLANE_RESULT = PLANE_WEIGHT + 3,            // 3 of each candidate
    PLANE_GAIN = PLANE_RESULT + 3 * CANDIDATES, // of the second over the first, estimated
    PLANE_COUNT
};

typedef struct Planes {
    int width, height; // of the image
    int64_t stride;    // floats between rows
    float *data;
    float *plane[PLANE_COUNT]; // address of pixel (0, 0) of each; whole tiles of pixels
} Planes;

static bool planes_new(Planes *p, int width, int height, Error *e)
{
    p->width = width;
    p->height = height;
    p->stride = (width + LANES - 1) / LANES * LANES + 2 * BORDER;
    int64_t size = p->stride * (height + 2 * BORDER);
    p->data = memory_alloc(size * PLANE_COUNT, sizeof *p->data, e);
    for (int k = 0; p->data && k < PLANE_COUNT; k++) {
        p->plane[k] = p->data + size * k + p->stride * BORDER + BORDER;
    }
    return p->data != NULL;
}

static float log_depth(const Image *depth, int x, int y)
{
    float z = depth->pixel[(int64_t)denoise_mirror(y, depth->height) * depth->width +
                           denoise_mirror(x, depth->width)];
    return isfinite(z) ? logf(fmaxf(z, 1e-3f)) : 20.0f; // beyond any surface: the sky
}

static void fill_pixel(const Planes *p, const DenoiseInput *g, float strength, int x, int y)
{
    int i = denoise_mirror(x, p->width), j = denoise_mirror(y, p->height);
    int64_t from = (int64_t)j * p->width + i, to = (int64_t)y * p->stride + x;
    const float *albedo = g->albedo->pixel + 3 * from;
    float divisor[3], weight[3];
    denoise_divisor(albedo, divisor);
    denoise_weights(divisor, weight);
    float scale = luminance_rgb(divisor);
    for (int c = 0; c < 3; c++) {
        float radiance = denoise_finite(g->color->pixel[from * g->color->channels + c]);
        p->plane[PLANE_COLOR + c][to] = radiance / divisor[c];
        p->plane[PLANE_WEIGHT + c][to] = weight[c];
        p->plane[PLANE_ALBEDO + c][to] = albedo[c];
        p->plane[PLANE_NORMAL + c][to] = denoise_finite(g->normal->pixel[3 * from + c]);
    }
    float variance = denoise_variance(g->variance, 0, i, j) / (scale * scale);
    float samples = g->samples ? g->samples->pixel[from] : INFINITY;
    p->plane[PLANE_VARIANCE][to] = variance;
    p->plane[PLANE_TOLERANCE][to] = denoise_tolerance(samples, strength) * variance;
    float z = log_depth(g->depth, i, j);
    float dx =
        fminf(fabsf(log_depth(g->depth, i + 1, j) - z), fabsf(log_depth(g->depth, i - 1, j) - z));
    float dy =
        fminf(fabsf(log_depth(g->depth, i, j + 1) - z), fabsf(log_depth(g->depth, i, j - 1) - z));
    p->plane[PLANE_DEPTH][to] = z;
    p->plane[PLANE_SLACK][to] = 0.01f * 0.01f + 4.0f * (dx * dx + dy * dy);
}

// Workspace of one tile. Rows of distances have a pixel more on each side, and one row above and
// below.
typedef struct Tile {
    float distance[ROWS + 2][LANES + 2];
    Lane across[ROWS + 2];
    Lane weight[ROWS][CANDIDATES][NEIGHBOURS];
    Lane feature[FEATURES];
    Regression fit;
    Lane sum[3], shares, own; // of the result; the pixel's own share
} Tile;

// Squared colour differences beyond what the variances explain, relative to those variances
// (Rousselle 2012, eq. 2), for a row of a tile; at: its first pixel, offset: to the other.
static void color_distances(const Planes *p, int64_t at, int64_t offset, float out[LANES + 2])
{
    const float *restrict a = p->plane[PLANE_COLOR] + at;
    const float *restrict b = p->plane[PLANE_COLOR + 1] + at;
    const float *restrict c = p->plane[PLANE_COLOR + 2] + at;
    const float *restrict v = p->plane[PLANE_VARIANCE] + at;
    const float *restrict t = p->plane[PLANE_TOLERANCE] + at;
    const float *restrict wa = p->plane[PLANE_WEIGHT] + at;
    const float *restrict wb = p->plane[PLANE_WEIGHT + 1] + at;
    const float *restrict wc = p->plane[PLANE_WEIGHT + 2] + at;
    for (int x = -1; x <= LANES; x++) {
        float da = a[x] - a[x + offset], db = b[x] - b[x + offset], dc = c[x] - c[x + offset];
        float v0 = v[x], v1 = v[x + offset], least = v0 < v1 ? v0 : v1;
        float square = (wa[x] * da * da + wb[x] * db * db + wc[x] * dc * dc) * (1.0f / 3.0f);
        out[x + 1] = (square - (v0 + least)) / (1e-10f + (t[x] + t[x + offset]));
    }
}

static void sum_across(const float in[LANES + 2], Lane out)
{
    for (int x = 0; x < LANES; x++) {
        out[x] = in[x] + in[x + 1] + in[x + 2];
    }
}

// Squared feature differences of a row, relative to their bandwidths: wide ones, because the fit
// follows albedo and normal.
static void feature_distances(const Planes *p, int64_t at, int64_t offset, Lane out)
{
    const float *restrict plane[PLANE_COUNT];
    for (int k = 0; k < PLANE_COUNT; k++) {
        plane[k] = p->plane[k] + at;
    }
    const float albedo_scale = 1.0f / (0.3f * 0.3f), normal_scale = 1.0f / (0.5f * 0.5f);
    for (int x = 0; x < LANES; x++) {
        int64_t q = x + offset;
        float a = plane[PLANE_ALBEDO][x] - plane[PLANE_ALBEDO][q];
        float b = plane[PLANE_ALBEDO + 1][x] - plane[PLANE_ALBEDO + 1][q];
        float c = plane[PLANE_ALBEDO + 2][x] - plane[PLANE_ALBEDO + 2][q];
        float d = plane[PLANE_NORMAL][x] - plane[PLANE_NORMAL][q];
        float e = plane[PLANE_NORMAL + 1][x] - plane[PLANE_NORMAL + 1][q];
        float f = plane[PLANE_NORMAL + 2][x] - plane[PLANE_NORMAL + 2][q];
        float z = plane[PLANE_DEPTH][x] - plane[PLANE_DEPTH][q];
        out[x] = (a * a + b * b + c * c) * albedo_scale + (d * d + e * e + f * f) * normal_scale +
                 z * z / (plane[PLANE_SLACK][x] + plane[PLANE_SLACK][q]);
    }
}

// Weights e^-distance (as (1 - d/8)^8, which has finite support).
static void weigh(Tile *t, int row, int neighbour, const Lane feature, float away)
{
    for (int k = 0; k < CANDIDATES; k++) {
        float scale = 1.0f / (9.0f * WIDER[k]);
        float *restrict weight = t->weight[row][k][neighbour];
        for (int x = 0; x < LANES; x++) {
            float patch = t->across[row][x] + t->across[row + 1][x] + t->across[row + 2][x];
            float d = (patch > 0.0f ? patch * scale : 0.0f) + feature[x] + away;
            d = 1.0f - d * 0.125f;
            d = d > 0.0f ? d : 0.0f;
            d *= d;
            d *= d;
            d *= d;
            weight[x] = d;
        }
    }
}

static int64_t offset_of(const Planes *p, int neighbour, int *dx, int *dy)
{
    *dx = neighbour % (2 * WINDOW + 1) - WINDOW;
    *dy = neighbour / (2 * WINDOW + 1) - WINDOW;
    return *dy * p->stride + *dx;
}

static void weigh_neighbour(const Planes *p, Tile *t, int64_t at, int rows, int neighbour)
{
    int dx, dy;
    int64_t offset = offset_of(p, neighbour, &dx, &dy);
    float away = (float)(dx * dx + dy * dy) / (WINDOW * WINDOW); // an outlier leaves no square
    for (int row = 0; row < rows + 2; row++) {
        color_distances(p, at + (row - 1) * p->stride, offset, t->distance[row]);
        sum_across(t->distance[row], t->across[row]);
    }
    for (int row = 0; row < rows; row++) {
        Lane feature;
        feature_distances(p, at + row * p->stride, offset, feature);
        weigh(t, row, neighbour, feature, away);
    }
}

// What the fit is linear in: place on the screen, albedo and normal, less the pixel's own.
static int64_t set_features(const Planes *p, Tile *t, int64_t at, int neighbour)
{
    int dx, dy;
    int64_t offset = offset_of(p, neighbour, &dx, &dy);
    for (int x = 0; x < LANES; x++) {
        t->feature[0][x] = (float)dx / WINDOW;
        t->feature[1][x] = (float)dy / WINDOW;
    }
    for (int k = 0; k < 6; k++) {
        const float *plane = p->plane[PLANE_ALBEDO + k] + at;
        for (int x = 0; x < LANES; x++) {
            t->feature[2 + k][x] = plane[x + offset] - plane[x];
        }
    }
    return offset;
}

static void fit_row(const Planes *p, Tile *t, int64_t at, const Lane weight[NEIGHBOURS])
{
    regression_clear(&t->fit);
    for (int i = 0; i < NEIGHBOURS; i++) {
        set_features(p, t, at, i);
        regression_add(&t->fit, weight[i], t->feature);
    }
    regression_solve(&t->fit, RIDGE);
    memset(t->sum, 0, sizeof t->sum);
    memset(t->shares, 0, sizeof t->shares);
    for (int i = 0; i < NEIGHBOURS; i++) {
        int64_t offset = set_features(p, t, at, i);
        Lane share;
        regression_share(&t->fit, weight[i], t->feature, share);
        for (int x = 0; x < LANES; x++) {
            t->shares[x] += share[x];
        }
        for (int c = 0; c < 3; c++) {
            const float *restrict color = p->plane[PLANE_COLOR + c] + at + offset;
            for (int x = 0; x < LANES; x++) {
                t->sum[c][x] += share[x] * color[x];
            }
        }
        if (i == NEIGHBOURS / 2) {
            memcpy(t->own, share, sizeof share);
        }
    }
}

// Writes a candidate's result and adds its squared error with the sign: Stein's unbiased estimate
// (Stein 1981; Li 2012), but for the variance, which all candidates have in common.
static void write_candidate(const Planes *p, const Tile *t, int64_t at, int candidate, float sign)
{
    float *restrict gain = p->plane[PLANE_GAIN] + at;
    Lane error = {0};
    for (int c = 0; c < 3; c++) {
        float *restrict to = p->plane[PLANE_RESULT + 3 * candidate + c] + at;
        const float *restrict color = p->plane[PLANE_COLOR + c] + at;
        const float *restrict weight = p->plane[PLANE_WEIGHT + c] + at;
        for (int x = 0; x < LANES; x++) {
            to[x] = t->sum[c][x] / t->shares[x];
            error[x] += weight[x] * (to[x] - color[x]) * (to[x] - color[x]) * (1.0f / 3.0f);
        }
    }
    const float *restrict v = p->plane[PLANE_VARIANCE] + at;
    for (int x = 0; x < LANES; x++) {
        float estimate = error[x] + 2.0f * v[x] * t->own[x] / t->shares[x];
        gain[x] += sign * (estimate < 20.0f * v[x] ? estimate : 20.0f * v[x]); // tames outliers
    }
}

static void filter_tile(const Planes *p, Tile *t, int x0, int y0)
{
    int rows = p->height - y0 < ROWS ? p->height - y0 : ROWS;
    int64_t at = y0 * p->stride + x0;
    for (int i = 0; i < NEIGHBOURS; i++) {
        weigh_neighbour(p, t, at, rows, i);
    }
    for (int row = 0; row < rows; row++) {
        int64_t first = at + row * p->stride;
        memset(p->plane[PLANE_GAIN] + first, 0, sizeof(Lane));
        for (int k = 0; k < CANDIDATES; k++) {
            fit_row(p, t, first, t->weight[row][k]);
            write_candidate(p, t, first, k, k == 0 ? 1.0f : -1.0f);
        }
    }
}

// Share of the second candidate in a pixel. The errors are estimated from the pixel's own noise, so
// only their mean over a neighbourhood tells something.
static float share_of_second(const Planes *p, int x, int y)
{
    enum { RADIUS = 4 };
    float sum = 0.0f, variance = 1e-10f;
    for (int j = -RADIUS; j <= RADIUS; j++) {
        for (int i = -RADIUS; i <= RADIUS; i++) {
            int64_t at = (int64_t)denoise_mirror(y + j, p->height) * p->stride +
                         denoise_mirror(x + i, p->width);
            float near = 1.0f / (1.0f + 0.25f * (float)(i * i + j * j));
            sum += near * p->plane[PLANE_GAIN][at];
            variance += near * p->plane[PLANE_VARIANCE][at];
        }
    }
    return fminf(fmaxf(0.5f + 20.0f * sum / variance, 0.0f), 1.0f);
}

static void finish_row(const Planes *p, const DenoiseInput *g, int y, Image *out)
{
    for (int x = 0; x < p->width; x++) {
        int64_t pixel = (int64_t)y * p->width + x, at = (int64_t)y * p->stride + x;
        float divisor[3], share = share_of_second(p, x, y);
        denoise_divisor(g->albedo->pixel + 3 * pixel, divisor);
        for (int c = 0; c < 3; c++) {
            float a = p->plane[PLANE_RESULT + c][at], b = p->plane[PLANE_RESULT + 3 + c][at];
            out->pixel[pixel * out->channels + c] = (a + (b - a) * share) * divisor[c];
        }
    }
}

static bool filter(const Planes *p, const DenoiseInput *g, const Run *run, Image *out, Error *e)
{
    bool short_of_memory = false;
#pragma omp parallel num_threads(run->threads)
    {
        Tile *tile = memory_alloc(1, sizeof *tile, NULL);
        if (!tile) {
#pragma omp atomic write
            short_of_memory = true;
        }
#pragma omp for schedule(dynamic, 1)
        for (int y = 0; y < p->height; y += ROWS) {
            for (int x = 0; tile && x < p->width && !run_is_cancelled(run); x += LANES) {
                filter_tile(p, tile, x, y);
            }
        }
        free(tile);
#pragma omp for schedule(static)
        for (int y = 0; y < p->height; y++) {
            if (!run_is_cancelled(run)) {
                finish_row(p, g, y, out);
            }
        }
    }
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    return !short_of_memory || error_set(e, ERROR_MEMORY, "out of memory while denoising");
}

Image *denoise_filter(const DenoiseInput *input, float strength, const Run *run, Error *e)
{
    const Image *color = input->color;
    Image *out = image_new(color->width, color->height, color->channels, e);
    Planes planes;
    bool done = out && planes_new(&planes, color->width, color->height, e);
    if (done) {
        int64_t pixels = (int64_t)color->width * color->height;
        memcpy(out->pixel, color->pixel, (size_t)(pixels * color->channels) * sizeof(float));
#pragma omp parallel for num_threads(run->threads) schedule(static)
        for (int y = -BORDER; y < planes.height + BORDER; y++) {
            for (int64_t x = -BORDER; x < planes.stride - BORDER; x++) {
                fill_pixel(&planes, input, strength, (int)x, y);
            }
        }
        done = filter(&planes, input, run, out, e);
        free(planes.data);
    }
    if (!done) {
        image_free(out);
        return NULL;
    }
    return out;
}
