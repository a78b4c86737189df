// The user's uplift map: strokes and picture.
#include "base/noise.h"
#include "base/random.h"
#include "objects/common/grey.h"
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

static float strokes_at(const UpliftParams *uplift, float u, float v)
{
    float sum = 0.0f;
    for (int i = 0; i < uplift->stroke_count; i++) {
        const UpliftStroke *stroke = &uplift->strokes[i];
        float share = stroke_distance(stroke, u, v) / stroke->radius;
        sum += stroke->strength * (1.0f - smoothstepf(0.0f, 1.0f, share));
    }
    return sum;
}

float terrain_stroke_uplift(const UpliftParams *uplift, float u, float v)
{
    float sum = 1.0f + strokes_at(uplift, u, v) / fmaxf(uplift->base, 0.02f);
    return fmaxf(sum, 0.02f);
}

static float uplift_at(const TerrainParams *params, const Image *image, uint64_t seed, Vec3 p)
{
    const UpliftParams *uplift = &params->uplift;
    float u = p.x / params->size, v = p.z / params->size;
    float sum = uplift->base;
    sum *= 1.0f + 1.4f * uplift->noise *
                      noise_plane_fractal(u * 4.0f, v * 4.0f, 2, random_key(seed, STREAM_UPLIFT));
    sum += strokes_at(uplift, u, v);
    if (image) {
        sum *= grey_at(image, u + 0.5f, v + 0.5f);
    }
    return sum > 0.02f ? sum : 0.02f;
}

bool terrain_uplift(Terrain *terrain, const Run *run, Error *e)
{
    const char *file = terrain->params->uplift.image;
    Image *image = file ? grey_read(file, run, e) : NULL;
    if (file && !image) {
        return error_key(e, "uplift.image");
    }
    const OutTree *rivers = terrain->tree;
    for (int64_t i = 0; i < rivers->count; i++) {
        terrain->uplift[i] = uplift_at(terrain->params, image, terrain->seed, rivers->position[i]);
    }
    image_free(image);
    return true;
}
