// Diffuse reflection under a dielectric coat, or metal, or a mixture.
#include "render/material/layered.h"

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    (void)point;
    float metallic = clampf(entry->material.metallic, 0.0f, 1.0f);
    // Foam faces all ways: it has no gloss.
    layered_prepare(b, entry->material.specular * (1.0f - b->foam), metallic, cos_o);
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
