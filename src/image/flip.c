#include "image/flip.h"

#include "base/memory.h"
#include "image/tone_curve.h"

#include <math.h>
#include <stdlib.h>

// Linear Rec. 709 (white D65) to CIE XYZ, and the inverse.
static const float XYZ_OF_RGB[3][3] = {{0.4123866f, 0.3575915f, 0.1804505f},
                                       {0.2126368f, 0.7151830f, 0.0721802f},
                                       {0.0193306f, 0.1191972f, 0.9503726f}};
static const float RGB_OF_XYZ[3][3] = {{3.2410032f, -1.5373990f, -0.4986159f},
                                       {-0.9692243f, 1.8759300f, 0.0415542f},
                                       {0.0556394f, -0.2040112f, 1.0571490f}};
static const float WHITE[3] = {0.9504286f, 1.0f, 1.0889004f};

// Contrast sensitivity of the eye as sums of Gaussians (Andersson 2020, table 1): a sqrt(pi / b)
// exp(-pi^2 x^2 / b) at x degrees, for brightness, red-green, and two for blue-yellow.
static const float SENSITIVITY[4][2] = {
    {1.0f, 0.0047f}, {1.0f, 0.0053f}, {34.1f, 0.04f}, {13.5f, 0.025f}};
#define WIDEST 0.04f

#define FEATURE_WIDTH 0.082f // degrees, width of the edge and point detectors
#define COLOR_EXPONENT 0.7f
#define COLOR_KNEE 0.4f // fraction of the largest colour difference, which maps to
#define COLOR_KNEE_OUT 0.95f
#define PI 3.14159265f

static void multiply(const float m[3][3], const float v[3], float out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    }
}

static float clamp01(float v)
{
    return v > 0.0f ? fminf(v, 1.0f) : 0.0f; // NaN becomes 0
}

// sRGB to the linear opponent space YCxCz (Andersson 2020, 4.1).
static void opponent_of_srgb(const float *srgb, float out[3])
{
    float rgb[3], xyz[3];
    for (int c = 0; c < 3; c++) {
        rgb[c] = tone_linear_from_srgb(srgb[c]);
    }
    multiply(XYZ_OF_RGB, rgb, xyz);
    float x = xyz[0] / WHITE[0], y = xyz[1] / WHITE[1], z = xyz[2] / WHITE[2];
    out[0] = 116.0f * y - 16.0f;
    out[1] = 500.0f * (x - y);
    out[2] = 200.0f * (y - z);
}

static void rgb_of_opponent(const float v[3], float rgb[3])
{
    float y = (v[0] + 16.0f) / 116.0f;
    float xyz[3] = {WHITE[0] * (y + v[1] / 500.0f), WHITE[1] * y, WHITE[2] * (y - v[2] / 200.0f)};
    multiply(RGB_OF_XYZ, xyz, rgb);
    for (int c = 0; c < 3; c++) {
        rgb[c] = clamp01(rgb[c]);
    }
}

