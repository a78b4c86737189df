// The valley of a braided river: pale gravel where floods have just moved it, darker and half
// overgrown where it has long lain, silt in dry threads, wet stones at the water's edge, meadows on
// terraces, scrub and rock on slopes. site.x is the age of the ground (HeightField.age), site.y how
// damp it is.
#include "render/material/foam.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_shore.h"

#include <math.h>
#include <stddef.h>

typedef struct Cover {
    Vec3 color;
    Vec3 slope; // of its relief, per metre
} Cover;

static Cover blend(Cover a, Cover b, float t)
{
    a.color = vec3_lerp(a.color, b.color, t);
    a.slope = vec3_lerp(a.slope, b.slope, t);
    return a;
}

// Noise drawn out along the river, which flows along z.
static float streaks(const SurfacePoint *point, float wavelength, uint32_t seed)
{
    SurfacePoint drawn = *point;
    drawn.object_position.z *= 0.16f;
    drawn.object_position.x += 0.12f * point->object_position.z;
    return pattern_octaves(&drawn, wavelength, 5, 0.66f, 1.0f, seed).value;
}

// Small channels that floods have left on bars, of three sizes; they wander down the valley.
typedef struct Rills {
    float floor;  // 0..1: in a channel's bed, where the last water laid silt
    float margin; // 0..1: beside it, where stones stayed
    Vec3 slope;
} Rills;

static Rills rills(const SurfacePoint *point)
{
    static const float width[] = {46.0f, 17.0f, 6.5f}; // m: about twice the distance of channels
    const float skew = 0.12f, along = 0.17f, deep = 0.02f, half = 0.3f;
    Rills r = {0};
    Vec3 p = point->object_position;
    for (uint32_t i = 0; i < sizeof width / sizeof width[0]; i++) {
        float seen = pattern_detail(0.3f * width[i], point->footprint);
        if (seen <= 0.0f) {
            break;
        }
        Vec3 at = vec3_scale(p, 1.0f / width[i]), slope;
        at.x += 0.7f * noise_solid(vec3_scale(at, 0.45f), 463 + i, NULL);
        at = vec3(at.x + skew * at.z, 0.5f, along * at.z);
        float n = noise_solid(at, 461 + i, &slope), off = fabsf(n) / half;
        if (off >= 2.0f) {
            continue;
        }
        float inside = off < 1.0f ? (1.0f - off * off) * (1.0f - off * off) : 0.0f;
        float fall = off < 1.0f ? 4.0f * off * (1.0f - off * off) / half : 0.0f;
        r.floor = fmaxf(r.floor, seen * inside);
        r.margin = fmaxf(r.margin, seen * fmaxf(1.0f - 2.0f * fabsf(off - 1.2f), 0.0f));
        float steep = seen * deep * (n < 0.0f ? -fall : fall);
        r.slope.x += steep * slope.x;
        r.slope.z += steep * (skew * slope.x + along * slope.z);
    }
    return r;
}

// Stones and sand sorted by floods: coarse sheets at the heads of bars and beside channels, sand in
// their lee, silt in the channels; lichen and dust darken what is old.
static Cover gravel(const SurfacePoint *point, Vec3 color, float age, float broad)
{
    PatternOctaves sheets = pattern_octaves(point, 22.0f, 5, 0.65f, 1.0f, 401);
    PatternOctaves grain = pattern_octaves(point, 1.6f, 7, 0.8f, 1.0f, 403);
    float ribbons = streaks(point, 26.0f, 405);
    Rills r = rills(point);
    float coarse = 0.58f + 0.55f * ribbons + 0.4f * sheets.value + 0.5f * r.margin - 0.7f * r.floor;
    coarse = smoothstepf(0.15f, 0.85f, coarse + 0.15f * grain.value);
    Vec3 sand = vec3_mul(color, vec3(1.16f, 1.13f, 1.06f));
    Vec3 stones = vec3_mul(color, vec3(0.80f, 0.82f, 0.83f));
    Vec3 silt = vec3_mul(color, vec3(0.62f, 0.62f, 0.58f));
    Vec3 tint = vec3_lerp(vec3_lerp(sand, stones, coarse), silt, 0.75f * r.floor);
    float dark = smoothstepf(0.0f, 0.5f, age + 0.12f * broad + 0.16f * ribbons);
    tint = vec3_lerp(tint, vec3_mul(tint, vec3(0.54f, 0.55f, 0.50f)), dark);
    Ground cobbles = pattern_stones(point, tint);
    Cover c = {.color = vec3_lerp(tint, cobbles.color, coarse)};
    c.color = vec3_scale(c.color, 1.0f + 0.10f * clampf(sheets.value, -1.3f, 1.3f) +
                                      0.32f * clampf(grain.value, -1.3f, 1.3f));
    c.slope = vec3_madd(vec3_scale(grain.slope, 0.07f), 0.3f, sheets.slope);
    c.slope = vec3_add(vec3_madd(c.slope, 0.8f * coarse, cobbles.slope), r.slope);
    return c;
}

