// The white bark of birches: fine lenticels across, thin sheets that come off in bands, black
// scars under shed limbs, black diamonds, and a foot of black, fissured cork that climbs the stem.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// A place relative to the middle of a mark on the stem, m, and the mark's random numbers.
typedef struct Mark {
    float u, v;
    float guard; // 0 at the border to the next mark's cell
    uint32_t hash;
} Mark;

// Marks about `around` and `along` metres apart. The middle of a cell may lie deep inside the stem:
// what counts is its direction from the axis.
static Mark mark_at(const StemPlace *place, float around, float along, uint32_t seed)
{
    Vec3 q = stem_lookup(place, around, along);
    CellPoint cell = noise_cells_on(q, stem_out(place), seed);
    Vec3 middle = vec3_madd(place->p, around, cell.point); // x, y: about the axis
    float angle = atan2f(middle.x * place->p.y - middle.y * place->p.x,
                         middle.x * place->p.x + middle.y * place->p.y);
    return (Mark){.u = angle * place->radius,
                  .v = -along * cell.point.z,
                  .guard = smoothstepf(0.0f, 0.05f, cell.border),
                  .hash = cell.cell};
}

// Lenticels: dashes across the stem, here and there, longer on thick stems. Returns how dark.
static float lenticels(const StemPlace *place, float around, float along, float share,
                       float footprint, uint32_t seed)
{
    Mark mark = mark_at(place, around, along, seed);
    float own = noise_unit(mark.hash, 2), thin = along * lerpf(0.06f, 0.13f, own);
    float seen = pattern_detail(8.0f * thin, footprint);
    if (noise_unit(mark.hash, 1) > share || seen <= 0.0f) {
        return 0.0f;
    }
    float half = around * lerpf(0.10f, 0.42f, noise_unit(mark.hash, 3) * own);
    float x = mark.u / half, y = mark.v / thin;
    return seen * mark.guard * smoothstepf(1.15f, 0.75f, sqrtf(x * x + y * y));
}

// Sheets of bark that come off in bands across; the skin below is salmon or cream.
static Vec3 add_peeling(BarkLook *look, const StemPlace *place, float scale, Vec3 white)
{
    const float around = 0.15f * scale, along = 0.040f * scale;
    Vec3 g, torn, q = stem_lookup(place, around, along);
    noise_solid(vec3(4.1f * q.x, 4.1f * q.y, 1.7f * q.z), 26, &torn);
    q = vec3_madd(q, 0.06f, torn);
    float where = noise_solid(stem_lookup(place, 0.5f * scale, 0.45f * scale), 29, NULL);
    float at = 0.36f - 0.14f * where;
    float n = noise_solid(q, 27, &g);
    float fresh = smoothstepf(at - 0.01f, at + 0.03f, n);
    float depth = smoothstepf(at + 0.06f, at + 0.3f, n); // bare for long: paler again
    float edge = clampf(1.0f - fabsf(n - at) / 0.035f, 0.0f, 1.0f);
    float curl = clampf(1.0f - fabsf(n - at + 0.05f) / 0.05f, 0.0f, 1.0f); // of the sheet's rim
    float away = n > at - 0.05f ? -1.0f : 1.0f;
    stem_add_relief(look, place, 0.30f * curl * curl - 0.12f * fresh,
                    curl > 0.0f ? 0.6f * curl * away / 0.05f : 0.0f, around, along, g);
    Vec3 salmon = vec3_mul(white, vec3(0.93f, 0.76f, 0.60f));
    Vec3 color = vec3_lerp(white, salmon, fresh * lerpf(0.85f, 0.35f, depth));
    color = vec3_scale(color, 1.0f + 0.10f * curl);
    return vec3_scale(color, 1.0f - 0.45f * edge);
}

