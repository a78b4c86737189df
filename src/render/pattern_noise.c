#include "render/pattern_noise.h"

#include <stddef.h>

// Mixes 32 bits (the finaliser of MurmurHash3).
static inline uint32_t mix(uint32_t h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

static inline uint32_t lattice(int x, int y, int z, uint32_t seed)
{
    return mix((uint32_t)x * 0x8da6b343u + (uint32_t)y * 0xd8163841u + (uint32_t)z * 0xcb1ab31fu +
               seed * 0x9e3779b9u);
}

float noise_unit(uint32_t hash, uint32_t number)
{
    return (float)(mix(hash + 0x9e3779b9u * (number + 1)) >> 8) * (1.0f / 16777216.0f);
}

// Three components in -1..1, ten bits each: not unit, but their spread has no axis.
static inline Vec3 lattice_gradient(uint32_t h)
{
    const float scale = 2.0f / 1023.0f;
    return vec3((float)(h & 1023u) * scale - 1.0f, (float)(h >> 10 & 1023u) * scale - 1.0f,
                (float)(h >> 20 & 1023u) * scale - 1.0f);
}

static inline float fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

static inline float fade_slope(float t)
{
    return 30.0f * t * t * (t * (t - 2.0f) + 1.0f);
}

float noise_solid(Vec3 p, uint32_t seed, Vec3 *gradient)
{
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    int x = (int)fx, y = (int)fy, z = (int)fz;
    Vec3 f = vec3(p.x - fx, p.y - fy, p.z - fz);
    float u[2] = {1.0f - fade(f.x), fade(f.x)}, v[2] = {1.0f - fade(f.y), fade(f.y)};
    float w[2] = {1.0f - fade(f.z), fade(f.z)};
    float du = fade_slope(f.x), dv = fade_slope(f.y), dw = fade_slope(f.z);
    float sum = 0.0f;
    Vec3 slope = vec3_splat(0.0f);
    for (int k = 0; k < 8; k++) {
        int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        Vec3 g = lattice_gradient(lattice(x + i, y + j, z + l, seed));
        float value = g.x * (f.x - (float)i) + g.y * (f.y - (float)j) + g.z * (f.z - (float)l);
        float weight = u[i] * v[j] * w[l];
        sum += weight * value;
        slope = vec3_madd(slope, weight, g);
        slope.x += (i ? du : -du) * v[j] * w[l] * value;
        slope.y += (j ? dv : -dv) * u[i] * w[l] * value;
        slope.z += (l ? dw : -dw) * u[i] * v[j] * value;
    }
    const float scale = 1.25f;
    if (gradient) {
        *gradient = vec3_scale(slope, scale);
    }
    return sum * scale;
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

CellPoint noise_cells(Vec3 p, uint32_t seed)
{
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    Vec3 corner = vec3_sub(vec3(fx, fy, fz), p);
    float nearest = INFINITY, second = INFINITY;
    Vec3 a = {0, 0, 0}, b = {0, 0, 0};
    uint32_t cell = 0;
    for (int k = 0; k < 27; k++) {
        int i = k % 3 - 1, j = k / 3 % 3 - 1, l = k / 9 - 1;
        uint32_t h = lattice((int)fx + i, (int)fy + j, (int)fz + l, seed);
        Vec3 jitter = vec3_scale(lattice_gradient(h), 0.42f);
        Vec3 offset = vec3((float)i + 0.5f, (float)j + 0.5f, (float)l + 0.5f);
        Vec3 point = vec3_add(vec3_add(corner, offset), jitter);
        float distance = vec3_dot(point, point);
        if (distance < nearest) {
            second = nearest;
            b = a;
            nearest = distance;
            a = point;
            cell = h;
        } else if (distance < second) {
            second = distance;
            b = point;
        }
    }
    Vec3 apart = vec3_sub(a, b);
    float length = fmaxf(vec3_length(apart), 1e-6f);
    return (CellPoint){0.5f * (second - nearest) / length, vec3_scale(apart, 1.0f / length), cell};
}
