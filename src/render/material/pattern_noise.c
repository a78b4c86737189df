#include "render/material/pattern_noise.h"

#include <stddef.h>

// Eight lattice points at a time, in the compiler's vectors: noise is most of a pattern's cost.
typedef float Float8 __attribute__((vector_size(32)));
typedef int32_t Int8 __attribute__((vector_size(32)));
typedef uint32_t Hash8 __attribute__((vector_size(32)));

enum { TEN_BITS = 1023 };
static const float GRADIENT_SCALE = 2.0f / TEN_BITS;

// The finaliser of MurmurHash3, of a number or of eight.
#define MIX(h)              \
    do {                    \
        (h) ^= (h) >> 16;   \
        (h) *= 0x85ebca6bu; \
        (h) ^= (h) >> 13;   \
        (h) *= 0xc2b2ae35u; \
        (h) ^= (h) >> 16;   \
    } while (0)

// Hash of lattice points; the coordinates may be vectors.
#define LATTICE(x, y, z, seed) \
    ((x)*0x8da6b343u + (y)*0xd8163841u + (z)*0xcb1ab31fu + (seed)*0x9e3779b9u)

uint32_t noise_square(int x, int z, uint32_t seed)
{
    return LATTICE((uint32_t)x, 0u, (uint32_t)z, seed);
}

float noise_unit(uint32_t hash, uint32_t number)
{
    hash += 0x9e3779b9u * (number + 1);
    MIX(hash);
    return (float)(hash >> 8) * (1.0f / 16777216.0f);
}

static inline float fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

static inline float fade_slope(float t)
{
    return 30.0f * t * t * (t * (t - 2.0f) + 1.0f);
}

static inline float sum_of(const Float8 *v)
{
    const Float8 w = *v;
    return ((w[0] + w[1]) + (w[2] + w[3])) + ((w[4] + w[5]) + (w[6] + w[7]));
}

// Three components in -1..1, ten bits of a hash each: not unit vectors, but without a preferred
// axis.
static inline void gradients_of(const Hash8 *hash, Float8 gradient[3])
{
    for (int c = 0; c < 3; c++) {
        Int8 bits = (Int8)(*hash >> (uint32_t)(10 * c) & TEN_BITS);
        gradient[c] = __builtin_convertvector(bits, Float8) * GRADIENT_SCALE - 1.0f;
    }
}

float noise_solid(Vec3 p, uint32_t seed, Vec3 *gradient)
{
    static const float scale = 1.25f;
    const Hash8 i = {0, 1, 0, 1, 0, 1, 0, 1}, j = {0, 0, 1, 1, 0, 0, 1, 1};
    const Hash8 k = {0, 0, 0, 0, 1, 1, 1, 1};
    const Float8 i1 = {0, 1, 0, 1, 0, 1, 0, 1}, j1 = {0, 0, 1, 1, 0, 0, 1, 1};
    const Float8 k1 = {0, 0, 0, 0, 1, 1, 1, 1};
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    Hash8 hash = LATTICE((uint32_t)(int)fx + i, (uint32_t)(int)fy + j, (uint32_t)(int)fz + k, seed);
    MIX(hash);
    Float8 g[3];
    gradients_of(&hash, g);
    Vec3 f = vec3(p.x - fx, p.y - fy, p.z - fz);
    Float8 value = g[0] * (f.x - i1) + g[1] * (f.y - j1) + g[2] * (f.z - k1);
    float u = fade(f.x), v = fade(f.y), w = fade(f.z);
    Float8 wu = (1.0f - u) + i1 * (2.0f * u - 1.0f), wv = (1.0f - v) + j1 * (2.0f * v - 1.0f);
    Float8 ww = (1.0f - w) + k1 * (2.0f * w - 1.0f), weight = wu * wv * ww;
    Float8 sum = weight * value;
    if (gradient) {
        Float8 x = weight * g[0] + (2.0f * i1 - 1.0f) * fade_slope(f.x) * wv * ww * value;
        Float8 y = weight * g[1] + (2.0f * j1 - 1.0f) * fade_slope(f.y) * wu * ww * value;
        Float8 z = weight * g[2] + (2.0f * k1 - 1.0f) * fade_slope(f.z) * wu * wv * value;
        *gradient = vec3(scale * sum_of(&x), scale * sum_of(&y), scale * sum_of(&z));
    }
    return scale * sum_of(&sum);
}

float noise_fractal(Vec3 p, int octaves, uint32_t seed)
{
    float sum = 0.0f, height = 0.5f;
    for (int i = 0; i < octaves; i++) {
        sum += height * noise_solid(p, seed + (uint32_t)i, NULL);
        p = vec3_scale(p, 2.03f); // off 2, so that the octaves' zeros do not meet
        height *= 0.5f;
    }
    return 1.4f * sum;
}

// The feature points of the 27 cells around a position, relative to it; 5 more are unused.
typedef struct CellPoints {
    Float8 x[4], y[4], z[4], distance[4];
    Hash8 hash[4];
} CellPoints;

static void find_cell_points(Vec3 p, uint32_t seed, CellPoints *points)
{
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    Vec3 f = vec3(p.x - fx, p.y - fy, p.z - fz);
    for (int batch = 0; batch < 4; batch++) {
        const Int8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
        Int8 n = lane + 8 * batch, i = n % 3 - 1, j = n / 3 % 3 - 1, k = n / 9 - 1;
        Hash8 hash = LATTICE((uint32_t)(int)fx + (Hash8)i, (uint32_t)(int)fy + (Hash8)j,
                             (uint32_t)(int)fz + (Hash8)k, seed);
        MIX(hash);
        Float8 g[3];
        gradients_of(&hash, g);
        Float8 x = __builtin_convertvector(i, Float8) + 0.5f - f.x + 0.42f * g[0];
        Float8 y = __builtin_convertvector(j, Float8) + 0.5f - f.y + 0.42f * g[1];
        Float8 z = __builtin_convertvector(k, Float8) + 0.5f - f.z + 0.42f * g[2];
        points->x[batch] = x;
        points->y[batch] = y;
        points->z[batch] = z;
        points->distance[batch] = x * x + y * y + z * z;
        points->hash[batch] = hash;
    }
}

