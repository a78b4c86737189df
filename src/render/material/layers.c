#include "render/material/layers.h"

#include "base/random.h"
#include "render/material/layered.h"
#include "render/material/maps.h"
#include "render/material/mask.h"
#include "render/material/pattern_noise.h"

#include <string.h>

static LayerMix mix_of(const MaterialEntry *entry, const Bsdf *b)
{
    const Material *m = &entry->material;
    bool coated = m->kind == MATERIAL_PRINCIPLED;
    return (LayerMix){coated ? 1.0f : 0.0f, m->specular, clampf(m->metallic, 0.0f, 1.0f),
                      b->roughness, b->roughness};
}

// The mean of a value that two shares of the surface have.
static float mean(float a, float share_a, float b, float share_b)
{
    float sum = share_a + share_b;
    return sum > 0.0f ? (a * share_a + b * share_b) / sum : a;
}

// Lays `top` on the surface below, over a share of it.
static void lay(LayerMix *below, const LayerMix *top, float share)
{
    float old = (1.0f - share) * below->coated, fresh = share * top->coated;
    float dull = (1.0f - share) * (1.0f - below->coated), more = share * (1.0f - top->coated);
    below->specular = mean(below->specular, old, top->specular, fresh);
    below->metallic = mean(below->metallic, old, top->metallic, fresh);
    below->roughness = mean(below->roughness, old, top->roughness, fresh);
    below->dull_roughness = mean(below->dull_roughness, dull, top->dull_roughness, more);
    below->coated = old + fresh;
}

// Noise moves the places where the mask is looked up, so that borders are ragged at close range. It
// moves them along the surface: across a steep wall, whose top and foot lie side by side in plan,
// it would look up now the one, now the other.
static float share_at(const MaterialLayer *layer, const Mask *mask, const SurfacePoint *point)
{
    Vec3 p = point->object_position;
    if (layer->fray > 0.0f) {
        Vec3 q = vec3_scale(p, 0.25f / layer->fray), n = surface_smooth_normal(point);
        Vec3 moved = {noise_fractal(q, 5, 211), noise_fractal(q, 5, 235), noise_fractal(q, 5, 223)};
        moved = vec3_madd(moved, -vec3_dot(moved, n), n);
        p = vec3_madd(p, layer->fray, moved);
    }
    return clampf(layer->strength * mask_at(mask, p.x, p.z), 0.0f, 1.0f);
}

// 0..1 by the place alone.
static float random_of_place(Vec3 p)
{
    uint32_t bits[3];
    memcpy(bits, &p, sizeof bits);
    return random_unit(random_key(((uint64_t)bits[0] << 32) | bits[1], bits[2]));
}

// The lobes of diffuse or of principled with the mix's roughness.
static void choose_lobes(const MaterialEntry *entry, const LayerMix *mix, bool coated, Bsdf *b)
{
    b->ops = material_ops(coated ? MATERIAL_PRINCIPLED : MATERIAL_DIFFUSE);
    b->traits = b->ops->traits;
    b->lambert = !coated && mix->dull_roughness <= 0.0f;
    b->alpha = 0.0f;
    if (coated) {
        maps_set_roughness(entry, mix->roughness, b);
    } else {
        b->roughness = mix->dull_roughness;
    }
}

// Displacement is that of the material below; a layer's own relief is bumps on it.
static bool has_same_relief(const Material *top, const Material *below)
{
    return top->pattern == below->pattern && top->pattern_scale == below->pattern_scale;
}

bool layers_mix(const MaterialSet *set, const MaterialEntry *entry, const SurfacePoint *point,
                Bsdf *b, LayerMix *mix)
{
    const MaskSet *masks = set->masks;
    int first = masks && point->part < masks->part_count ? masks->of_part[point->part] : -1;
    bool mixed = false;
    SurfacePoint own = *point;
    *mix = mix_of(entry, b);
    for (int i = 0; first >= 0 && i < entry->material.layer_count; i++) {
        const MaterialEntry *top = &set->entry[entry->layer[i]];
        float share = share_at(&entry->material.layers[i], &masks->mask[first + i], point);
        if (share <= 0.0f) {
            continue;
        }
        own.displaced = has_same_relief(&top->material, &entry->material) ? point->displaced : 0.0f;
        Bsdf shade;
        bsdf_shade(top, &own, &shade);
        LayerMix other = mix_of(top, &shade);
        lay(mix, &other, share);
        b->color = vec3_lerp(b->color, shade.color, share);
        b->normal = vec3_normalize(vec3_lerp(b->normal, shade.normal, share));
        mixed = true;
    }
    if (mixed) {
        choose_lobes(entry, mix, random_of_place(point->position) < mix->coated, b);
    }
    return mixed;
}

void layers_prepare(const LayerMix *mix, Bsdf *b, float cos_o)
{
    if (b->ops->prepare) {
        layered_prepare(b, mix->specular, mix->metallic, cos_o);
    }
}
