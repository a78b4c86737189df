#include "render/material/pattern_damp.h"

#include "render/material/overgrowth.h"
#include "render/material/pattern.h"

enum { SEED_SEEP = 301, SEED_RUST = 311, SEED_LIME = 321, SEED_CUSHION = 331, SEED_BROAD = 341 };

#define THICKEST 0.03f // m, of moss
#define CUSHION 0.12f  // m: mean width of its cushions

// Streaks that start at cracks and ledges and run down for metres. 0..1.
static float streak(const SurfacePoint *point, float width, float over, uint32_t seed)
{
    float line = pattern_octaves(point, width, 4, 0.6f, 0.05f, seed).value;
    return smoothstepf(over, over + 0.4f, line);
}

// Colours that water leaves on a steep face: dark algae where it seeps, iron and lime beside it.
static Vec3 stained(float amount, const SurfacePoint *point, float steep, float seep, float broad,
                    Vec3 color)
{
    float rust = steep * streak(point, 0.42f, 0.15f - 0.3f * broad, SEED_RUST) * (1.0f - seep);
    float lime =
        steep * streak(point, 0.2f, 0.34f + 0.25f * broad, SEED_LIME) * (1.0f - 0.6f * seep);
    float value = (color.x + color.y + color.z) / 3.0f;
    Vec3 iron = {1.75f * value, 1.05f * value, 0.55f * value};
    Vec3 pale = {1.1f * value + 0.09f, 1.1f * value + 0.087f, 1.1f * value + 0.078f};
    color = vec3_lerp(color, iron, 0.7f * amount * rust);
    color = vec3_lerp(color, pale, 0.55f * amount * lime);
    Vec3 algae = {0.36f * color.x, 0.42f * color.y, 0.34f * color.z};
    return vec3_lerp(color, algae, 0.85f * amount * steep * seep);
}

Ground pattern_damp(float amount, const SurfacePoint *point, const Crags *crags, float upright,
                    Ground rock)
{
    if (amount <= 0.0f) {
        return rock;
    }
    float steep = smoothstepf(0.8f, 0.5f, upright);
    float broad = pattern_octaves(point, 3.5f, 4, 0.55f, 0.6f, SEED_BROAD).value;
    float seep = streak(point, 0.8f, 0.1f - 0.4f * broad, SEED_SEEP);
    rock.color = stained(amount, point, steep, seep, broad, rock.color);
    // Most where soil and water are held; least on smooth rock.
    float damp = 0.12f + 0.75f * crags->ledge + 0.45f * crags->crevice + 0.30f * steep * seep +
                 0.55f * (1.0f - steep) + 0.35f * broad;
    Overgrowth moss = moss_at(amount, point, clampf(damp, 0.0f, 1.2f), crags->crevice, THICKEST);
    if (moss.share <= 0.0f) {
        return rock;
    }
    PatternOctaves cushion = pattern_octaves(point, CUSHION, 3, 0.5f, 1.0f, SEED_CUSHION);
    Vec3 color = vec3_scale(moss.color, clampf(0.7f + 0.5f * cushion.value, 0.3f, 1.2f));
    Vec3 dry = vec3_scale(vec3(0.105f, 0.082f, 0.034f), 0.7f + 3.0f * moss.color.y);
    color = vec3_lerp(color, dry, 0.5f * smoothstepf(0.05f, 0.5f, cushion.value - broad));
    Ground mat = {.color = color};
    mat.slope = vec3_madd(vec3_scale(rock.slope, 0.5f), THICKEST, cushion.slope);
    return ground_blend(rock, &mat, moss.share);
}
