#include "image/denoise.h"

#include "base/color.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    WINDOW = 7,          // half width of the search window, pixels
    BORDER = WINDOW + 1, // mirrored pixels around the image: window and patch never leave it
    BAND = 16            // rows per thread at a time
};

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
    PLANE_COUNT = PLANE_WEIGHT + 3
};

typedef struct Planes {
    int width, height; // of the image
    int64_t stride;    // floats between rows
    float *data;
    float *plane[PLANE_COUNT]; // address of pixel (0, 0) of each
} Planes;

static int mirror(int i, int count)
{
    while (i < 0 || i >= count) { // repeatedly in images smaller than the border
        i = i < 0 ? -1 - i : 2 * count - 1 - i;
    }
    return i;
}

static bool planes_new(Planes *p, int width, int height, Error *e)
{
    p->width = width;
    p->height = height;
    p->stride = width + 2 * BORDER;
    int64_t size = p->stride * (height + 2 * BORDER);
    p->data = memory_alloc(size * PLANE_COUNT, sizeof *p->data, e);
    for (int k = 0; p->data && k < PLANE_COUNT; k++) {
        p->plane[k] = p->data + size * k + p->stride * BORDER + BORDER;
    }
    return p->data != NULL;
}

// Divisor of radiance that removes texture. Sky, lamps and haze have albedo 1: in a pixel that also
// shows a surface, the quotient lies between both.
static void divisor_of(const float *albedo, float divisor[3])
{
    for (int c = 0; c < 3; c++) {
        divisor[c] = fmaxf(albedo[c], 0.03f);
    }
}

static float finite_or_zero(float x)
{
    return isfinite(x) ? x : 0.0f;
}

// Mean of a 3 x 3 neighbourhood: individual variances are noisy themselves.
static float smoothed_variance(const Image *variance, int x, int y)
{
    float sum = 0.0f;
    for (int k = 0; k < 9; k++) {
        int i = mirror(x + k % 3 - 1, variance->width);
        int j = mirror(y + k / 3 - 1, variance->height);
        sum += finite_or_zero(variance->pixel[(int64_t)j * variance->width + i]);
    }
    return sum / 9.0f;
}

static float log_depth(const Image *depth, int x, int y)
{
    float z =
        depth->pixel[(int64_t)mirror(y, depth->height) * depth->width + mirror(x, depth->width)];
    return isfinite(z) ? logf(fmaxf(z, 1e-3f)) : 20.0f; // beyond any surface: the sky
}

// Square of the factor k by which differences are weighed against the noise (Rousselle 2012, eq.
// 2). A variance estimated from n samples is itself uncertain, by about 1 / sqrt(n): too small
// where no sample met what is rare, so that a narrow k would leave each pixel that did as it is.
static float tolerance(float samples, float strength)
{
    return strength * strength * (0.5f + 12.0f / fmaxf(samples, 12.0f));
}

// Weights of the channels' squared differences, with a sum of 3. Light that does not take the
// surface's colour, as a gloss of white light, is magnified by the division in the channels that
// the surface absorbs, and the variance, which is of luminance, does not know of it. These weights
// count the differences as they are seen, undivided; where light does take the surface's colour,
// they make no difference.
static void weigh_channels(const float divisor[3], float weight[3])
{
    float sum = divisor[0] * divisor[0] + divisor[1] * divisor[1] + divisor[2] * divisor[2];
    for (int c = 0; c < 3; c++) {
        weight[c] = 3.0f * divisor[c] * divisor[c] / sum;
    }
}

static void fill_pixel(const Planes *p, const DenoiseInput *g, float strength, int x, int y)
{
    int i = mirror(x, p->width), j = mirror(y, p->height);
    int64_t from = (int64_t)j * p->width + i, to = (int64_t)y * p->stride + x;
    const float *albedo = g->albedo->pixel + 3 * from;
    float divisor[3], weight[3];
    divisor_of(albedo, divisor);
    weigh_channels(divisor, weight);
    float scale = luminance_rgb(divisor);
    for (int c = 0; c < 3; c++) {
        float radiance = finite_or_zero(g->color->pixel[from * g->color->channels + c]);
        p->plane[PLANE_COLOR + c][to] = radiance / divisor[c];
        p->plane[PLANE_WEIGHT + c][to] = weight[c];
        p->plane[PLANE_ALBEDO + c][to] = albedo[c];
        p->plane[PLANE_NORMAL + c][to] = finite_or_zero(g->normal->pixel[3 * from + c]);
    }
    float variance = smoothed_variance(g->variance, i, j) / (scale * scale);
    float samples = g->samples ? g->samples->pixel[from] : INFINITY;
    p->plane[PLANE_VARIANCE][to] = variance;
    p->plane[PLANE_TOLERANCE][to] = tolerance(samples, strength) * variance;
    float z = log_depth(g->depth, i, j);
    float dx =
        fminf(fabsf(log_depth(g->depth, i + 1, j) - z), fabsf(log_depth(g->depth, i - 1, j) - z));
    float dy =
        fminf(fabsf(log_depth(g->depth, i, j + 1) - z), fabsf(log_depth(g->depth, i, j - 1) - z));
    p->plane[PLANE_DEPTH][to] = z;
    p->plane[PLANE_SLACK][to] = 0.01f * 0.01f + 4.0f * (dx * dx + dy * dy);
}

