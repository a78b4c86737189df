#include "mesh/leaf/blade.h"

#include "base/exact_math.h"

Vec3 blade_point(const LeafParams *params, float x, float t, float ripple)
{
    float fold_sine, fold_cosine, sine, cosine;
    exact_sincos(params->fold * RADIANS_PER_DEGREE, &fold_sine, &fold_cosine);
    float lift = (x < 0.0f ? -x : x) * fold_sine + ripple;
    // The midrib bends by `curl` over the blade's length, mostly toward the tip.
    float angle = params->curl * RADIANS_PER_DEGREE * t * t;
    exact_sincos(angle, &sine, &cosine);
    float along = params->petiole + params->length * t * (1.0f - 0.12f * angle * angle);
    float down = params->length * t * sine * 0.4f;
    return vec3(x * fold_cosine, along + lift * sine, lift * cosine - down);
}

// One quad: left, base, right and tip, since Embree folds a quad along the line from its second
// corner to its fourth.
static void add_kite(Quads *quads, const LeafParams *params)
{
    const float widest = 0.55f, half = 0.5f * params->width;
    const float along[4] = {widest, 0.0f, widest, 1.0f}, side[4] = {-1.0f, 0.0f, 1.0f, 0.0f};
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        v[i] = quads_vertex(quads, blade_point(params, side[i] * half, along[i], 0.0f),
                            (Vec2){0.5f + 0.5f * side[i], along[i]});
    }
    quads_face(quads, v[0], v[1], v[2], v[3]);
}

void blade_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed)
{
    if (params->shape == LEAF_PAD) {
        blade_pad_add(quads, params, detail, seed);
    } else if (detail == BLADE_KITE) {
        add_kite(quads, params);
    } else if (params->shape == LEAF_PALMATE) {
        blade_palmate_add(quads, params, detail, seed);
    } else if (params->shape == LEAF_FAN) {
        blade_fan_add(quads, params, detail, seed);
    } else if (params->shape == LEAF_OAK) {
        blade_oak_add(quads, params, detail, seed);
    } else {
        blade_plain_add(quads, params, detail, seed);
    }
}
