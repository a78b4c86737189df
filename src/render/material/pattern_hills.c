// Pasture on hills: dry grasses (color) in patches of several tones on crests and sunny slopes,
// fresh grass, rushes and scrub (color2) where water gathers, terracettes along the contours of
// steep slopes, trodden paths, bunches of grass, rills, bare scars and stones.
// site.y is how wet the place is (HeightField.wetness).
#include "base/color.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_paths.h"
#include "render/material/pattern_shore.h"
#include "render/material/pattern_slopes.h"

#include <math.h>

enum {
    SEED_BROAD = 301,
    SEED_SWARD = 303,
    SEED_TUFTS = 307,
    SEED_STEPS = 311,
    SEED_PATHS = 321,
    SEED_RILLS = 331,
    SEED_OATS = 337,
    SEED_WEEDS = 341,
    SEED_BUNCHES = 351
};

// What the parts of the cover share.
typedef struct Pasture {
    const SurfacePoint *point;
    float scale;                        // of all lengths
    PatternOctaves broad, sward, tufts; // patches of 90 m, of 6 m, of 0.5 m
    PatternOctaves rills; // down the fall line, of steep land: -1 in a rill, 1 between them
    float wet;            // 0..1
    float steep;          // 0..1: steep enough for soil to slip
    Vec3 straw, lush;     // reflectances
} Pasture;

static Pasture survey(const SurfacePoint *point, float scale, Vec3 straw, Vec3 lush)
{
    Pasture p = {.point = point, .scale = scale, .straw = straw, .lush = lush};
    p.broad = pattern_octaves(point, 90.0f * scale, 4, 0.6f, 1.0f, SEED_BROAD);
    p.sward = pattern_octaves(point, 6.0f * scale, 5, 0.7f, 1.0f, SEED_SWARD);
    p.tufts = pattern_octaves(point, 0.5f * scale, 4, 0.7f, 0.8f, SEED_TUFTS);
    float upright = fabsf(surface_smooth_normal(point).y);
    p.steep = smoothstepf(0.97f, 0.88f, upright + 0.02f * p.broad.value);
    if (p.steep > 0.0f) {
        p.rills = pattern_fall_lines(point, 5.0f * scale, 2, 0.6f, SEED_RILLS);
    }
    p.wet = point->site.y + 0.22f * p.broad.value + 0.10f * p.sward.value -
            0.12f * p.steep * p.rills.value;
    return p;
}

// Grasses that seed, ripen and lodge in patches of their own: pale oats, brown thatch of last
// year, rusty fescue; weeds that stay green.
static Vec3 grasses(const Pasture *p)
{
    float scale = p->scale;
    PatternOctaves oats = pattern_octaves(p->point, 38.0f * scale, 4, 0.68f, 1.0f, SEED_OATS);
    PatternOctaves weeds = pattern_octaves(p->point, 17.0f * scale, 4, 0.72f, 1.0f, SEED_WEEDS);
    Vec3 c = p->straw;
    Vec3 pale = vec3_scale(vec3_lerp(c, vec3_splat(luminance(c)), 0.28f), 1.32f);
    Vec3 thatch = vec3_mul(c, vec3(0.60f, 0.53f, 0.48f));
    Vec3 rust = vec3_mul(c, vec3(0.92f, 0.79f, 0.68f));
    Vec3 weed = vec3_lerp(vec3_scale(c, 0.55f), p->lush, 0.6f);
    float fine = 0.30f * p->sward.value + 0.20f * p->tufts.value;
    c = vec3_lerp(c, rust, 0.7f * smoothstepf(0.05f, 0.45f, -oats.value + fine));
    c = vec3_lerp(c, pale, 0.9f * smoothstepf(0.0f, 0.40f, oats.value + fine));
    float old = p->sward.value + 0.45f * p->tufts.value - 0.5f * weeds.value;
    c = vec3_lerp(c, thatch, 0.75f * smoothstepf(0.0f, 0.8f, old));
    float damp = 0.5f * p->wet - 0.35f * p->rills.value * p->steep;
    c = vec3_lerp(c, weed, 0.7f * smoothstepf(0.35f, 0.7f, weeds.value + damp + fine));
    return vec3_scale(c, 1.0f + 0.20f * clampf(p->broad.value, -1.0f, 1.0f) +
                             0.25f * clampf(p->tufts.value, -1.2f, 1.2f));
}

