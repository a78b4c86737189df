#include "render/material/material.h"

#include "render/material/material_ops.h"

static const MaterialOps *const OPS[] = {
#define KIND(NAME, name) [MATERIAL_##NAME] = &name##_ops,
    MATERIAL_KINDS(KIND)
#undef KIND
};

const MaterialOps *material_ops(MaterialKind kind)
{
    return OPS[kind];
}

Material material_default(MaterialKind kind)
{
    Material m = {.kind = kind,
                  .color = vec3_splat(0.5f),
                  .color2 = vec3_splat(0.1f),
                  .roughness = 0.5f,
                  .specular = 0.5f,
                  .ior = 1.5f,
                  .veins = 7.0f,
                  .mortar = {0.42f, 0.375f, 0.30f}};
    if (OPS[kind]->defaults) {
        OPS[kind]->defaults(&m);
    }
    return m;
}

bool material_has(const Material *m, unsigned traits)
{
    return (OPS[m->kind]->traits & traits) == traits;
}

float material_shadow_opacity(const Material *m, float cosine)
{
    const MaterialOps *ops = OPS[m->kind];
    return ops->shadow_opacity ? ops->shadow_opacity(m, cosine) : 1.0f;
}

Appearance material_appearance(const Material *m)
{
    const MaterialOps *ops = OPS[m->kind];
    Appearance a = {.traits = ops->traits,
                    .color = m->color,
                    .transmittance = m->transmittance,
                    .roughness = m->roughness,
                    .ior = 1.0f};
    if (ops->describe) {
        ops->describe(m, &a);
    }
    return a;
}

void appearance_add_coat(Appearance *a, float specular)
{
    float root = sqrtf(0.08f * specular);
    a->coated = true;
    a->specular = specular;
    a->ior = (1.0f + root) / (1.0f - root);
}