// The scar of a shed limb: a black rhomb, and two arms that droop from its top to both sides.
// Returns how black, 0..1. torn: ragged edges.
static float moustache(const Material *m, const StemPlace *place, float scale, Vec3 torn)
{
    Mark mark = mark_at(place, 0.42f * scale, 0.50f * scale, 71);
    float chance = 0.30f + 0.70f * m->scars;
    if (noise_unit(mark.hash, 1) > chance) {
        return 0.0f;
    }
    float rank = noise_unit(mark.hash, 2);
    float span = lerpf(0.035f, 0.115f, rank * rank) * scale; // m: reach of an arm
    span = fminf(span, 1.3f * place->radius);
    float u = mark.u / span + 0.10f * torn.x, v = mark.v / span + 0.10f * torn.z;
    float side = fabsf(u), droop = lerpf(0.35f, 0.85f, noise_unit(mark.hash, 3));
    float line = 0.30f - droop * side - 0.18f * side * side;
    float thick = 0.17f * (1.0f - 0.85f * side);
    float arm =
        side < 1.0f ? smoothstepf(1.15f, 0.80f, fabsf(v - line) / fmaxf(thick, 0.01f)) : 0.0f;
    float tall = lerpf(0.45f, 0.85f, noise_unit(mark.hash, 4));
    float rhomb = side / 0.42f + fabsf(v + 0.45f * tall - 0.25f) / tall;
    return mark.guard * fmaxf(arm, smoothstepf(1.1f, 0.9f, rhomb));
}

// Of the black foot: how far it reaches up, m. Young stems have none.
static float foot_reach(const Material *m, const StemPlace *place)
{
    float radius = place->radius;
    return m->bark_height > 0.0f ? m->bark_height : fminf(45.0f * radius * radius, 6.0f * radius);
}

// Black rhombs, upright, many just above the foot, few high up.
static float diamonds(const StemPlace *place, float scale, float reach, Vec3 torn)
{
    Mark mark = mark_at(place, 0.15f * scale, 0.23f * scale, 21);
    float up = fmaxf(place->p.z, 0.0f) / fmaxf(reach, 0.05f);
    float share = 0.08f + 0.85f * expf(-0.55f * up);
    float chance = noise_unit(mark.hash, 3);
    if (chance > share) {
        return 0.0f;
    }
    float grown = clampf(1.6f * (share - chance), 0.15f, 1.0f); // the oldest are the largest
    float tall = lerpf(0.025f, 0.16f, grown * noise_unit(mark.hash, 4)) * scale;
    float wide = tall * lerpf(0.28f, 0.55f, noise_unit(mark.hash, 5));
    float x = fabsf(mark.u) / wide, y = fabsf(mark.v) / tall;
    float t = x + y + 0.16f * torn.x + 0.10f * torn.z;
    return mark.guard * smoothstepf(1.06f, 0.94f, t);
}

// How black the bark is, 0..1: the foot with its tongues, diamonds, scars.
static float blackness(const Material *m, const StemPlace *place, float scale, Vec3 torn)
{
    float reach = foot_reach(m, place);
    float tongue = noise_fractal(stem_lookup(place, 0.10f * scale, 0.55f * scale), 3, 28);
    float island = noise_solid(stem_lookup(place, 0.055f * scale, 0.12f * scale), 30, NULL);
    float top = reach * (0.62f + 0.75f * tongue) + 0.05f * scale * torn.z;
    float in = (top - place->p.z) / (0.10f * scale) + 1.6f * island; // islands stay white
    float foot = smoothstepf(0.0f, 0.35f, in);
    float old = smoothstepf(0.03f, 0.07f, place->radius);
    float patch = fmaxf(diamonds(place, scale, reach, torn), moustache(m, place, scale, torn));
    float root = fmaxf(stem_root(place), smoothstepf(0.10f, 0.04f, place->p.z));
    return fmaxf(fmaxf(old * patch, root), foot * smoothstepf(0.02f, 0.045f, place->radius));
}

// Black cork: plates that weather to grey, with cracks of their own, between deep fissures.
static Vec3 add_cork(BarkLook *look, const Material *m, const StemPlace *place, float scale,
                     float black, float seen)
{
    BarkLook cork = {0};
    Vec3 wind, crack;
    noise_solid(stem_lookup(place, 0.07f * scale, 0.16f * scale), 34, &wind);
    BarkPlate p =
        bark_add_plates(&cork, place, 0.036f * scale, 0.080f * scale, vec3_scale(wind, 0.9f), 24);
    const float around = 0.007f * scale, along = 0.024f * scale;
    float n = noise_solid(stem_lookup(place, around, along), 33, &crack);
    float split = fmaxf(0.0f, 1.0f - fabsf(n) / 0.16f) * seen * p.rise;
    stem_add_relief(&cork, place, -0.25f * split, split > 0.0f ? copysignf(0.25f, n) / 0.16f : 0.0f,
                    around, along, crack);
    look->height += black * (1.5f * cork.height - 0.7f);
    look->slope_u += 1.5f * black * cork.slope_u;
    look->slope_v += 1.5f * black * cork.slope_v;
    Vec3 grey = vec3_add(vec3_scale(m->color2, 1.5f), vec3_scale(m->color, 0.055f));
    float value = 0.75f + 0.45f * p.own + 0.3f * (p.layer - 0.5f) + 0.3f * seen * n;
    Vec3 top = vec3_scale(grey, value * (1.0f - 0.4f * p.edge) * (1.0f - 0.7f * split));
    return vec3_lerp(vec3_scale(m->color2, 0.22f), top, smoothstepf(0.0f, 0.6f, p.rise));
}