static float lab_curve(float t)
{
    const float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? cbrtf(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}

// L*a*b* with a and b reduced in dark colours (Hunt effect, Andersson 2020, eq. 5).
static void lab_of_rgb(const float rgb[3], float lab[3])
{
    float xyz[3], f[3];
    multiply(XYZ_OF_RGB, rgb, xyz);
    for (int c = 0; c < 3; c++) {
        f[c] = lab_curve(xyz[c] / WHITE[c]);
    }
    lab[0] = 116.0f * f[1] - 16.0f;
    lab[1] = 0.01f * lab[0] * 500.0f * (f[0] - f[1]);
    lab[2] = 0.01f * lab[0] * 200.0f * (f[1] - f[2]);
}

// Distance for large colour differences (HyAB, Andersson 2020, eq. 6).
static float color_distance(const float a[3], const float b[3])
{
    return fabsf(a[0] - b[0]) + hypotf(a[1] - b[1], a[2] - b[2]);
}

static float largest_color_distance(void)
{
    const float green[3] = {0.0f, 1.0f, 0.0f}, blue[3] = {0.0f, 0.0f, 1.0f};
    float a[3], b[3];
    lab_of_rgb(green, a);
    lab_of_rgb(blue, b);
    return powf(color_distance(a, b), COLOR_EXPONENT);
}

// Compresses large differences (Andersson 2020, eq. 7).
static float color_difference(const float a[3], const float b[3], float largest)
{
    float d = powf(color_distance(a, b), COLOR_EXPONENT), knee = COLOR_KNEE * largest;
    return d < knee ? d * COLOR_KNEE_OUT / knee
                    : COLOR_KNEE_OUT + (d - knee) / (largest - knee) * (1.0f - COLOR_KNEE_OUT);
}

// ---- separable filters; borders are clamped

enum { MAX_RADIUS = 255 };

typedef struct Kernel {
    int radius;
    float weight[2 * MAX_RADIUS + 1];
} Kernel;

// Gaussian with deviation in pixels, normalised to sum 1.
static Kernel gaussian(float deviation, int radius)
{
    Kernel k = {.radius = radius};
    float sum = 0.0f;
    for (int i = -radius; i <= radius; i++) {
        float x = (float)i / deviation;
        k.weight[i + radius] = expf(-0.5f * x * x);
        sum += k.weight[i + radius];
    }
    for (int i = 0; i <= 2 * radius; i++) {
        k.weight[i] /= sum;
    }
    return k;
}

// First or second derivative of a Gaussian; positive weights sum to 1, negative ones to -1
// (Andersson 2020, 4.2).
static Kernel derivative(float deviation, int radius, int order)
{
    Kernel k = {.radius = radius};
    float sum[2] = {0.0f, 0.0f};
    for (int i = -radius; i <= radius; i++) {
        float x = (float)i / deviation;
        float w = (order == 1 ? -x : x * x - 1.0f) * expf(-0.5f * x * x);
        k.weight[i + radius] = w;
        sum[w < 0.0f] += fabsf(w);
    }
    for (int i = 0; i <= 2 * radius; i++) {
        k.weight[i] /= sum[k.weight[i] < 0.0f];
    }
    return k;
}

static int clamp_index(int i, int count)
{
    return i < 0 ? 0 : (i < count ? i : count - 1);
}

// One pass: out[j] = sum over i of weight * in[j + i] along x (stride 1) or y.
static void pass(const float *in, float *out, int width, int height, bool along_y, const Kernel *k)
{
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            float sum = 0.0f;
            for (int i = -k->radius; i <= k->radius; i++) {
                int from_x = along_y ? x : clamp_index(x + i, width);
                int from_y = along_y ? clamp_index(y + i, height) : y;
                sum += k->weight[i + k->radius] * in[(int64_t)from_y * width + from_x];
            }
            out[(int64_t)y * width + x] = sum;
        }
    }
}

// Intermediate results of one picture.
typedef struct Planes {
    int width, height;
    float *opponent[3], *seen[3]; // unfiltered; filtered by contrast sensitivity
    float *edge, *point;          // strength of features
    float *across, *result, *half;
    float *memory;
} Planes;

enum { PLANE_COUNT = 11 };

static bool planes_new(Planes *p, const Image *image, Error *e)
{
    *p = (Planes){.width = image->width, .height = image->height};
    int64_t count = (int64_t)image->width * image->height;
    p->memory = memory_alloc(count, PLANE_COUNT * sizeof(float), e);
    if (!p->memory) {
        return false;
    }
    float **const plane[PLANE_COUNT] = {
        &p->opponent[0], &p->opponent[1], &p->opponent[2], &p->seen[0], &p->seen[1], &p->seen[2],
        &p->edge,        &p->point,       &p->across,      &p->result,  &p->half};
    for (int i = 0; i < PLANE_COUNT; i++) {
        *plane[i] = p->memory + i * count;
    }
    for (int64_t i = 0; i < count; i++) {
        float v[3];
        opponent_of_srgb(image->pixel + 3 * i, v);
        for (int c = 0; c < 3; c++) {
            p->opponent[c][i] = v[c];
        }
    }
    return true;
}

static void filter(Planes *p, const float *in, float *out, const Kernel *along_x,
                   const Kernel *along_y)
{
    pass(in, p->half, p->width, p->height, false, along_x);
    pass(p->half, out, p->width, p->height, true, along_y);
}

