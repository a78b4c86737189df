#include "field/curl.h"

#include "base/random.h"

enum { STREAM_X = 1, STREAM_Y = 2, STREAM_Z = 3 }; // per component of the gradient or potential

typedef struct Lattice {
    int64_t cell[3];
    float at[3]; // position inside the cell, 0..1
} Lattice;

static Lattice lattice_of(Vec3 p)
{
    Lattice l;
    const float x[3] = {p.x, p.y, p.z};
    for (int i = 0; i < 3; i++) {
        float c = clampf(x[i], -1e9f, 1e9f);
        l.cell[i] = (int64_t)c - (c < (float)(int64_t)c ? 1 : 0);
        l.at[i] = c - (float)l.cell[i];
    }
    return l;
}

// Random gradient at a lattice point, each component in [-1, 1).
static Vec3 gradient_at(const int64_t cell[3], int corner, uint64_t seed)
{
    uint64_t key = seed;
    for (int i = 0; i < 3; i++) {
        key = random_key(key, (uint64_t)(cell[i] + (corner >> i & 1)));
    }
    return vec3(random_range(random_key(key, STREAM_X), -1.0f, 1.0f),
                random_range(random_key(key, STREAM_Y), -1.0f, 1.0f),
                random_range(random_key(key, STREAM_Z), -1.0f, 1.0f));
}

// Gradient of gradient noise (Perlin 2002, quintic fade) at p.
static Vec3 noise_gradient(Vec3 p, uint64_t seed)
{
    Lattice l = lattice_of(p);
    float fade[3][2], slope[3][2];
    for (int i = 0; i < 3; i++) {
        float t = l.at[i];
        fade[i][1] = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
        fade[i][0] = 1.0f - fade[i][1];
        slope[i][1] = 30.0f * t * t * (t * (t - 2.0f) + 1.0f);
        slope[i][0] = -slope[i][1];
    }
    Vec3 sum = vec3(0, 0, 0);
    for (int corner = 0; corner < 8; corner++) {
        int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        Vec3 g = gradient_at(l.cell, corner, seed);
        Vec3 offset = vec3(l.at[0] - (float)i, l.at[1] - (float)j, l.at[2] - (float)k);
        float value = vec3_dot(g, offset);
        sum = vec3_madd(sum, fade[0][i] * fade[1][j] * fade[2][k], g);
        sum = vec3_madd(sum, value,
                        vec3(slope[0][i] * fade[1][j] * fade[2][k],
                             fade[0][i] * slope[1][j] * fade[2][k],
                             fade[0][i] * fade[1][j] * slope[2][k]));
    }
    return sum;
}

Vec3 curl_noise(Vec3 p, uint64_t seed)
{
    Vec3 dx =
        noise_gradient(p, random_key(seed, STREAM_X)); // gradient of the potential's x component
    Vec3 dy = noise_gradient(p, random_key(seed, STREAM_Y));
    Vec3 dz = noise_gradient(p, random_key(seed, STREAM_Z));
    return vec3(dz.y - dy.z, dx.z - dz.x, dy.x - dx.y);
}
