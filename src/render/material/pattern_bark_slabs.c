// Plates of bark that stand between fissures and flake toward them in layers: of old pines, of the
// cork of birches.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

enum { LAYERS = 4 }; // of scales from the fissure's floor to a plate's top

// The distance to the plate's border, m, and how much of a fissure along the stem it is: 1, or 0
// for one across.
typedef struct Border {
    float distance, upright;
    float slope_u, slope_v; // of the distance
} Border;

// Sizes in metres. Distances are compressed along the stem, which this undoes.
static Border border_of(const CellPoint *cell, const StemPlace *place, float around, float along)
{
    float u = vec3_dot(cell->normal, place->along_u) / around, v = cell->normal.z / along;
    float length = fmaxf(sqrtf(u * u + v * v), 0.15f / around);
    float share = u * u / (length * length);
    return (Border){cell->border / length, share, u / length, v / length};
}

BarkPlate bark_add_plates(BarkLook *look, const StemPlace *place, float around, float along,
                          Vec3 wind, uint32_t seed)
{
    Vec3 torn, ragged, q = stem_lookup(place, around, along);
    noise_solid(vec3(3.3f * q.x, 3.3f * q.y, 6.0f * q.z), seed + 2, &torn);
    q = vec3_madd(vec3_madd(q, 0.30f, wind), 0.05f, torn);
    CellPoint cell = noise_cells_on(q, stem_out(place), seed);
    Border border = border_of(&cell, place, around, along);
    float own = noise_unit(cell.cell, 5), s = border.upright;
    float floor_width = around * lerpf(0.02f, 0.055f * (1.0f + 0.8f * wind.x), s);
    float flank = around * lerpf(0.14f, 0.34f, s) * (0.4f + 1.1f * noise_unit(cell.cell, 6));
    float fine = 0.26f * around;
    float n = noise_solid(stem_lookup(place, fine, 2.2f * fine), seed + 3, &ragged);
    const float wave = 0.42f, steep = 0.3f; // of a step's run that rises
    float x = LAYERS * ((border.distance - floor_width) / flank + wave * n);
    float below = clampf(floorf(x), 0.0f, LAYERS - 1.0f);
    float t = clampf((x - below) / steep, 0.0f, 1.0f), top = 0.75f + 0.25f * own;
    float rise = x <= 0.0f ? 0.0f : (below + t * t * (3.0f - 2.0f * t)) / LAYERS;
    float change = top * 6.0f * t * (1.0f - t) / steep;
    stem_add_relief(look, place, top * rise, change * wave, fine, 2.2f * fine, ragged);
    look->slope_u += change / flank * border.slope_u;
    look->slope_v += change / flank * border.slope_v;
    float lower = noise_unit(cell.cell, 20u + (uint32_t)below);
    return (BarkPlate){.rise = rise,
                       .edge = 4.0f * t * (1.0f - t),
                       .layer = lerpf(lower, noise_unit(cell.cell, 21u + (uint32_t)below), t),
                       .own = own};
}
