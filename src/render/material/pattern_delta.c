// A river's delta: bare mud where water has just left, reeds and rushes on wet ground, sedge marsh
// in patches of several tones, willows on levees, meadows on the old land; and its water, from the
// mud of the river to the clear sea. Of land site.x is the age of the ground (HeightField.age),
// site.y how damp it is.
#include "render/material/pattern.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"

#include <math.h>

enum { SEED_BROAD = 801, SEED_PATCH = 811, SEED_MUD = 821, SEED_SWARD = 831, SEED_WATER = 851 };

// ---- land

static Ground mud(const SurfacePoint *point, Vec3 color, float damp)
{
    PatternOctaves sheets = pattern_octaves(point, 28.0f, 6, 0.62f, 1.0f, SEED_MUD);
    float tone = 1.0f + 0.16f * clampf(sheets.value, -1.3f, 1.3f);
    float wet = smoothstepf(0.55f, 1.0f, damp + 0.04f * sheets.value);
    Ground g = {.color = vec3_scale(color, tone * (1.0f - 0.22f * wet))};
    g.slope = vec3_scale(sheets.slope, 0.05f);
    return g;
}

// Beds of reeds, rushes and cattail, each of one tone, with last year's straw between them.
static Ground reeds(const SurfacePoint *point, float broad)
{
    PatternOctaves beds = pattern_octaves(point, 90.0f, 7, 0.62f, 1.0f, SEED_SWARD + 30);
    PatternOctaves tufts = pattern_octaves(point, 3.0f, 4, 0.7f, 0.8f, SEED_SWARD + 39);
    Vec3 green = {0.066f, 0.076f, 0.032f}, fresh = {0.102f, 0.106f, 0.046f};
    Vec3 straw = {0.205f, 0.165f, 0.092f};
    Ground g = {.color = vec3_lerp(green, fresh, smoothstepf(-0.3f, 0.3f, beds.value))};
    g.color = vec3_lerp(g.color, straw, 0.8f * smoothstepf(0.15f, 0.6f, beds.value + 0.5f * broad));
    g.color = vec3_scale(g.color, 1.0f + 0.32f * clampf(tufts.value, -1.3f, 1.3f));
    g.slope = vec3_madd(vec3_scale(tufts.slope, 0.26f), 0.25f, beds.slope);
    return g;
}

static Ground marsh(const Material *m, const SurfacePoint *point, float damp, float broad)
{
    PatternOctaves sward = pattern_octaves(point, 24.0f, 6, 0.66f, 1.0f, SEED_SWARD);
    PatternOctaves tufts = pattern_octaves(point, 2.0f, 4, 0.7f, 0.8f, SEED_SWARD + 9);
    Vec3 olive = {0.142f, 0.124f, 0.058f}, brown = {0.138f, 0.096f, 0.058f};
    float t = 0.6f * sward.value + 1.1f * broad;
    Ground g = {.color = vec3_lerp(m->color2, olive, smoothstepf(-0.3f, 0.4f, t))};
    g.color = vec3_lerp(g.color, brown, 0.7f * smoothstepf(0.3f, 0.8f, t + 0.5f * damp - 0.25f));
    g.color = vec3_scale(g.color, 1.0f + 0.22f * clampf(sward.value, -1.3f, 1.3f) +
                                      0.30f * clampf(tufts.value, -1.3f, 1.3f));
    g.slope = vec3_madd(vec3_scale(tufts.slope, 0.24f), 0.2f, sward.slope);
    return g;
}

static Ground willows(const Material *m, const SurfacePoint *point)
{
    Vec3 color = vec3_mul(m->color2, vec3(0.62f, 0.66f, 0.85f));
    return ground_crowns(point, 9.0f, color, 0.45f, SEED_SWARD + 20);
}

