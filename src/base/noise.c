#include "base/noise.h"

#include "base/random.h"

static float fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// Dot product of a corner's hashed gradient with the offset from that corner. key: of its column
// and row.
static float corner(uint64_t key, float dx, float dy)
{
    float gx = random_range(key, -1.0f, 1.0f), gy = random_range(key + 1, -1.0f, 1.0f);
    return gx * dx + gy * dy;
}

float noise_plane(float x, float y, uint64_t seed)
{
    float fx = floorf(x), fy = floorf(y), dx = x - fx, dy = y - fy;
    uint64_t ix = (uint64_t)(int64_t)fx, iy = (uint64_t)(int64_t)fy;
    uint64_t left = random_key(seed, ix), right = random_key(seed, ix + 1);
    float u = fade(dx), v = fade(dy);
    float low = lerpf(corner(random_key(left, iy), dx, dy),
                      corner(random_key(right, iy), dx - 1.0f, dy), u);
    float high = lerpf(corner(random_key(left, iy + 1), dx, dy - 1.0f),
                       corner(random_key(right, iy + 1), dx - 1.0f, dy - 1.0f), u);
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

// Dot product of a corner's hashed gradient with the offset from it. key: of its cell.
static float space_corner(uint64_t key, float dx, float dy, float dz)
{
    return random_range(key, -1.0f, 1.0f) * dx + random_range(key + 1, -1.0f, 1.0f) * dy +
           random_range(key + 2, -1.0f, 1.0f) * dz;
}

float noise_space(Vec3 p, uint64_t seed)
{
    Vec3 low = vec3(floorf(p.x), floorf(p.y), floorf(p.z)), d = vec3_sub(p, low);
    uint64_t ix = (uint64_t)(int64_t)low.x, iy = (uint64_t)(int64_t)low.y;
    uint64_t iz = (uint64_t)(int64_t)low.z, key[2][2]; // of columns along z
    for (uint64_t x = 0; x < 2; x++) {
        uint64_t side = random_key(seed, ix + x);
        key[x][0] = random_key(side, iy);
        key[x][1] = random_key(side, iy + 1);
    }
    float u = fade(d.x), v = fade(d.y), w = fade(d.z), plane[2];
    for (uint64_t z = 0; z < 2; z++) {
        float row[2];
        for (int y = 0; y < 2; y++) {
            float dy = d.y - (float)y, dz = d.z - (float)z;
            row[y] = lerpf(space_corner(random_key(key[0][y], iz + z), d.x, dy, dz),
                           space_corner(random_key(key[1][y], iz + z), d.x - 1.0f, dy, dz), u);
        }
        plane[z] = lerpf(row[0], row[1], v);
    }
    return lerpf(plane[0], plane[1], w);
}
