// Diffuse reflection under a dielectric coat, or metal, or a mixture.
#include "render/material/layered.h"

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    (void)point;
    float metallic = clampf(entry->material.metallic, 0.0f, 1.0f);
    layered_add_coat(b, entry->material.specular, 1.0f, cos_o);
    layered_add_metal(b, b->color, metallic, cos_o);
    b->specular = vec3_lerp(b->specular, b->color, metallic);
    b->grazing = lerpf(b->grazing, 1.0f, metallic);
    b->color = vec3_scale(b->color, 1.0f - metallic);
    b->transmittance = vec3_splat(0.0f);
    layered_finish(b, cos_o);
}

static void describe(const Material *m, Appearance *a)
{
    a->metalness = m->metallic;
    appearance_add_coat(a, m->specular);
}

const MaterialOps principled_ops = {.traits = TRAIT_OPAQUE | TRAIT_PATTERNED,
                                    .describe = describe,
                                    .tabulate = layered_tabulate,
                                    .prepare = prepare,
                                    .eval = layered_eval,
                                    .draw = layered_draw};