static Vec3 young_birch(float gloss)
{
    return vec3_scale(vec3(0.145f, 0.062f, 0.038f), 0.9f + 0.25f * gloss);
}

// The chalky skin: cream and grey bands across, dirt that rain has drawn down, algae at the foot.
static Vec3 skin_color(const Material *m, const StemPlace *place, float scale, float tone)
{
    float band = noise_fractal(stem_lookup(place, 0.35f * scale, 0.045f * scale), 3, 35);
    float run = noise_fractal(stem_lookup(place, 0.035f * scale, 0.6f * scale), 4, 36);
    Vec3 color = vec3_scale(m->color, 0.95f + 0.10f * tone + 0.13f * band);
    float cream = smoothstepf(0.0f, 0.6f, tone - 0.5f * band);
    color = vec3_mul(color, vec3_lerp(vec3(1, 1, 1), vec3(0.97f, 0.90f, 0.81f), cream));
    float dirt = smoothstepf(0.0f, 0.75f, run + 0.25f * tone);
    color = vec3_lerp(color, vec3_mul(color, vec3(0.62f, 0.61f, 0.58f)), 0.6f * dirt);
    float foot = expf(-fmaxf(place->p.z, 0.0f) / 1.2f);
    float north = 0.5f - 0.5f * vec3_cross(place->u, place->v).z;
    float algae = clampf(foot * (0.25f + 0.5f * north) * (0.8f + run), 0.0f, 0.8f);
    return vec3_lerp(color, vec3_mul(color, vec3(0.60f, 0.66f, 0.48f)), algae);
}

BarkLook bark_birch(const Material *m, const StemPlace *place, float scale, float footprint)
{
    BarkLook look = {0};
    Vec3 torn;
    float tone = noise_solid(stem_lookup(place, 0.3f * scale, 0.12f * scale), 22, NULL);
    noise_solid(stem_lookup(place, 0.028f * scale, 0.045f * scale), 23, &torn);
    Vec3 white = skin_color(m, place, scale, tone);
    float fine = pattern_detail(0.012f * scale, footprint);
    if (fine > 0.0f) {
        white = vec3_lerp(white, add_peeling(&look, place, scale, white), fine);
        look.height *= fine;
        look.slope_u *= fine;
        look.slope_v *= fine;
    }
    float line = lenticels(place, 0.11f * scale, 0.024f * scale, 0.45f, footprint, 25);
    line = fmaxf(line,
                 0.85f * lenticels(place, 0.030f * scale, 0.0095f * scale, 0.40f, footprint, 37));
    Vec3 dark = vec3_add(vec3_scale(m->color2, 1.6f), vec3_scale(m->color, 0.06f));
    white = vec3_lerp(white, vec3_mul(dark, vec3(1.1f, 0.95f, 0.85f)), 0.85f * line);
    look.height += 0.05f * line;
    float black = blackness(m, place, scale, torn);
    if (black > 0.0f) {
        look.height *= 1.0f - black;
        look.slope_u *= 1.0f - black;
        look.slope_v *= 1.0f - black;
        white = vec3_lerp(white, add_cork(&look, m, place, scale, black, fine), black);
    }
    float old = smoothstepf(0.012f, 0.035f, place->radius);
    old = fmaxf(old, stem_root(place));
    look.color = stem_earth(place, vec3_lerp(young_birch(tone), white, old));
    look.height *= old;
    look.slope_u *= old;
    look.slope_v *= old;
    return look;
}
