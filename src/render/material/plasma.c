#include "render/material/plasma.h"

#include "base/color.h"
#include "render/material/material_ops.h"

#include <math.h>

// Of soft gas, the power of the cosine: 1 is the chord of a body that glows evenly.
static const float SHARPEST = 8.0f;

// A curve seen along its axis is deeper, but not endless.
static const float LEAST_ACROSS = 0.25f;

// The chord through a round body at a cosine is that much of the one through its middle. For a
// curve the cosine is at most the sine between ray and axis, and the chord is longer by as much.
Vec3 plasma_radiance(const Material *m, const SurfacePoint *point, Vec3 direction)
{
    if (point->backface) {
        return vec3_splat(0.0f);
    }
    float cosine = fmaxf(-vec3_dot(point->geometric_normal, direction), 0.0f), across = 1.0f;
    if (point->radius > 0.0f && !point->has_uv) {
        float along = vec3_dot(point->tangent_v, direction);
        across = fmaxf(sqrtf(fmaxf(1.0f - along * along, 0.0f)), LEAST_ACROSS);
    }
    float power = lerpf(1.0f, SHARPEST, m->roughness);
    float share = powf(fminf(cosine / across, 1.0f), power) / across;
    Vec3 tint = vec3_lerp(vec3_splat(1.0f), m->color2, clampf(point->birth, 0.0f, 1.0f));
    return vec3_scale(vec3_mul(m->radiance, tint), share);
}

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    (void)entry;
    (void)point;
    (void)cos_o;
    b->color = b->albedo = vec3_splat(0.0f);
    b->delta = true; // no lobes
}

// Files of other programs show its body as a lamp.
static void describe(const Material *m, Appearance *a)
{
    a->traits |= TRAIT_EMISSIVE;
    a->color = vec3_splat(0.0f);
    a->emission = m->radiance;
}

static void defaults(Material *m)
{
    m->radiance = m->color2 = vec3_splat(1.0f);
}

const MaterialOps plasma_ops = {
    .traits = TRAIT_GAS, .defaults = defaults, .describe = describe, .prepare = prepare};