// Lines of sand and of stones that the water left where it stood as it fell: along its margin,
// about 5 cm one below the other. A share of the reflectance.
static float strandlines(const SurfacePoint *point, float damp, float patch)
{
    const float lines = 9.0f; // about, from dry to wet
    Vec3 at = vec3_scale(point->object_position, 0.02f);
    at.y = lines * (damp + 0.04f * patch);
    float near = smoothstepf(0.15f, 0.4f, damp) * pattern_detail(1.5f, point->footprint);
    return near * (0.7f * noise_solid(at, 471, NULL) +
                   0.3f * noise_solid(vec3_scale(at, 2.7f), 473, NULL));
}

// Mats of willow herb, mountain avens and grass: in spots at first, then closed.
static Cover plants(const SurfacePoint *point, Vec3 lush, float dry)
{
    PatternOctaves tufts = pattern_octaves(point, 2.2f, 6, 0.7f, 0.8f, 409);
    Vec3 straw = {0.160f, 0.140f, 0.062f};
    float t = clampf(0.30f + 0.35f * tufts.value + dry, 0.0f, 1.0f);
    Cover c = {.color = vec3_lerp(lush, straw, t)};
    c.color = vec3_scale(c.color, 1.0f + 0.28f * clampf(tufts.value, -1.3f, 1.3f));
    c.slope = vec3_scale(tufts.slope, 0.12f);
    return c;
}

// Scrub below, grass and rock above, by the steepness.
static Cover hillside(const Material *m, const SurfacePoint *point, float upright, float broad)
{
    PatternOctaves rock = pattern_octaves(point, 14.0f, 7, 0.66f, 1.6f, 419);
    PatternOctaves scrub = pattern_octaves(point, 7.0f, 6, 0.72f, 0.9f, 421);
    Vec3 dark = vec3_scale(m->color2, 0.75f), heath = {0.105f, 0.098f, 0.048f};
    float open = smoothstepf(-0.2f, 0.7f, scrub.value + 0.6f * broad);
    Cover c = {.color = vec3_lerp(dark, heath, 0.75f * open)};
    c.color = vec3_scale(c.color, 1.0f + 0.25f * clampf(scrub.value, -1.2f, 1.2f));
    c.slope = vec3_scale(scrub.slope, 0.22f);
    Vec3 stone = vec3_scale(m->color, 0.44f + 0.16f * clampf(rock.value, -1.5f, 1.5f));
    Cover cliff = {.color = stone, .slope = vec3_scale(rock.slope, 0.4f)};
    float steep = smoothstepf(0.68f, 0.54f, upright + 0.06f * rock.value + 0.04f * broad);
    return blend(c, cliff, steep);
}

void pattern_braided(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float age = point->site.x, damp = point->site.y;
    float upright = fabsf(surface_smooth_normal(point).y);
    PatternOctaves broad = pattern_octaves(point, 120.0f, 5, 0.6f, 1.0f, 431);
    PatternOctaves patch = pattern_octaves(point, 9.0f, 6, 0.68f, 1.0f, 433);
    Cover ground = gravel(point, shade->color, age, broad.value);
    // Fine sediment settles in threads that have fallen dry.
    float still = smoothstepf(0.02f, 0.10f, age) * smoothstepf(0.45f, 0.8f, damp);
    Cover silt = {.color = vec3_mul(shade->color, vec3(0.84f, 0.83f, 0.77f)), .slope = {0}};
    ground = blend(ground, silt, 0.7f * still * smoothstepf(-0.6f, 0.5f, patch.value));
    float cover = age + 0.16f * patch.value + 0.08f * broad.value - 0.12f * damp;
    Cover mats = plants(point, m->color2, 0.25f * broad.value);
    ground = blend(ground, mats, 0.9f * smoothstepf(0.42f, 0.58f, cover));
    float terrace = smoothstepf(0.66f, 0.76f, age);
    Cover meadow = plants(point, vec3_scale(m->color2, 1.15f), 0.10f + 0.35f * broad.value);
    ground =
        blend(ground, meadow, terrace * smoothstepf(0.86f, 0.94f, upright + 0.03f * patch.value));
    ground =
        blend(ground, hillside(m, point, upright, broad.value), smoothstepf(0.84f, 0.96f, age));
    // Wet ground is dark: a ragged strip beside the water, patches where it seeps, and the troughs
    // of channels that have fallen dry.
    float moist = damp + 0.07f * patch.value;
    float wet = 0.4f * smoothstepf(0.5f, 0.9f, moist) + 0.6f * smoothstepf(0.94f, 1.0f, moist);
    wet *= 1.0f - terrace;
    float strand = 0.24f * (1.0f - terrace) * strandlines(point, damp, patch.value);
    shade->color = vec3_scale(ground.color, (1.0f - 0.48f * wet) * (1.0f + strand));
    Vec3 slope = vec3_scale(ground.slope, m->pattern_depth * (1.0f - 0.5f * wet));
    shade->normal = pattern_tilt(shade->normal, slope);
}

