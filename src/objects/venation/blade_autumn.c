#include "objects/venation/blade_autumn.h"

#include "base/mesh.h"
#include "objects/venation/vein_paint.h"
#include "render/material/pattern_noise.h"

#include <math.h>

#define PATCH 0.22f // of the length: wavelength of patches that turn early
#define FRAY 0.05f  // of the length: wavelength by which green bands along veins widen and fade

// -1..1 over the leaf, with features this long (in its lengths).
static float mottle(const VenationParams *params, Vec3 p, float size, uint32_t number)
{
    Vec3 at = vec3_scale(p, 1.0f / (size * params->outline.length));
    at.z = 0.4f; // between the zeros of the noise
    return noise_fractal(at, 4, (uint32_t)params->outline.key + number);
}

// How long tissue at p stays green, 0..1 and somewhat beyond. band: share of a thick vein's band
// there; areole: of its areole's own, 0..1. The tip and the margin turn before the base.
static float lateness(const VenationParams *params, const BladeRow *row, Vec3 p, float band,
                      float areole)
{
    float full = row->half + row->more[p.x >= 0.0f], up = p.y / params->outline.length;
    float out = full > 0.0f ? fminf(fabsf(p.x) / full, 1.0f) : 1.0f;
    out = fmaxf(out, smoothstepf(0.6f, 1.0f, up));
    float green = band * clampf(0.75f + 1.1f * mottle(params, p, FRAY, 7), 0.1f, 1.4f);
    float patch = clampf(0.5f + 0.9f * mottle(params, p, PATCH, 3), 0.0f, 1.0f);
    return 0.5f * green + 0.2f * (1.0f - out * out * out) + 0.38f * (patch - 0.1f) +
           0.18f * areole + 0.12f * (0.5f - up);
}

// Mesh.withered of tissue that has gone this far, from 0 = green to 1 = dead: yellow for long, then
// brown and dry.
static float withered_at(float turned)
{
    float yellow = smoothstepf(0.1f, 0.6f, turned), brown = smoothstepf(0.78f, 0.95f, turned);
    return MESH_YELLOW * yellow + (MESH_BROWN - MESH_YELLOW) * brown +
           (1.0f - MESH_BROWN) * smoothstepf(0.95f, 1.15f, turned);
}

// The share of its own colour that a vein in the blade keeps until the tissue about it dies.
static float vein_keeps(float pale, float value)
{
    float vein = fmaxf(pale - VEIN_UNEVEN, 0.0f) / (1.0f - VEIN_UNEVEN);
    return 0.9f * smoothstepf(0.0f, 0.5f, vein) *
           (1.0f - smoothstepf(MESH_YELLOW, MESH_BROWN, value));
}

bool blade_autumn_paint(const VenationParams *params, const OutTree *tree, const float *pale,
                        int width, int height, float *withered, Error *e)
{
    Canvas canvas;
    if (!canvas_init(&canvas, params, width, height, withered, e)) {
        return false;
    }
    canvas_paint_veins(&canvas, tree, tree->position, VEIN_GREEN);
    for (int r = 0; r < height; r++) {
        for (int c = 0; c < width; c++) {
            size_t i = (size_t)r * (size_t)width + (size_t)c;
            float areole = pale && pale[i] < VEIN_UNEVEN ? 1.0f - pale[i] / VEIN_UNEVEN : 0.5f;
            Vec3 p = blade_pixel(&canvas.rows[r], width, c);
            float late = lateness(params, &canvas.rows[r], p, withered[i], areole);
            float value = withered_at(2.0f * params->autumn - 1.2f * late);
            withered[i] = value * (1.0f - vein_keeps(pale ? pale[i] : 0.0f, value));
        }
    }
    canvas_clear(&canvas);
    return true;
}