static void add_mounds(const Pasture *p, float density, float size, uint32_t seed, Vec3 color,
                       Ground *g)
{
    Mounds m = pattern_tussocks(p->point, clampf(density, 0.0f, 1.0f), size * p->scale, seed);
    g->color = vec3_lerp(g->color, vec3_scale(color, 0.7f + 0.6f * m.tone), m.share);
    g->slope = vec3_add(vec3_scale(g->slope, 1.0f - 0.6f * m.share), m.slope);
}

// Bunches of grass that cattle leave stand over the sward, scrub and rushes where it is moist,
// stones on dry and steep ground.
static void add_things(const Pasture *p, Ground *g)
{
    Vec3 bunch = vec3_scale(vec3_lerp(g->color, p->straw, 0.5f), 0.86f);
    float rank = 0.34f + 0.5f * p->sward.value + 0.4f * p->broad.value + 0.25f * p->wet;
    add_mounds(p, rank, 1.5f, SEED_BUNCHES, bunch, g);
    add_mounds(p, rank + 0.15f, 0.7f, SEED_BUNCHES + 1, vec3_scale(bunch, 1.12f), g);
    float moist = 1.5f * (p->wet - 0.42f) - 0.10f * p->steep * p->rills.value;
    Vec3 scrub = vec3_scale(p->lush, 0.65f);
    add_mounds(p, moist, 3.4f, SEED_BUNCHES + 2, scrub, g);
    add_mounds(p, 0.8f * moist, 1.9f, SEED_BUNCHES + 3, scrub, g);
    float bare = 0.5f * p->steep * p->sward.value - 0.6f * p->broad.value - 0.45f * p->wet;
    add_mounds(p, 0.12f * bare, 1.2f, SEED_BUNCHES + 4, vec3(0.24f, 0.225f, 0.20f), g);
}

// The bumps of the sward and the rills; slopes for a depth of 1.
static Vec3 relief(const Pasture *p)
{
    Vec3 slope = vec3_scale(p->sward.slope, 0.15f);
    slope = vec3_madd(slope, 0.06f, p->tufts.slope);
    slope = vec3_madd(slope, 1.6f * p->scale, p->broad.slope);
    return vec3_madd(slope, 0.9f * p->scale * p->steep, p->rills.slope);
}

void pattern_hills(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 1.0f;
    Pasture p = survey(point, scale, shade->color, m->color2);
    Ground g = {grasses(&p), relief(&p)};
    float green = smoothstepf(0.25f, 0.75f, p.wet);
    Vec3 fresh = vec3_scale(p.lush, 1.0f + 0.22f * clampf(p.tufts.value, -1.2f, 1.2f));
    g.color = vec3_lerp(g.color, fresh, green);
    add_things(&p, &g);
    // Bare ground on paths and in small slides.
    Vec3 soil = {0.155f, 0.115f, 0.075f};
    float upright = fabsf(surface_smooth_normal(point).y);
    float scar = smoothstepf(0.90f, 0.80f, upright + 0.05f * p.sward.value) *
                 smoothstepf(0.35f, 0.6f, p.sward.value - 0.2f * p.broad.value);
    Paths steps = pattern_terracettes(point, 0.8f * scale, SEED_STEPS);
    Paths tracks = pattern_tracks(point, 0.5f * scale, SEED_PATHS);
    // Treads are half overgrown, and more so in places: regular dark lines would be ploughland.
    float trodden = 0.16f + 0.14f * clampf(p.sward.value - p.broad.value, -1.0f, 1.0f);
    float bare = fmaxf(0.75f * scar, fmaxf(trodden * steps.share, 0.5f * tracks.share));
    g.color = vec3_lerp(g.color, soil, bare);
    g.color = vec3_scale(g.color, 1.0f - trodden * steps.edge);
    g.slope = vec3_madd(vec3_scale(g.slope, 1.0f - 0.5f * bare), 0.4f, steps.slope);
    g.slope = vec3_scale(g.slope, m->pattern_depth);
    g = pattern_shore(point, vec3(0.25f, 0.23f, 0.20f), 1.0f, g);
    shade->color = g.color;
    shade->normal = pattern_tilt(shade->normal, g.slope);
}