// Removes detail that the eye does not resolve at this distance.
static void filter_by_sensitivity(Planes *p, float pixels_per_degree)
{
    int radius = (int)ceilf(3.0f * sqrtf(WIDEST / (2.0f * PI * PI)) * pixels_per_degree);
    float share[4]; // weights of the Gaussians in the plane, which mix the two of blue-yellow
    Kernel kernel[4];
    for (int i = 0; i < 4; i++) {
        float b = SENSITIVITY[i][1];
        kernel[i] = gaussian(sqrtf(b / (2.0f * PI * PI)) * pixels_per_degree, radius);
        // the centre weight is 1 / (the normalising sum)
        float sum = 1.0f / kernel[i].weight[radius];
        share[i] = SENSITIVITY[i][0] * sqrtf(PI / b) * sum * sum;
    }
    filter(p, p->opponent[0], p->seen[0], &kernel[0], &kernel[0]);
    filter(p, p->opponent[1], p->seen[1], &kernel[1], &kernel[1]);
    filter(p, p->opponent[2], p->seen[2], &kernel[2], &kernel[2]);
    filter(p, p->opponent[2], p->across, &kernel[3], &kernel[3]);
    float wide = share[2] / (share[2] + share[3]);
    for (int64_t i = 0; i < (int64_t)p->width * p->height; i++) {
        p->seen[2][i] = wide * p->seen[2][i] + (1.0f - wide) * p->across[i];
    }
}

// Feature strength by a derivative of this order.
static void detect(Planes *p, float deviation, int order, float *strength)
{
    int radius = (int)ceilf(3.0f * deviation);
    Kernel change = derivative(deviation, radius, order), smooth = gaussian(deviation, radius);
    filter(p, p->opponent[0], p->across, &change, &smooth);
    filter(p, p->opponent[0], p->result, &smooth, &change);
    for (int64_t i = 0; i < (int64_t)p->width * p->height; i++) {
        // brightness as (Y + 16) / 116; the constant vanishes in a derivative
        strength[i] = hypotf(p->across[i], p->result[i]) / 116.0f;
    }
}

static void look(Planes *p, float pixels_per_degree)
{
    float deviation = 0.5f * FEATURE_WIDTH * pixels_per_degree;
    filter_by_sensitivity(p, pixels_per_degree);
    detect(p, deviation, 1, p->edge);
    detect(p, deviation, 2, p->point);
}

static void lab_seen(const Planes *p, int64_t i, float lab[3])
{
    float v[3] = {p->seen[0][i], p->seen[1][i], p->seen[2][i]}, rgb[3];
    rgb_of_opponent(v, rgb);
    lab_of_rgb(rgb, lab);
}

// Feature differences amplify colour differences (Andersson 2020, eq. 10-11).
static void compare(const Planes *a, const Planes *b, float *map)
{
    float largest = largest_color_distance();
    for (int64_t i = 0; i < (int64_t)a->width * a->height; i++) {
        float lab_a[3], lab_b[3];
        lab_seen(a, i, lab_a);
        lab_seen(b, i, lab_b);
        float color = color_difference(lab_a, lab_b, largest);
        float edges = fabsf(a->edge[i] - b->edge[i]), points = fabsf(a->point[i] - b->point[i]);
        float features = sqrtf(fmaxf(edges, points) / sqrtf(2.0f));
        map[i] = powf(color, 1.0f - fminf(features, 1.0f));
    }
}

static bool check(const Image *reference, const Image *test, float pixels_per_degree, Error *e)
{
    if (reference->channels != 3 || test->channels != 3 || reference->width != test->width ||
        reference->height != test->height) {
        return error_set(e, ERROR_INPUT,
                         "images of %d x %d with %d channels and %d x %d with %d channels cannot "
                         "be looked at in turn; two of one size with 3 channels can",
                         reference->width, reference->height, reference->channels, test->width,
                         test->height, test->channels);
    }
    return (pixels_per_degree >= 1.0f && pixels_per_degree <= 1800.0f) ||
           error_set(e, ERROR_INPUT, "%g pixels per degree; it must be 1 to 1800",
                     (double)pixels_per_degree);
}

Image *image_flip(const Image *reference, const Image *test, float pixels_per_degree, Error *e)
{
    if (!check(reference, test, pixels_per_degree, e)) {
        return NULL;
    }
    Planes a = {0}, b = {0};
    Image *map = image_new(reference->width, reference->height, 1, e);
    if (map && planes_new(&a, reference, e) && planes_new(&b, test, e)) {
        look(&a, pixels_per_degree);
        look(&b, pixels_per_degree);
        compare(&a, &b, map->pixel);
    } else {
        image_free(map);
        map = NULL;
    }
    free(a.memory);
    free(b.memory);
    return map;
}

double image_mean(const Image *map)
{
    double sum = 0.0;
    int64_t count = (int64_t)map->width * map->height * map->channels;
    for (int64_t i = 0; i < count; i++) {
        sum += (double)map->pixel[i];
    }
    return sum / (double)count;
}