// Lines of smooth and of rough water along the flow. uv.x: its streamline.
static float flow_lines(const SurfacePoint *point)
{
    SurfacePoint drawn = *point;
    drawn.object_position =
        vec3(point->uv.x, 0.0f, 0.04f * point->object_position.z); // they last for long
    float metre = vec3_length(point->tangent_u); // of the river, a metre across even flow
    drawn.footprint = metre > 0.0f ? point->footprint / metre : point->footprint;
    return pattern_octaves(&drawn, 48.0f, 8, 0.75f, 1.0f, 443).value;
}

// Crests lie across the flow, along which uv.x does not change.
static Vec3 crests_across(const SurfacePoint *point, Vec3 slope)
{
    Vec3 along = vec3_normalize(vec3(point->tangent_v.x, 0.0f, point->tangent_v.z));
    Vec3 rising = vec3_scale(along, vec3_dot(along, slope));
    return vec3_madd(vec3_scale(rising, 1.3f), 0.45f, vec3_sub(slope, rising));
}

// Rock flour scatters what light comes in, so depth alone tells the colour: the bed (color2) shines
// through where water is shallow, and its stones rise from the thinnest sheets; what is deep is
// darker. Flow draws lines of smooth and of rough water along itself; riffles are rough all over.
// site.x = depth / (1 m + depth), site.y how rough the flow is: white where it is swift.
void pattern_glacial(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const float clear = 0.08f; // m: depth in which the bed fades to 1 / e
    float depth = point->site.x / fmaxf(1.0f - point->site.x, 0.02f), rough = point->site.y;
    PatternOctaves bed = pattern_octaves(point, 7.0f, 7, 0.62f, 1.0f, 447);
    float lines = clampf(flow_lines(point), -1.2f, 1.2f);
    float over = depth + 0.025f * bed.value + 0.02f * streaks(point, 26.0f, 405) - 0.015f;
    float dry = smoothstepf(0.012f, -0.012f, over), seen = expf(-fmaxf(over, 0.0f) / clear);
    float deep = smoothstepf(0.05f, 0.6f, over);
    Vec3 milk = vec3_scale(shade->color, (1.12f - 0.26f * deep) * (1.0f + 0.13f * lines));
    Ground stones = pattern_stones(point, m->color2);
    shade->color = vec3_lerp(milk, stones.color, 0.85f * seen + (0.15f - 0.15f * seen) * dry);
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 5.0f;
    PatternOctaves waves = pattern_octaves(point, scale, 7, 0.62f, 1.0f, 449);
    Vec3 slope = crests_across(point, vec3(waves.slope.x, 0.0f, waves.slope.z));
    float height = m->pattern_depth * (0.35f + 3.2f * rough * rough) * (1.0f + 0.7f * lines);
    slope = vec3_lerp(vec3_scale(slope, height), vec3_scale(stones.slope, 0.5f), dry);
    Vec2 at = {point->object_position.z, point->object_position.x};
    float crests = 0.25f * smoothstepf(0.55f, 0.85f, rough + 0.12f * waves.value + 0.10f * lines);
    float foam =
        (1.0f - dry) * foam_share((FoamCover){crests, 0.0f}, (FoamPlace){at, at}, point->footprint);
    shade->color = vec3_lerp(shade->color, vec3_splat(0.7f), foam);
    shade->foam = fmaxf(dry, foam);
    shade->normal = pattern_tilt(shade->normal, slope);
}