// Workspace of one band: patch distances of its rows and one above and below, sums over patches,
// and the gathered result.
typedef struct Band {
    float *distance, *across, *weight, *sum[3];
} Band;

static bool band_new(Band *band, const Planes *p)
{
    int64_t row = p->stride;
    float *data = memory_alloc_zero(row * (2 * (BAND + 2) + 4 * BAND), sizeof *data, NULL);
    if (!data) {
        return false;
    }
    band->distance = data;
    band->across = data + row * (BAND + 2);
    band->weight = data + row * 2 * (BAND + 2);
    for (int c = 0; c < 3; c++) {
        band->sum[c] = band->weight + row * BAND * (c + 1);
    }
    return true;
}

// Squared colour differences beyond what the variances explain, relative to those variances
// (Rousselle 2012, eq. 2), for one row; offset: to the other pixel.
static void color_distances(const Planes *p, int y, int64_t offset, float *restrict out)
{
    const float *restrict a = p->plane[PLANE_COLOR] + y * p->stride;
    const float *restrict b = p->plane[PLANE_COLOR + 1] + y * p->stride;
    const float *restrict c = p->plane[PLANE_COLOR + 2] + y * p->stride;
    const float *restrict v = p->plane[PLANE_VARIANCE] + y * p->stride;
    const float *restrict t = p->plane[PLANE_TOLERANCE] + y * p->stride;
    const float *restrict wa = p->plane[PLANE_WEIGHT] + y * p->stride;
    const float *restrict wb = p->plane[PLANE_WEIGHT + 1] + y * p->stride;
    const float *restrict wc = p->plane[PLANE_WEIGHT + 2] + y * p->stride;
    for (int x = -1; x <= p->width; x++) {
        float da = a[x] - a[x + offset], db = b[x] - b[x + offset], dc = c[x] - c[x + offset];
        float v0 = v[x], v1 = v[x + offset], least = v0 < v1 ? v0 : v1;
        float square = (wa[x] * da * da + wb[x] * db * db + wc[x] * dc * dc) * (1.0f / 3.0f);
        out[x] = (square - (v0 + least)) / (1e-10f + (t[x] + t[x + offset]));
    }
}

static void sum_across(const Planes *p, const float *restrict in, float *restrict out)
{
    for (int x = 0; x < p->width; x++) {
        out[x] = in[x - 1] + in[x] + in[x + 1];
    }
}

// Squared feature differences of a row, relative to their bandwidths.
static void feature_distances(const Planes *p, int y, int64_t offset, float *restrict out)
{
    const float *restrict plane[PLANE_COUNT];
    for (int k = 0; k < PLANE_COUNT; k++) {
        plane[k] = p->plane[k] + y * p->stride;
    }
    const float albedo_scale = 1.0f / (0.06f * 0.06f), normal_scale = 1.0f / (0.3f * 0.3f);
    for (int x = 0; x < p->width; x++) {
        int64_t q = x + offset;
        float a = plane[PLANE_ALBEDO][x] - plane[PLANE_ALBEDO][q];
        float b = plane[PLANE_ALBEDO + 1][x] - plane[PLANE_ALBEDO + 1][q];
        float c = plane[PLANE_ALBEDO + 2][x] - plane[PLANE_ALBEDO + 2][q];
        float d = plane[PLANE_NORMAL][x] - plane[PLANE_NORMAL][q];
        float e = plane[PLANE_NORMAL + 1][x] - plane[PLANE_NORMAL + 1][q];
        float f = plane[PLANE_NORMAL + 2][x] - plane[PLANE_NORMAL + 2][q];
        float z = plane[PLANE_DEPTH][x] - plane[PLANE_DEPTH][q];
        out[x] = (a * a + b * b + c * c) * albedo_scale + (d * d + e * e + f * f) * normal_scale +
                 z * z / plane[PLANE_SLACK][x];
    }
}

