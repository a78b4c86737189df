// Moss and lichen on bark. Moss grows where it is damp and shaded: at the foot, on sides that face
// up or away from the sun (-z here), in furrows first. Lichen grows where there is light, not on
// twigs.
#include "render/material/overgrowth.h"
#include "render/material/pattern_stem.h"

#include <math.h>

static void add_moss(const Material *m, const SurfacePoint *point, const StemPlace *place,
                     BarkSurface *bark)
{
    Vec3 n = surface_smooth_normal(point);
    float foot = expf(-fmaxf(place->height, 0.0f) / 0.5f);
    float damp = clampf(0.30f + 0.45f * n.y - 0.40f * n.z, 0.0f, 1.0f) + 0.55f * foot;
    float low = m->pattern_depth > 0.0f ? -bark->height / m->pattern_depth : 0.0f;
    Overgrowth moss = moss_at(m->moss, point, damp, low, fminf(0.009f, 0.2f * place->radius));
    float flat = 1.0f - 0.7f * moss.share;
    bark->form += moss.height;
    bark->height *= flat;
    bark->slope_u *= flat;
    bark->slope_v *= flat;
    bark->color = vec3_lerp(bark->color, moss.color, moss.share);
}

void bark_moss(const Material *m, const SurfacePoint *point, const StemPlace *place,
               BarkSurface *bark)
{
    const float twig = 0.012f; // m, radius
    if (m->lichen > 0.0f && place->radius > twig) {
        Overgrowth lichen = lichen_at(m->lichen, point);
        bark->form += lichen.height;
        bark->color = vec3_lerp(bark->color, lichen.color, lichen.share);
    }
    if (m->moss > 0.0f) {
        add_moss(m, point, place, bark);
    }
}
