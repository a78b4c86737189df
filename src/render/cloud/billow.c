#include "render/cloud/billow.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

enum { SIDE = 64, MASK = SIDE - 1 };

struct Billow {
    uint8_t texel[SIDE][SIDE][SIDE]; // z, y, x
};

// Distance to the nearest of the points, one in each of cells^3 cells of the unit cube, in cells.
static float nearest_point(Vec3 p, int cells, uint64_t key)
{
    int ix = (int)floorf(p.x), iy = (int)floorf(p.y), iz = (int)floorf(p.z);
    float best = 3.0f;
    for (int k = 0; k < 27; k++) {
        int x = ix + k % 3 - 1, y = iy + k / 3 % 3 - 1, z = iz + k / 9 - 1;
        int wrapped =
            ((z + cells) % cells * cells + (y + cells) % cells) * cells + (x + cells) % cells;
        uint64_t own = random_key(key, (uint64_t)wrapped);
        Vec3 q = vec3((float)x + random_unit(own), (float)y + random_unit(own + 1),
                      (float)z + random_unit(own + 2));
        Vec3 d = vec3_sub(q, p);
        best = fminf(best, vec3_dot(d, d));
    }
    return sqrtf(best);
}

static float bumps(Vec3 p, uint64_t key)
{
    float sum = 0.0f, weight = 0.6f;
    for (uint64_t octave = 0; octave < 3; octave++, weight *= 0.5f) {
        int cells = 4 << octave;
        float d = nearest_point(vec3_scale(p, (float)cells), cells, random_key(key, octave));
        sum += weight * (1.1f - 2.0f * d);
    }
    return clampf(sum, -1.0f, 1.0f);
}

Billow *billow_new(uint64_t key, const Run *run, Error *e)
{
    Billow *billow = memory_alloc(1, sizeof *billow, e);
    if (!billow) {
        return NULL;
    }
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < SIDE; z++) {
        for (int i = 0; i < SIDE * SIDE; i++) {
            int x = i % SIDE, y = i / SIDE;
            Vec3 p = vec3_scale(vec3((float)x, (float)y, (float)z), 1.0f / SIDE);
            billow->texel[z][y][x] = (uint8_t)lrintf(127.5f + 127.5f * bumps(p, key));
        }
    }
    return billow;
}

void billow_free(Billow *billow)
{
    free(billow);
}

static float row(const Billow *b, int z, int y, int x, float u)
{
    float left = b->texel[z & MASK][y & MASK][x & MASK];
    return left + u * ((float)b->texel[z & MASK][y & MASK][(x + 1) & MASK] - left);
}

float billow_at(const Billow *b, Vec3 p)
{
    p = vec3_scale(p, SIDE);
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    int x = (int)fx, y = (int)fy, z = (int)fz;
    float u = p.x - fx, v = p.y - fy, w = p.z - fz;
    float near = lerpf(row(b, z, y, x, u), row(b, z, y + 1, x, u), v);
    float far = lerpf(row(b, z + 1, y, x, u), row(b, z + 1, y + 1, x, u), v);
    return lerpf(near, far, w) * (1.0f / 127.5f) - 1.0f;
}