// Adds the other pixel with weight e^-distance (as (1 - d/8)^8, which has finite support).
static void gather_row(const Planes *p, const Band *band, int row, int y, int64_t offset,
                       float away)
{
    const float *restrict above = band->across + (int64_t)row * p->stride;
    const float *restrict middle = above + p->stride, *restrict below = middle + p->stride;
    const float *restrict feature = band->distance + BORDER; // no longer used for distances
    int64_t own = (int64_t)row * p->stride;
    float *restrict weight = band->weight + own;
    for (int x = 0; x < p->width; x++) {
        float patch = (above[x] + middle[x] + below[x]) * (1.0f / 9.0f);
        float d = 1.0f - ((patch > 0.0f ? patch : 0.0f) + feature[x] + away) * 0.125f;
        d = d > 0.0f ? d : 0.0f;
        d *= d;
        d *= d;
        d *= d;
        weight[x] += d;
        for (int c = 0; c < 3; c++) {
            band->sum[c][own + x] += d * p->plane[PLANE_COLOR + c][y * p->stride + x + offset];
        }
    }
}

static void gather_offset(const Planes *p, const Band *band, int y0, int rows, int dx, int dy)
{
    int64_t offset = dy * p->stride + dx;
    float away = (float)(dx * dx + dy * dy) / (WINDOW * WINDOW); // an outlier leaves no square
    for (int row = -1; row <= rows; row++) {
        float *line = band->distance + (int64_t)(row + 1) * p->stride + BORDER;
        color_distances(p, y0 + row, offset, line);
        sum_across(p, line, band->across + (int64_t)(row + 1) * p->stride);
    }
    for (int row = 0; row < rows; row++) {
        feature_distances(p, y0 + row, offset, band->distance + BORDER);
        gather_row(p, band, row, y0 + row, offset, away);
    }
}

static void finish_band(const Planes *p, const Band *band, const DenoiseInput *g, int y0, int rows,
                        Image *out)
{
    for (int row = 0; row < rows; row++) {
        for (int x = 0; x < p->width; x++) {
            int64_t pixel = (int64_t)(y0 + row) * p->width + x, own = (int64_t)row * p->stride + x;
            float divisor[3];
            divisor_of(g->albedo->pixel + 3 * pixel, divisor);
            float *to = out->pixel + pixel * out->channels;
            for (int c = 0; c < 3; c++) {
                to[c] = band->sum[c][own] / band->weight[own] * divisor[c];
            }
        }
    }
}

static void filter_band(const Planes *p, const Band *band, const DenoiseInput *g, int y0,
                        Image *out)
{
    int rows = p->height - y0 < BAND ? p->height - y0 : BAND;
    memset(band->weight, 0, (size_t)p->stride * BAND * 4 * sizeof(float));
    for (int dy = -WINDOW; dy <= WINDOW; dy++) {
        for (int dx = -WINDOW; dx <= WINDOW; dx++) {
            gather_offset(p, band, y0, rows, dx, dy);
        }
    }
    finish_band(p, band, g, y0, rows, out);
}

static bool filter(const Planes *p, const DenoiseInput *g, const Run *run, Image *out, Error *e)
{
    bool short_of_memory = false;
#pragma omp parallel num_threads(run->threads)
    {
        Band band = {0};
        if (!band_new(&band, p)) {
#pragma omp atomic write
            short_of_memory = true;
        }
#pragma omp for schedule(dynamic, 1)
        for (int y = 0; y < p->height; y += BAND) {
            if (band.distance && !run_is_cancelled(run)) {
                filter_band(p, &band, g, y, out);
            }
        }
        free(band.distance);
    }
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    return !short_of_memory || error_set(e, ERROR_MEMORY, "out of memory while denoising");
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
    return good || error_set(e, ERROR_INPUT,
                             "cannot denoise: color, albedo, normal, depth, variance and samples "
                             "must be of one size and have 3 or 4, 3, 3, 1, 1 and 1 channels");
}

Image *image_denoise(const DenoiseInput *input, float strength, const Run *run, Error *e)
{
    const Image *color = input->color;
    Image *out =
        check_input(input, e) ? image_new(color->width, color->height, color->channels, e) : NULL;
    if (!out) {
        return NULL;
    }
    int64_t pixels = (int64_t)color->width * color->height;
    memcpy(out->pixel, color->pixel, (size_t)(pixels * color->channels) * sizeof(float));
    if (!(strength > 0.0f)) {
        return out;
    }
    Planes planes;
    bool done = planes_new(&planes, color->width, color->height, e);
    if (done) {
#pragma omp parallel for num_threads(run->threads) schedule(static)
        for (int y = -BORDER; y < planes.height + BORDER; y++) {
            for (int x = -BORDER; x < planes.width + BORDER; x++) {
                fill_pixel(&planes, input, strength, x, y);
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
