// How much hoar frost grows where.
#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/common/hoar.h"
#include "objects/common/hoar_tufts.h"

#include <math.h>

Vec3 hoar_against(const HoarParams *params)
{
    float sine, cosine;
    exact_sincos(params->wind * RADIANS_PER_DEGREE, &sine, &cosine);
    return vec3(-sine, 0.0f, -cosine);
}

// A level surface sees the share (1 + up) / 2 of the sky.
float hoar_sky_share(const HoarParams *params, float up, float open)
{
    const float least = 0.1f;
    float share = lerpf(1.0f, 0.5f * (1.0f + up) * open, params->sky);
    return share < least ? 0.0f : share;
}

// A unit sphere about k * against, seen from the origin inside: the way t to its surface, and the
// share of the surface in a solid angle, t^2 / cosine of the surface's slope.
float hoar_wind_share(const HoarParams *params, float cosine)
{
    float b = params->bias;
    if (b >= 0.5f) {
        return cosine > 0.0f ? 4.0f * cosine : 0.0f;
    }
    float k = b / (1.0f - b), slope = sqrtf(1.0f - k * k * (1.0f - cosine * cosine));
    float t = k * cosine + slope;
    return t * t / slope;
}

// A branch of length 1 bears (1 + 1.5 radius / length) / (spacing * length) tufts on an area of
// 2 pi radius.
float hoar_tufts_per_area(const HoarParams *params, float radius)
{
    float length = params->length, least = 0.1f * length; // needles hide what is finer
    float r = radius > least ? radius : least;
    return params->density * (1.0f + 1.5f * r / length) / (HOAR_SPACING * length * 2.0f * PI_F * r);
}

enum { SEED_PATCH = 0x40a9 };

// With variety most tufts are short, few long, and these stand in patches: where crystals began
// early they take the vapour from those around.
float hoar_size_share(const HoarParams *params, Vec3 p, uint64_t key)
{
    float even = random_range(key, 0.35f, 1.2f);
    if (params->variety <= 0.0f) {
        return even;
    }
    float unit = random_unit(random_key(key, 1));
    Vec3 q = vec3_scale(p, 1.0f / (2.2f * params->length));
    float patch = 0.75f + 2.2f * noise_space(q, SEED_PATCH) +
                  1.4f * noise_space(vec3_scale(q, 0.3f), SEED_PATCH + 1);
    float share = lerpf(even, (0.2f + 1.3f * unit * unit * unit) * patch, params->variety);
    return share > 0.12f ? share : 0.0f;
}
