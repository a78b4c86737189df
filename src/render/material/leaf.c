// A thin sheet: diffuse reflection and transmission under a glossy coat.
#include "base/color.h"
#include "render/material/layered.h"

// Bounds the sum of reflectance and transmittance by 1.
static void bound_colors(Bsdf *b)
{
    Vec3 sum = vec3_max(vec3_add(b->color, b->transmittance), vec3_splat(1.0f));
    b->color = vec3(b->color.x / sum.x, b->color.y / sum.y, b->color.z / sum.z);
    b->transmittance =
        vec3(b->transmittance.x / sum.x, b->transmittance.y / sum.y, b->transmittance.z / sum.z);
    b->albedo = vec3_add(b->color, b->transmittance);
}

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    bool underside = point->backface;
    if (underside && vec3_largest(entry->material.underside_color) > 0.0f) {
        b->color = entry->material.underside_color;
    } else if (underside) { // paler and greyer
        float grey = luminance(b->color);
        b->color = vec3_scale(vec3_lerp(b->color, vec3_splat(grey), 0.3f), 1.45f);
    }
    b->transmittance = vec3_max(b->transmittance, vec3_splat(0.0f));
    bound_colors(b);
    layered_add_coat(b, entry->material.specular, underside ? 0.4f : 1.0f, cos_o); // less wax below
    layered_finish(b, cos_o);
}

static void describe(const Material *m, Appearance *a)
{
    appearance_add_coat(a, m->specular);
}

// A green oak leaf near 610, 550 and 450 nm (PROSPECT-5, chlorophyll 40).
static void defaults(Material *m)
{
    m->color = vec3(0.087f, 0.149f, 0.046f);
    m->transmittance = vec3(0.060f, 0.110f, 0.012f);
    m->autumn_color = vec3(0.330f, 0.175f, 0.035f);
}

const MaterialOps leaf_ops = {.traits = TRAIT_PATTERNED,
                              .defaults = defaults,
                              .describe = describe,
                              .tabulate = layered_tabulate,
                              .prepare = prepare,
                              .eval = layered_eval,
                              .draw = layered_draw};