static Vec3 cell_point(const CellPoints *points, int n)
{
    return vec3(points->x[n / 8][n % 8], points->y[n / 8][n % 8], points->z[n / 8][n % 8]);
}

CellPoint noise_cells(Vec3 p, uint32_t seed)
{
    CellPoints points;
    find_cell_points(p, seed, &points);
    float nearest = INFINITY, second = INFINITY;
    int a = 0, b = 0;
    for (int n = 0; n < 27; n++) {
        float distance = points.distance[n / 8][n % 8];
        if (distance < nearest) {
            second = nearest;
            b = a;
            nearest = distance;
            a = n;
        } else if (distance < second) {
            second = distance;
            b = n;
        }
    }
    Vec3 apart = vec3_sub(cell_point(&points, a), cell_point(&points, b));
    float length = fmaxf(vec3_length(apart), 1e-6f);
    return (CellPoint){0.5f * (second - nearest) / length, vec3_scale(apart, 1.0f / length),
                       points.hash[a / 8][a % 8], cell_point(&points, a),
                       points.hash[b / 8][b % 8]};
}

// What is left of a vector along a surface.
static Vec3 along(Vec3 v, Vec3 normal)
{
    return vec3_madd(v, -vec3_dot(v, normal), normal);
}

// Takes distances as if the points lay on a surface; those farther off it give way to nearer ones.
static void flatten(CellPoints *points, Vec3 normal)
{
    static const float depth = 0.2f; // what is left of the square of a distance off the surface
    for (int i = 0; i < 4; i++) {
        Float8 off = points->x[i] * normal.x + points->y[i] * normal.y + points->z[i] * normal.z;
        points->distance[i] -= (1.0f - depth) * off * off;
    }
}

CellPoint noise_cells_on(Vec3 p, Vec3 normal, uint32_t seed)
{
    CellPoints points;
    find_cell_points(p, seed, &points);
    flatten(&points, normal);
    int own = 0;
    for (int n = 1; n < 27; n++) {
        if (points.distance[n / 8][n % 8] < points.distance[own / 8][own % 8]) {
            own = n;
        }
    }
    CellPoint cell = {.border = INFINITY,
                      .cell = points.hash[own / 8][own % 8],
                      .point = cell_point(&points, own)};
    for (int n = 0; n < 27; n++) {
        Vec3 apart = along(vec3_sub(cell.point, cell_point(&points, n)), normal);
        float length = vec3_length(apart);
        float gap = points.distance[n / 8][n % 8] - points.distance[own / 8][own % 8];
        if (length > 0.05f && gap < 2.0f * length * cell.border) {
            cell.border = 0.5f * gap / length;
            cell.normal = vec3_scale(apart, 1.0f / length);
            cell.next = points.hash[n / 8][n % 8];
        }
    }
    return cell;
}

// A sum of complex waves and its slope.
typedef struct WaveSum {
    float re, im, weight;
    Vec3 re_slope, im_slope;
} WaveSum;

// Adds the wave about a point (relative to the position), whose weight falls to 0 at `reach`.
static void add_wave(WaveSum *sum, Vec3 point, uint32_t hash, Vec3 normal, float wavelength)
{
    static const float reach = 1.08f; // no point outside of the 27 cells is nearer
    float near = 1.0f - vec3_dot(point, point) / (reach * reach);
    Vec3 random =
        vec3(noise_unit(hash, 1) - 0.5f, noise_unit(hash, 2) - 0.5f, noise_unit(hash, 3) - 0.5f);
    Vec3 aside = along(random, normal);
    float length = vec3_length(aside);
    if (near <= 0.0f || length < 1e-4f) {
        return;
    }
    float weight = near * near * near;
    Vec3 fall = vec3_scale(point, 6.0f * near * near / (reach * reach)); // slope of the weight
    Vec3 wave = vec3_scale(aside, 2.0f * PI_F / (wavelength * length));
    float phase = 2.0f * PI_F * noise_unit(hash, 4) - vec3_dot(wave, point);
    float re = cosf(phase), im = sinf(phase);
    sum->re += weight * re;
    sum->im += weight * im;
    sum->weight += weight;
    sum->re_slope = vec3_madd(vec3_madd(sum->re_slope, -weight * im, wave), re, fall);
    sum->im_slope = vec3_madd(vec3_madd(sum->im_slope, weight * re, wave), im, fall);
}

Stripes noise_stripes_on(Vec3 p, Vec3 normal, float wavelength, uint32_t seed)
{
    CellPoints points;
    find_cell_points(p, seed, &points);
    WaveSum sum = {0};
    for (int n = 0; n < 27; n++) {
        add_wave(&sum, cell_point(&points, n), points.hash[n / 8][n % 8], normal, wavelength);
    }
    float square = sum.re * sum.re + sum.im * sum.im, length = sqrtf(square);
    if (square < 1e-12f) {
        return (Stripes){.cosine = 1.0f};
    }
    Vec3 turn = vec3_sub(vec3_scale(sum.im_slope, sum.re), vec3_scale(sum.re_slope, sum.im));
    return (Stripes){sum.re / length, sum.im / length, length / sum.weight,
                     along(vec3_scale(turn, 1.0f / square), normal)};
}
