// A surface that shines evenly to all sides and reflects nothing.
#include "render/material/material_ops.h"

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    (void)point;
    (void)cos_o;
    b->emission = entry->material.radiance;
    b->color = b->albedo = vec3_splat(0.0f);
    b->delta = true; // no lobes
}

static void describe(const Material *m, Appearance *a)
{
    a->color = vec3_splat(0.0f);
    a->emission = m->radiance;
}

static void defaults(Material *m)
{
    m->radiance = vec3_splat(1.0f);
}

const MaterialOps emission_ops = {.traits = TRAIT_EMISSIVE | TRAIT_OPAQUE,
                                  .defaults = defaults,
                                  .describe = describe,
                                  .prepare = prepare};
