#include "mesh/wood.h"

#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>

enum { CHECKS = 9 }; // around the pith, of all widths
enum {
    SEED_PITH = 5101,
    SEED_CHECK = 5115,
    SEED_KNOT = 5121,
    SEED_WAVE = 5131,
    SEED_GRAIN = 5141,
    SEED_STEM = 5151
};

static const float knot_rows = 0.15f; // m, of the stem for each knot

// Around the pith: an angle, rad, in (-pi, pi].
static float turned(float angle)
{
    return angle > PI_F ? angle - 2.0f * PI_F : angle <= -PI_F ? angle + 2.0f * PI_F : angle;
}

static Vec3 from_pith(Vec3 p)
{
    const float off = 0.012f; // m
    return vec3(p.x - off * noise_plane(p.y / 0.7f, 0.5f, SEED_PITH), p.y,
                p.z - off * noise_plane(p.y / 0.7f, 0.5f, SEED_PITH + 1));
}

// Checks are radial. Some are wide; along the stem they open, close and begin anew.
static void add_check(WoodPlace *place, float angle, float y, int number)
{
    const float step = 2.0f * PI_F / CHECKS;
    int own = ((number % CHECKS) + CHECKS) % CHECKS;
    uint64_t key = random_key(SEED_CHECK, (uint64_t)own);
    float row = 3.7f * (float)own, wide = smoothstepf(0.6f, 0.8f, random_unit(key));
    float jitter = random_range(random_key(key, 1), 0.2f, 0.8f);
    float wander = 0.25f * noise_plane(y / 0.19f, row, SEED_CHECK + 1) +
                   0.06f * noise_plane(y / 0.03f, row, SEED_CHECK + 2);
    float off = turned(angle - step * ((float)number + jitter) - wander);
    float open = noise_plane(y / lerpf(0.16f, 0.5f, wide), row, SEED_CHECK + 3);
    open = smoothstepf(-0.25f, 0.2f, open + lerpf(-0.05f, 0.35f, wide));
    float inward = smoothstepf(0.006f, 0.04f, place->radius);
    float half = lerpf(0.0008f, 0.0034f, wide) * sqrtf(open) * inward; // m
    float t = half > 1e-5f ? fabsf(place->radius * off) / half : 1.0f;
    float check = t < 1.0f ? 1.0f - t * t : 0.0f;
    if (check > place->check) {
        place->check = check;
        place->depth = lerpf(0.25f, 1.0f, wide) * (0.4f + 0.6f * open);
    }
}

// Fibres pass a knot as a stream passes a round pillar (the potential flow around a cylinder),
// drawn out along the stem. Returns the way, m, by which they were pushed aside.
static float add_knot(WoodPlace *place, float angle, float y, float row)
{
    uint64_t key = random_key(SEED_KNOT, (uint64_t)(int64_t)row);
    if (random_unit(key) > 0.8f) {
        return 0.0f;
    }
    float at = knot_rows * (row + random_range(random_key(key, 1), 0.2f, 0.8f));
    float size = random_range(random_key(key, 2), 0.006f, 0.014f);
    float side = random_range(random_key(key, 3), -PI_F, PI_F);
    float off = turned(angle - side), across = place->radius * off, along = y - at;
    float flow = across * across + along * along / 5.0f;
    float within = sqrtf(across * across + 0.7f * along * along) / size;
    float knot = 1.0f - smoothstepf(0.0f, 1.0f, within);
    place->knot = knot > place->knot ? knot : place->knot;
    float inside = size * size, near = 1.0f - fabsf(off) / PI_F; // 0 on the other side of the stem
    return -across * near * inside / (flow > inside ? flow : inside);
}

WoodPlace wood_place(Vec3 p)
{
    Vec3 q = from_pith(p);
    float radius = sqrtf(q.x * q.x + q.z * q.z), angle = exact_atan2(q.x, q.z);
    WoodPlace place = {.radius = radius};
    int sector = (int)floorf(angle * (CHECKS / (2.0f * PI_F)));
    for (int i = -1; i <= 1; i++) {
        add_check(&place, angle, p.y, sector + i);
    }
    Vec3 wave = vec3(q.x / 0.05f, q.y / 0.24f, q.z / 0.05f);
    float aside = 0.012f * noise_space(wave, SEED_WAVE) + 0.1f * radius * p.y;
    float row = floorf(p.y / knot_rows);
    for (int i = -1; i <= 1; i++) {
        aside += add_knot(&place, angle, p.y, row + (float)i);
    }
    float turn = aside / (radius > 0.01f ? radius : 0.01f), sine, cosine;
    exact_sincos(turn, &sine, &cosine);
    place.grain = vec3(cosine * q.x + sine * q.z, p.y, cosine * q.z - sine * q.x);
    return place;
}

float wood_end(Vec3 normal)
{
    return smoothstepf(0.6f, 0.85f, fabsf(normal.y));
}

static float fibres(const WoodPlace *place, float across, float along, uint64_t seed)
{
    Vec3 g = place->grain;
    return noise_space(vec3(g.x / across, g.y / along, g.z / across), seed);
}

float wood_grain_height(const WoodPlace *place, float end, float finest)
{
    float height = 0.0f, across = 0.011f, along = 0.3f, high = 0.0016f;
    for (uint64_t octave = 0; across >= finest && octave < 6; octave++) {
        float n = fibres(place, across, along, SEED_GRAIN + octave);
        float groove = 1.0f - fabsf(n) / 0.12f; // narrow
        height += high * (0.6f * n - (groove > 0.0f ? 0.5f * groove : 0.0f));
        across *= 0.45f;
        along *= 0.5f;
        high *= 0.55f;
    }
    return (1.0f - 0.85f * end) * (height * (1.0f - 0.7f * place->knot) + 0.0015f * place->knot);
}

float wood_relief(Vec3 p, Vec3 normal, float finest, float check_depth)
{
    WoodPlace place = wood_place(p);
    float swell =
        0.014f * noise_space(vec3(p.x / 0.09f, p.y / 0.32f, p.z / 0.09f), SEED_STEM) +
        0.005f * noise_space(vec3(p.x / 0.035f, p.y / 0.15f, p.z / 0.035f), SEED_STEM + 1);
    return swell + wood_grain_height(&place, wood_end(normal), finest) -
           check_depth * place.depth * place.check;
}
