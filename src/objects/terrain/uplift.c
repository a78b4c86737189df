// Where the land rises faster: what the user paints.
#include "base/noise.h"
#include "base/random.h"
#include "objects/terrain/internal.h"

// Distance from p to the line from a to b.
static float stroke_distance(const UpliftStroke *stroke, float x, float z)
{
    float dx = stroke->to[0] - stroke->from[0], dz = stroke->to[1] - stroke->from[1];
    float px = x - stroke->from[0], pz = z - stroke->from[1];
    float length2 = dx * dx + dz * dz;
    float t = length2 > 0.0f ? clampf((px * dx + pz * dz) / length2, 0.0f, 1.0f) : 0.0f;
    px -= t * dx;
    pz -= t * dz;
    return sqrtf(px * px + pz * pz);
}

// The picture, bilinear; u and v run from 0 at its north-west corner to 1.
static float image_at(const UpliftParams *uplift, float u, float v)
{
    int width = uplift->image_size[0], height = uplift->image_size[1];
    float x = clampf(u * (float)width - 0.5f, 0.0f, (float)(width - 1));
    float y = clampf(v * (float)height - 0.5f, 0.0f, (float)(height - 1));
    int column = (int)x, row = (int)y;
    int next_column = column + 1 < width ? column + 1 : column;
    int next_row = row + 1 < height ? row + 1 : row;
    const float *p = uplift->image_pixels;
    float above = lerpf(p[(int64_t)row * width + column], p[(int64_t)row * width + next_column],
                        x - (float)column);
    float below = lerpf(p[(int64_t)next_row * width + column],
                        p[(int64_t)next_row * width + next_column], x - (float)column);
    return lerpf(above, below, y - (float)row);
}

float terrain_uplift(const TerrainParams *params, uint64_t seed, float x, float z)
{
    const UpliftParams *uplift = &params->uplift;
    float u = x / params->size, v = z / params->size;
    float sum = uplift->base;
    sum *= 1.0f +
           1.4f * uplift->noise * noise_plane_fractal(u * 4.0f, v * 4.0f, 2, random_key(seed, 31));
    for (int i = 0; i < uplift->stroke_count; i++) {
        const UpliftStroke *stroke = &uplift->strokes[i];
        float share = stroke_distance(stroke, u, v) / stroke->radius;
        sum += stroke->strength * (1.0f - smoothstepf(0.0f, 1.0f, share));
    }
    if (uplift->image_pixels) {
        sum *= image_at(uplift, u + 0.5f, v + 0.5f);
    }
    return sum > 0.02f ? sum : 0.02f;
}