// Meadows, dry and fresh, and woods between them.
static Ground old_land(const Material *m, const SurfacePoint *point, float broad, float patch)
{
    Ground g = marsh(m, point, 0.2f, 0.8f * broad + 0.2f), wood = willows(m, point);
    return ground_blend(g, &wood, smoothstepf(0.02f, 0.14f, patch - 0.35f * broad));
}

void pattern_delta(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float age = point->site.x, damp = point->site.y;
    float broad = pattern_octaves(point, 420.0f, 5, 0.6f, 1.0f, SEED_BROAD).value;
    float patch = pattern_octaves(point, 60.0f, 6, 0.64f, 1.0f, SEED_PATCH).value;
    float ragged = damp + 0.06f * patch;
    Ground ground = mud(point, shade->color, damp), over;
    // What has lain bare a while is green.
    float grown = smoothstepf(0.005f, 0.05f, age + 0.02f * patch);
    over = reeds(point, broad);
    ground = ground_blend(ground, &over, grown * smoothstepf(0.985f, 0.90f, ragged));
    over = marsh(m, point, damp, broad);
    ground = ground_blend(ground, &over, grown * smoothstepf(0.78f, 0.62f, ragged + 0.10f * broad));
    over = willows(m, point);
    float old = smoothstepf(0.03f, 0.12f, age + 0.05f * broad);
    ground = ground_blend(ground, &over, old * smoothstepf(0.56f, 0.42f, ragged));
    over = old_land(m, point, broad, patch);
    ground = ground_blend(ground, &over, smoothstepf(0.85f, 0.97f, age + 0.04f * patch));
    shade->color = ground.color;
    shade->normal = pattern_tilt(shade->normal, vec3_scale(ground.slope, m->pattern_depth));
}

// ---- water

// From the sea to the river's mud, by way of the green that a little of it makes.
static Vec3 body_color(Vec3 sea, Vec3 silt, float load)
{
    Vec3 green = vec3_add(vec3_scale(sea, 1.1f), vec3_mul(silt, vec3(0.22f, 0.36f, 0.32f)));
    float first = smoothstepf(0.0f, 0.35f, load), then = smoothstepf(0.2f, 0.85f, load);
    return vec3_lerp(vec3_lerp(sea, green, first), silt, then);
}

// The more mud, the less of the bed shows. site.x = depth / (1 m + depth), site.y = the mud, of
// that in the river.
void pattern_silt(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float depth = point->site.x / fmaxf(1.0f - point->site.x, 0.02f), load = point->site.y;
    PatternOctaves drift = pattern_octaves(point, 260.0f, 7, 0.6f, 1.0f, SEED_WATER);
    PatternOctaves fine = pattern_octaves(point, 70.0f, 4, 0.6f, 1.0f, SEED_WATER + 9);
    load =
        load * (1.0f + 0.28f * drift.value) + 0.05f * drift.value * smoothstepf(0.0f, 0.1f, load);
    load = clampf(load, 0.0f, 1.0f);
    Vec3 body = body_color(shade->color, m->color2, load);
    body = vec3_scale(body, 1.0f + 0.07f * clampf(fine.value, -1.0f, 1.0f));
    float clear = 0.35f + 1.3f * (1.0f - load) * (1.0f - load); // m: depth that dims the bed to 1/e
    Vec3 bed = vec3_lerp(vec3(0.118f, 0.097f, 0.062f), vec3(0.076f, 0.074f, 0.038f),
                         smoothstepf(-0.3f, 0.4f, drift.value + 0.4f * fine.value));
    float seen = expf(-depth / clear);
    shade->color = vec3_lerp(body, bed, 0.8f * seen);
    float ruffled = smoothstepf(-0.4f, 0.6f, drift.value);
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 5.0f;
    PatternOctaves waves = pattern_octaves(point, scale, 6, 0.55f, 1.0f, SEED_WATER + 16);
    float height = m->pattern_depth * (0.4f + 0.6f * ruffled) * smoothstepf(0.0f, 1.5f, depth);
    Vec3 slope = vec3(waves.slope.x, 0.0f, waves.slope.z);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, height));
}
