// A river's delta: bare mud where water has just left, pioneers on it, low and high marsh in stands
// of several tones, willows on levees, meadows on the old land; and its water, from the mud of the
// river to the clear sea. Of land site.x is the age of the ground (HeightField.age),
// site.y how damp it is.
#include "render/material/pattern.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"

#include <math.h>

enum { SEED_BROAD = 801, SEED_PATCH = 811, SEED_MUD = 821, SEED_SWARD = 831, SEED_WATER = 851 };

// ---- land

// What a place of the land looks up.
typedef struct Marsh {
    float age, damp;          // site.x, site.y
    float broad, patch, tuft; // noise of 300, 55 and 3 m
} Marsh;

// The share of a kind of plants that grows where noise exceeds a level: stands have crisp borders,
// frayed down to single plants.
static float stand(float noise, float level)
{
    const float soft = 0.11f;
    return smoothstepf(level - soft, level + soft, noise);
}

// Mud dries from its crests, which pale; water that leaves it last stands in a net of runnels, dark
// and wet; films of algae tint it.
static Ground mud(const SurfacePoint *point, const Marsh *at, Vec3 color)
{
    PatternOctaves sheets = pattern_octaves(point, 26.0f, 6, 0.6f, 1.0f, SEED_MUD);
    PatternOctaves net = pattern_octaves(point, 13.0f, 5, 0.55f, 1.0f, SEED_MUD + 10);
    float run = smoothstepf(0.16f, 0.02f, fabsf(net.value + 0.15f * sheets.value));
    float dry = smoothstepf(1.0f, 0.86f, at->damp + 0.07f * sheets.value);
    const Vec3 film = {0.082f, 0.079f, 0.034f};
    Ground g = {.color = vec3_scale(color, lerpf(0.55f, 1.2f, dry))};
    g.color = vec3_lerp(g.color, film, 0.55f * stand(at->patch - 0.4f * dry, 0.12f));
    g.color = vec3_scale(g.color, 1.0f + 0.20f * clampf(sheets.value, -1.2f, 1.2f));
    g.color = vec3_scale(g.color, 1.0f - 0.34f * run * (1.0f - 0.6f * dry));
    g.slope = vec3_madd(vec3_scale(sheets.slope, 0.08f), -0.05f, net.slope);
    return g;
}

// Pioneers on mud: clones that spread as discs, and glasswort that turns red, between them.
static Ground pioneers(const SurfacePoint *point, const Marsh *at, Ground ground)
{
    const float size = 11.0f;
    const Vec3 cordgrass = {0.070f, 0.074f, 0.034f}, glasswort = {0.092f, 0.062f, 0.042f};
    Vec3 p = vec3_scale(point->object_position, 1.0f / size);
    CellPoint cell = noise_cells_on(vec3(p.x, 0.5f, p.z), vec3(0, 1, 0), SEED_SWARD + 50);
    float own = noise_unit(cell.cell, 2), radius = 0.10f + 0.42f * own * own;
    float away = sqrtf(cell.point.x * cell.point.x + cell.point.z * cell.point.z);
    float seen = pattern_detail(size, point->footprint);
    float disc = seen * smoothstepf(-0.03f, 0.03f, radius * (1.0f + 0.4f * at->tuft) - away);
    float red = stand(0.8f * at->patch + 0.5f * at->tuft, 0.16f);
    Ground g = ground;
    g.color = vec3_lerp(g.color, glasswort, 0.7f * red);
    g.color = vec3_lerp(g.color, vec3_scale(cordgrass, 0.8f + 0.5f * noise_unit(cell.cell, 4)),
                        0.9f * disc);
    return g;
}

// Beds of reeds, rushes and sedge, each of one tone, with last year's straw in some.
static Ground sedge(const SurfacePoint *point, const Marsh *at, const Vec3 tone[4], uint32_t seed)
{
    float beds = pattern_octaves(point, 90.0f, 8, 0.66f, 1.0f, seed).value;
    float other = pattern_octaves(point, 36.0f, 7, 0.68f, 1.0f, seed + 9).value;
    PatternOctaves tufts = pattern_octaves(point, 2.4f, 3, 0.75f, 0.8f, seed + 17);
    Ground g = {.color = tone[0]};
    g.color = vec3_lerp(g.color, tone[1], 0.9f * stand(beds + 0.9f * at->broad, 0.08f));
    g.color = vec3_lerp(g.color, tone[2], 0.75f * stand(other - 0.8f * at->broad, 0.34f));
    g.color = vec3_lerp(g.color, tone[3], 0.75f * stand(-other - 0.7f * beds, 0.36f));
    float mottle = 0.16f * clampf(other, -1.0f, 1.0f) + 0.14f * clampf(beds, -1.0f, 1.0f) +
                   0.65f * clampf(tufts.value, -0.9f, 0.9f);
    g.color = vec3_scale(g.color, 1.0f + mottle);
    g.slope = vec3_scale(tufts.slope, 0.45f);
    return g;
}

// Low marsh is green, with rust where it dries; the high marsh, which few tides reach, is a mosaic
// of straw, heath and rushes.
static Ground low_marsh(const Material *m, const SurfacePoint *point, const Marsh *at)
{
    const Vec3 tone[4] = {vec3_scale(m->color2, 0.92f),
                          {0.084f, 0.079f, 0.046f},
                          {0.046f, 0.048f, 0.024f},
                          {0.098f, 0.070f, 0.042f}};
    return sedge(point, at, tone, SEED_SWARD);
}

