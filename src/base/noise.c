#include "base/noise.h"

#include "base/random.h"

static float fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// Dot product of a corner's hashed gradient with the offset from that corner.
static float corner(int64_t ix, int64_t iy, float dx, float dy, uint64_t seed)
{
    uint64_t key = random_key(random_key(seed, (uint64_t)ix), (uint64_t)iy);
    float gx = random_range(key, -1.0f, 1.0f), gy = random_range(key + 1, -1.0f, 1.0f);
    return gx * dx + gy * dy;
}

float noise_plane(float x, float y, uint64_t seed)
{
    float fx = floorf(x), fy = floorf(y), dx = x - fx, dy = y - fy;
    int64_t ix = (int64_t)fx, iy = (int64_t)fy;
    float u = fade(dx), v = fade(dy);
    float low = lerpf(corner(ix, iy, dx, dy, seed), corner(ix + 1, iy, dx - 1.0f, dy, seed), u);
    float high = lerpf(corner(ix, iy + 1, dx, dy - 1.0f, seed),
                       corner(ix + 1, iy + 1, dx - 1.0f, dy - 1.0f, seed), u);
    return lerpf(low, high, v);
}

float noise_plane_fractal(float x, float y, int octaves, uint64_t seed)
{
    float sum = 0.0f, height = 1.0f;
    for (int i = 0; i < octaves; i++) {
        sum += height * noise_plane(x, y, random_key(seed, (uint64_t)i));
        x = 2.0f * x + 17.3f;
        y = 2.0f * y - 5.1f;
        height *= 0.5f;
    }
    return sum;
}

// Dot product of a corner's hashed gradient with the offset from that corner.
static float space_corner(const int64_t cell[3], int corner_bits, Vec3 offset, uint64_t seed)
{
    uint64_t key = seed;
    float d[3] = {offset.x, offset.y, offset.z}, dot = 0.0f;
    for (int i = 0; i < 3; i++) {
        key = random_key(key, (uint64_t)(cell[i] + (corner_bits >> i & 1)));
    }
    for (int i = 0; i < 3; i++) {
        float gradient = random_range(key + (uint64_t)i, -1.0f, 1.0f);
        dot += gradient * (d[i] - (float)(corner_bits >> i & 1));
    }
    return dot;
}

float noise_space(Vec3 p, uint64_t seed)
{
    Vec3 low = vec3(floorf(p.x), floorf(p.y), floorf(p.z)), d = vec3_sub(p, low);
    const int64_t cell[3] = {(int64_t)low.x, (int64_t)low.y, (int64_t)low.z};
    float u = fade(d.x), v = fade(d.y), w = fade(d.z), plane[2];
    for (int z = 0; z < 2; z++) {
        float row[2];
        for (int y = 0; y < 2; y++) {
            int bits = z << 2 | y << 1;
            row[y] =
                lerpf(space_corner(cell, bits, d, seed), space_corner(cell, bits | 1, d, seed), u);
        }
        plane[z] = lerpf(row[0], row[1], v);
    }
    return lerpf(plane[0], plane[1], w);
}
