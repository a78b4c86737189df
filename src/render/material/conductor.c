// Metal: a GGX lobe with multiple scattering between its facets. Smooth, it is a mirror.
#include "render/material/bsdf_ggx.h"
#include "render/material/layered.h"

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    (void)entry;
    (void)point;
    b->specular = b->color;
    b->grazing = 1.0f;
    layered_add_metal(b, b->color, 1.0f, cos_o);
    b->color = b->transmittance = vec3_splat(0.0f);
    b->delta = b->alpha <= 0.0f;
    layered_finish(b, cos_o);
}

static bool sample_delta(const Bsdf *b, Vec3 wo, const float u[3], BsdfSample *sample)
{
    (void)u;
    float cosine = vec3_dot(b->normal, wo);
    float s = schlick_weight(cosine);
    sample->wi = vec3_sub(vec3_scale(b->normal, 2.0f * cosine), wo);
    sample->weight = vec3_add(vec3_scale(b->specular, 1.0f - s), vec3_splat(b->grazing * s));
    sample->transmitted = false;
    return true;
}

static bool tabulate(MaterialEntry *entry, MaterialSet *set, Error *e)
{
    bool mirror = material_entry_is_mirror(entry);
    if (!layered_tabulate(entry, set, e)) {
        return false;
    }
    entry->alpha = mirror ? 0.0f : entry->alpha;
    return true;
}

static void describe(const Material *m, Appearance *a)
{
    (void)m;
    a->metalness = 1.0f;
}

static void defaults(Material *m)
{
    m->color = vec3_splat(0.9f);
    m->roughness = 0.3f;
}

const MaterialOps conductor_ops = {.traits = TRAIT_OPAQUE | TRAIT_PATTERNED | TRAIT_MIRROR,
                                   .defaults = defaults,
                                   .describe = describe,
                                   .tabulate = tabulate,
                                   .prepare = prepare,
                                   .eval = layered_eval,
                                   .draw = layered_draw,
                                   .sample_delta = sample_delta};