static Ground high_marsh(const Material *m, const SurfacePoint *point, const Marsh *at)
{
    const Vec3 tone[4] = {{0.094f, 0.082f, 0.051f},
                          vec3_scale(m->color2, 0.80f),
                          {0.148f, 0.124f, 0.076f},
                          {0.072f, 0.054f, 0.035f}};
    return sedge(point, at, tone, SEED_SWARD + 200);
}

static Ground willows(const Material *m, const SurfacePoint *point)
{
    Vec3 color = vec3_mul(m->color2, vec3(0.52f, 0.58f, 0.62f));
    return ground_crowns(point, 7.0f, color, 0.5f, SEED_SWARD + 20);
}

// Meadows, dry and fresh, and woods between them.
static Ground old_land(const Material *m, const SurfacePoint *point, const Marsh *at)
{
    Ground g = high_marsh(m, point, at), wood = willows(m, point);
    return ground_blend(g, &wood, stand(at->patch - 0.35f * at->broad, 0.08f));
}

void pattern_delta(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    Marsh at = {.age = point->site.x, .damp = point->site.y};
    at.broad = pattern_octaves(point, 300.0f, 5, 0.6f, 1.0f, SEED_BROAD).value;
    at.patch = pattern_octaves(point, 55.0f, 7, 0.64f, 1.0f, SEED_PATCH).value;
    at.tuft = pattern_octaves(point, 3.0f, 3, 0.7f, 1.0f, SEED_PATCH + 9).value;
    float ragged = at.damp + 0.05f * at.patch + 0.012f * at.tuft;
    Ground ground = mud(point, &at, shade->color), over;
    // What has lain bare a while is grown over.
    float grown = smoothstepf(0.004f, 0.03f, at.age + 0.015f * at.patch);
    over = pioneers(point, &at, ground);
    ground = ground_blend(ground, &over, grown * smoothstepf(0.985f, 0.955f, ragged));
    over = low_marsh(m, point, &at);
    ground = ground_blend(ground, &over, grown * smoothstepf(0.93f, 0.91f, ragged));
    over = high_marsh(m, point, &at);
    float high = smoothstepf(0.70f, 0.67f, ragged + 0.14f * at.broad);
    ground = ground_blend(ground, &over, grown * high);
    over = willows(m, point);
    float old = smoothstepf(0.03f, 0.10f, at.age + 0.05f * at.broad);
    ground = ground_blend(ground, &over, old * smoothstepf(0.44f, 0.41f, ragged));
    over = old_land(m, point, &at);
    ground = ground_blend(ground, &over, smoothstepf(0.85f, 0.97f, at.age + 0.04f * at.patch));
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

// Mud that settles leaves water brown and clear, with peat.
static Vec3 peat_color(Vec3 silt, float peat)
{
    const Vec3 steeped = {0.020f, 0.017f, 0.010f};
    return vec3_lerp(silt, steeped, smoothstepf(0.0f, 0.85f, peat));
}

// The more mud, the less of the bed shows. site.x = depth / (1 m + depth), site.y = the mud, of
// that in the river; above 1, the more peat instead of mud, up to 2.
void pattern_silt(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float depth = point->site.x / fmaxf(1.0f - point->site.x, 0.02f),
          load = fminf(point->site.y, 1.0f);
    float peat = fmaxf(point->site.y - 1.0f, 0.0f);
    PatternOctaves drift = pattern_octaves(point, 260.0f, 7, 0.6f, 1.0f, SEED_WATER);
    PatternOctaves fine = pattern_octaves(point, 70.0f, 4, 0.6f, 1.0f, SEED_WATER + 9);
    load =
        load * (1.0f + 0.28f * drift.value) + 0.05f * drift.value * smoothstepf(0.0f, 0.1f, load);
    load = clampf(load, 0.0f, 1.0f);
    Vec3 body = body_color(shade->color, peat_color(m->color2, peat), load);
    load *= 1.0f - peat;
    body = vec3_scale(body, 1.0f + 0.07f * clampf(fine.value, -1.0f, 1.0f));
    float clear = 0.35f + 1.3f * (1.0f - load) * (1.0f - load); // m: depth that dims the bed to 1/e
    Vec3 bed = vec3_lerp(vec3(0.118f, 0.097f, 0.062f), vec3(0.076f, 0.074f, 0.038f),
                         smoothstepf(-0.3f, 0.4f, drift.value + 0.4f * fine.value));
    bed = vec3_scale(bed, 1.0f - 0.66f * peat); // ooze
    float seen = expf(-depth / clear);
    shade->color = vec3_lerp(body, bed, 0.8f * seen);
    float ruffled = smoothstepf(-0.4f, 0.6f, drift.value);
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 5.0f;
    PatternOctaves waves = pattern_octaves(point, scale, 6, 0.55f, 1.0f, SEED_WATER + 16);
    float height = m->pattern_depth * (0.4f + 0.6f * ruffled) * smoothstepf(0.0f, 1.5f, depth);
    Vec3 slope = vec3(waves.slope.x, 0.0f, waves.slope.z);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, height));
}
