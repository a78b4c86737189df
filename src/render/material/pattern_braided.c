// The valley of a braided river: pale gravel where floods have just moved it, darker and half
// overgrown where it has long lain, silt in dry threads, wet stones at the water's edge, meadows on
// terraces, scrub and rock on slopes. site.x is the age of the ground (HeightField.age), site.y how
// damp it is.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

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

// Stones of many sizes in sheets and ribbons, coarse and fine in turn; lichen and dust darken old
// ones.
static Cover gravel(const SurfacePoint *point, Vec3 color, float age, float broad)
{
    PatternOctaves sheets = pattern_octaves(point, 22.0f, 5, 0.65f, 1.0f, 401);
    PatternOctaves stones = pattern_octaves(point, 1.2f, 7, 0.8f, 1.0f, 403);
    float ribbons = streaks(point, 26.0f, 405);
    float dark = smoothstepf(0.0f, 0.5f, age + 0.12f * broad + 0.16f * ribbons);
    Vec3 fresh = vec3_scale(color, 1.22f), old = vec3_mul(color, vec3(0.52f, 0.54f, 0.50f));
    Cover c = {.color = vec3_lerp(fresh, old, dark)};
    c.color = vec3_scale(c.color, 1.0f + 0.15f * clampf(sheets.value, -1.3f, 1.3f) +
                                      0.22f * clampf(ribbons, -1.3f, 1.3f) +
                                      0.18f * clampf(stones.value, -1.3f, 1.3f));
    c.slope = vec3_madd(vec3_scale(stones.slope, 0.035f), 0.22f, sheets.slope);
    return c;
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
    float steep = smoothstepf(0.74f, 0.6f, upright + 0.05f * rock.value + 0.03f * broad);
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
    Cover silt = {.color = vec3_mul(shade->color, vec3(0.92f, 0.88f, 0.78f)), .slope = {0}};
    ground = blend(ground, silt, 0.7f * still * smoothstepf(-0.6f, 0.5f, patch.value));
    float cover = age + 0.16f * patch.value + 0.08f * broad.value - 0.12f * damp;
    Cover mats = plants(point, m->color2, 0.25f * broad.value);
    ground = blend(ground, mats, 0.9f * smoothstepf(0.46f, 0.64f, cover));
    float terrace = smoothstepf(0.66f, 0.76f, age);
    Cover meadow = plants(point, vec3_scale(m->color2, 1.15f), 0.10f + 0.35f * broad.value);
    ground =
        blend(ground, meadow, terrace * smoothstepf(0.86f, 0.94f, upright + 0.03f * patch.value));
    ground =
        blend(ground, hillside(m, point, upright, broad.value), smoothstepf(0.84f, 0.96f, age));
    // Wet ground is dark, the darker the nearer the water.
    float moist = damp + 0.10f * patch.value;
    float wet = 0.3f * smoothstepf(0.45f, 0.85f, moist) + 0.7f * smoothstepf(0.86f, 1.0f, moist);
    wet *= 1.0f - terrace;
    shade->color = vec3_scale(ground.color, 1.0f - 0.36f * wet);
    Vec3 slope = vec3_scale(ground.slope, m->pattern_depth * (1.0f - 0.5f * wet));
    shade->normal = pattern_tilt(shade->normal, slope);
}

// Rock flour scatters what light comes in, so depth alone tells the colour: the bed (color2) shines
// through where water is shallow. site.x = depth / (1 m + depth), site.y how rough the flow is.
void pattern_glacial(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const float clear = 0.15f; // m: depth in which the bed fades to 1 / e
    float depth = point->site.x / fmaxf(1.0f - point->site.x, 0.02f), rough = point->site.y;
    PatternOctaves drift = pattern_octaves(point, 30.0f, 3, 0.6f, 1.0f, 443);
    float seen = expf(-depth / clear);
    Vec3 milk = vec3_scale(shade->color, 1.0f + 0.06f * clampf(drift.value, -1.0f, 1.0f));
    shade->color = vec3_lerp(milk, m->color2, 0.9f * seen);
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 5.0f;
    PatternOctaves waves = pattern_octaves(point, scale, 6, 0.55f, 1.0f, 449);
    Vec3 slope = vec3(waves.slope.x, 0.0f, waves.slope.z);
    float height = m->pattern_depth * (0.3f + 2.0f * rough * rough);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, height));
}
