// Mountains and badlands. Altitude and wetness at the point (SurfacePoint.site) and its slope
// decide the type of ground, with borders frayed by noise of several scales. Each type has its own
// colours and relief, down to the footprint of the pixel.
#include "render/material/foam.h"
#include "render/material/pattern.h"
#include "render/material/pattern_beds.h"
#include "render/material/pattern_crags.h"
#include "render/material/pattern_damp.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_shore.h"
#include "render/material/pattern_slopes.h"

#include <stddef.h>

static Vec3 tinted(Vec3 color, float r, float g, float b)
{
    return vec3(color.x * r, color.y * g, color.z * b);
}

// Beds of rock: the phase of a level within the cycle of (gently tilted and folded) beds.
static float bed_level(const SurfacePoint *point, float thickness, Vec3 up)
{
    Vec3 p = point->object_position;
    Vec3 q = vec3_scale(p, 0.011f / (0.1f * thickness));
    float fold =
        1.8f * noise_solid(vec3_scale(q, 0.12f), 51, NULL) + 0.35f * noise_solid(q, 52, NULL);
    return vec3_dot(p, up) / thickness + fold;
}

// The blocks of a face: by the land's beds where it has some, else by beds that dip steeply and are
// folded.
static CragsRock face_of(const SurfacePoint *point, float size, float thick)
{
    CragsRock face = crags_level(point, size, thick);
    if (!point->strata) {
        face.up = vec3(0.62f, 0.70f, 0.35f);
        face.level = bed_level(point, size, face.up) * size;
    }
    return face;
}

typedef struct Face {
    Ground ground;
    Crags crags;
} Face;

// size: m, of the largest blocks; dark: how dark crevices are. Beds of the land show their colours
// relative to their mean.
static Face rock(const Material *m, const SurfacePoint *point, Vec3 color, float size, float thick,
                 float dark)
{
    CragsRock face = face_of(point, size, thick);
    Face f = {.crags = pattern_crags(point, &face)};
    const Crags *crags = &f.crags;
    PatternOctaves grain = pattern_octaves(point, 0.3f * size, 8, 0.55f, 1.2f, 61);
    // Beds of different rock, visible in some places and lost in broken rock in others.
    float bed = face.level + 0.02f * size * grain.value;
    float laminae = 0.45f * pattern_lamina(bed, 1.3f * size, point->footprint, 0.9f, 7) +
                    0.3f * pattern_lamina(bed, 0.21f * size, point->footprint, 0.8f, 9) +
                    0.25f * pattern_lamina(bed, 0.05f * size, point->footprint, 0.8f, 15) - 0.5f;
    float tone = 0.42f + 1.1f * laminae + 0.22f * crags->tone + 0.16f * grain.value;
    f.ground.color = vec3_lerp(color, m->color2, clampf(tone, 0.0f, 1.0f));
    if (point->strata) {
        f.ground.color =
            beds_tinted(point, beds_level(point) + 0.02f * size * grain.value, f.ground.color);
    }
    float light = (1.0f + 0.16f * crags->tone + 0.16f * clampf(grain.value, -1.2f, 1.2f)) *
                  (1.0f - dark * crags->crevice);
    f.ground.color = vec3_scale(f.ground.color, clampf(light, 0.2f, 1.6f));
    f.ground.slope = vec3_madd(vec3_scale(crags->slope, 0.9f), 0.012f * size, grain.slope);
    return f;
}

// Water and what lives in it darken faces in streaks; lichens grow pale where it does not run.
static void stain(const SurfacePoint *point, float size, float upright, Vec3 *color)
{
    float steep = smoothstepf(0.75f, 0.5f, upright);
    if (steep <= 0.0f) {
        return;
    }
    float streaks = pattern_streaks(point, size);
    *color = vec3_scale(*color, 1.0f - 0.5f * steep * streaks);
    float spots = pattern_octaves(point, 0.25f * size, 6, 0.75f, 0.8f, 65).value;
    float lichen = smoothstepf(0.2f, 0.6f, spots) * (1.0f - streaks);
    Vec3 pale = vec3_add(vec3_scale(*color, 1.25f), vec3(0.035f, 0.036f, 0.028f));
    *color = vec3_lerp(*color, pale, 0.5f * lichen);
}

static Ground scree(const Material *m, const SurfacePoint *point, Vec3 color, float scale)
{
    Vec3 fresh = vec3_scale(color, 1.2f);
    return slopes_talus(point, fresh, vec3_scale(vec3_lerp(color, m->color2, 0.7f), 1.05f), scale);
}

static Ground grass(const SurfacePoint *point, float scale, float wetness, float altitude)
{
    const Turf turf = {.lush = {0.038f, 0.062f, 0.018f},
                       .straw = {0.098f, 0.092f, 0.038f},
                       .bush = {0.020f, 0.032f, 0.014f},
                       .soil = {0.115f, 0.095f, 0.070f},
                       .scale = 0.7f * scale,
                       .dry = clampf(0.45f + 0.6f * altitude - 0.5f * wetness, 0.0f, 1.0f)};
    return slopes_turf(point, &turf);
}

// The share that what grows on the soil of ledges covers. rise: altitude, as grass feels it.
static float ledge_share(const Material *m, const Crags *crags, float rise, float fray)
{
    float grows = smoothstepf(m->grass_line + 0.08f, m->grass_line - 0.06f, rise);
    return 0.75f * grows * smoothstepf(0.3f, 0.7f, crags->ledge + 0.4f * fray);
}

static Ground snow(const SurfacePoint *point, float scale)
{
    PatternOctaves drift = pattern_octaves(point, 0.35f * scale, 5, 0.42f, 1.0f, 101);
    Ground g = {.color = {0.86f, 0.88f, 0.90f}};
    g.slope = vec3_scale(drift.slope, 0.018f * scale);
    return g;
}

static float face_height(const Material *m, const SurfacePoint *point, float size, float thick)
{
    CragsRock face = face_of(point, size, thick);
    return m->pattern_depth * crags_height(point, &face, 0.85f, 0.68f);
}

static float mountain_scale(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 90.0f;
}

#define MOUNTAIN_BLOCKS 0.22f // relative to the scale
#define MOUNTAIN_BEDS 0.55f
#define ALPS_BLOCKS 0.42f // the land's own couloirs and ledges are larger
#define ALPS_BEDS 0.9f

float pattern_mountain_blocks(const Material *m)
{
    return MOUNTAIN_BLOCKS * mountain_scale(m);
}

float pattern_mountain_height(const Material *m, const SurfacePoint *point)
{
    return face_height(m, point, pattern_mountain_blocks(m), MOUNTAIN_BEDS);
}

void pattern_mountain(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = mountain_scale(m);
    float altitude = point->site.x, wetness = point->site.y;
    float upright = fabsf(point->geometric_normal.y);
    PatternOctaves broad = pattern_octaves(point, 4.0f * scale, 4, 0.55f, 1.0f, 41);
    PatternOctaves fray = pattern_octaves(point, 0.4f * scale, 6, 0.6f, 1.0f, 45);
    float ragged = 0.45f * broad.value + 0.55f * fray.value;
    Face face = rock(m, point, vec3_scale(shade->color, 1.0f + 0.3f * broad.value),
                     pattern_mountain_blocks(m), MOUNTAIN_BEDS, 0.7f);
    Ground g = face.ground;
    stain(point, 0.1f * scale, upright, &g.color);
    g = pattern_damp(m->moss, point, &face.crags, upright, g);
    upright += 0.3f * face.crags.ledge;
    float loose = smoothstepf(0.70f, 0.80f, upright + 0.07f * ragged);
    Ground other = scree(m, point, shade->color, scale);
    g = ground_blend(g, &other, loose);
    if (m->grass_line > 0.0f) {
        float rise = altitude + 0.10f * ragged - 0.10f * wetness;
        float green = smoothstepf(m->grass_line + 0.06f, m->grass_line - 0.08f, rise) *
                      smoothstepf(0.70f, 0.80f, upright + 0.10f * ragged + 0.05f * wetness);
        other = grass(point, scale, wetness, altitude / m->grass_line);
        g = ground_blend(g, &other, fmaxf(green, ledge_share(m, &face.crags, rise, fray.value)));
    }
    // Gravel along the water.
    float bank = smoothstepf(0.86f, 0.97f, wetness + 0.08f * ragged);
    other = scree(m, point, tinted(shade->color, 1.1f, 1.08f, 1.02f), 0.5f * scale);
    g = ground_blend(g, &other, 0.8f * bank);
    if (m->snow_line > 0.0f) {
        float cold = altitude + 0.09f * ragged +
                     0.10f * (point->geometric_normal.z < 0.0f ? -point->geometric_normal.z : 0.0f);
        float high = smoothstepf(m->snow_line - 0.05f, m->snow_line + 0.09f, cold);
        float least = lerpf(0.70f, 0.42f, smoothstepf(m->snow_line, m->snow_line + 0.4f, cold));
        float held = smoothstepf(least, least + 0.07f, upright + 0.10f * fray.value);
        held = fmaxf(held, 0.8f * smoothstepf(0.35f, 0.7f, face.crags.ledge));
        other = snow(point, scale);
        g = ground_blend(g, &other, high * held);
    }
    g = pattern_shore(point, vec3_scale(m->color, 1.25f), m->pattern_depth, g);
    shade->color = g.color;
    shade->normal = crags_normal(point, shade->normal, vec3_scale(g.slope, m->pattern_depth));
}

static float alps_scale(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 70.0f;
}

float pattern_alps_blocks(const Material *m)
{
    return ALPS_BLOCKS * alps_scale(m);
}

float pattern_alps_height(const Material *m, const SurfacePoint *point)
{
    return face_height(m, point, pattern_alps_blocks(m), ALPS_BEDS);
}

// Mountains worn by ice. site.x is the altitude as snow feels it, higher in hollows and to the lee,
// lower on crests; site.y the share of loose ground: scree and the fill of valleys.
void pattern_alps(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = alps_scale(m);
    float felt = point->site.x, loose = point->site.y;
    float upright = fabsf(surface_smooth_normal(point).y);
    PatternOctaves broad = pattern_octaves(point, 5.0f * scale, 5, 0.55f, 1.0f, 161);
    PatternOctaves fray = pattern_octaves(point, 0.5f * scale, 8, 0.62f, 1.0f, 167);
    PatternOctaves chutes = pattern_octaves(point, 0.9f * scale, 6, 0.6f, 0.22f, 177);
    float ragged = 0.4f * broad.value + 0.6f * fray.value;
    Face face = rock(m, point, vec3_scale(shade->color, 1.0f + 0.25f * broad.value),
                     pattern_alps_blocks(m), ALPS_BEDS, 0.5f);
    Ground g = face.ground;
    stain(point, 0.3f * scale, upright, &g.color);
    // Water and dust darken faces along the chutes.
    g.color = vec3_scale(g.color, 1.0f - 0.35f * smoothstepf(0.1f, 0.6f, chutes.value));
    g.slope = vec3_madd(g.slope, 0.04f * scale, chutes.slope);
    float even = upright;
    upright += 0.25f * face.crags.ledge;
    float covered = smoothstepf(0.12f, 0.4f, loose + 0.25f * ragged);
    float lies = smoothstepf(0.68f, 0.78f, upright + 0.06f * ragged) * covered;
    Ground other = scree(m, point, shade->color, scale);
    other.color = vec3_scale(other.color, 1.0f + 0.22f * chutes.value + 0.12f * broad.value);
    g = ground_blend(g, &other, lies);
    if (m->grass_line > 0.0f) {
        float rise = felt + 0.09f * ragged - 0.05f * loose;
        float green = smoothstepf(m->grass_line + 0.05f, m->grass_line - 0.09f, rise) *
                      smoothstepf(0.69f, 0.82f, upright + 0.10f * ragged);
        // Scree near its angle of repose moves too often for turf; fans below are old and green.
        float moves = smoothstepf(0.935f, 0.875f, even + 0.05f * ragged + 0.04f * chutes.value);
        green *= 1.0f - 0.92f * moves * covered;
        other = grass(point, scale, 0.4f * loose, felt / m->grass_line);
        g = ground_blend(g, &other, fmaxf(green, ledge_share(m, &face.crags, rise, fray.value)));
    }
    if (m->snow_line > 0.0f) {
        // Far below the line only couloirs and hollows that hold it through the summer (site.x is
        // higher there); far above all but walls and ribs.
        float cold = felt - m->snow_line + 0.025f * broad.value + 0.008f * fray.value;
        float least = lerpf(0.80f, 0.44f, smoothstepf(-0.05f, 0.17f, cold));
        float kept = upright - 0.07f * chutes.value + 0.03f * fray.value;
        float held = smoothstepf(least - 0.02f, least + 0.05f, kept);
        held = fmaxf(held, 0.8f * smoothstepf(0.35f, 0.7f, face.crags.ledge));
        other = snow(point, scale);
        g = ground_blend(g, &other, smoothstepf(-0.012f, 0.016f, cold) * held);
    }
    g = pattern_shore(point, vec3_scale(m->color, 1.25f), m->pattern_depth, g);
    shade->color = g.color;
    shade->normal = crags_normal(point, shade->normal, vec3_scale(g.slope, m->pattern_depth));
}

// Linear between the stops; between color and color2 without any.
void pattern_altitude(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const ColorStop ends[2] = {{0.0f, shade->color}, {1.0f, m->color2}};
    const ColorStop *stop = m->color_count > 0 ? m->colors : ends;
    int last = (m->color_count > 0 ? m->color_count : 2) - 1, i = 0;
    float altitude = point->site.x;
    while (i < last && altitude > stop[i + 1].at) {
        i++;
    }
    int next = i < last ? i + 1 : last;
    float run = stop[next].at - stop[i].at;
    float t = run > 0.0f ? clampf((altitude - stop[i].at) / run, 0.0f, 1.0f) : 0.0f;
    shade->color = vec3_lerp(stop[i].color, stop[next].color, t);
}

// Where a river's foam is looked up. Eddies of some sizes stir it; the drift's coordinates are
// shorter along the flow, by the length of their tangent.
static FoamPlace stirred_foam(const SurfacePoint *point)
{
    enum { SEED_EDDIES = 861 };
    Vec2 p = {point->object_position.x, point->object_position.z};
    Vec2 still = foam_stirred(p, 3.4f, 7.0f, SEED_EDDIES);
    still = foam_stirred((Vec2){still.x + 0.83f, still.y + 0.41f}, 1.3f, 5.0f, SEED_EDDIES + 7);
    Vec2 moved = {still.x - 0.83f - p.x, still.y - 0.41f - p.y};
    // Metres of the way along the flow and across it that the eddies have moved.
    Vec3 u = point->tangent_u, v = point->tangent_v;
    float along = fmaxf(u.x * u.x + u.z * u.z, 1e-6f), across = fmaxf(v.x * v.x + v.z * v.z, 1e-6f);
    Vec2 drift = {point->uv.x + (moved.x * u.x + moved.y * u.z) / along,
                  point->uv.y + (moved.x * v.x + moved.y * v.z) / across};
    const float round =
        0.967f; // foam_share makes holes longer along x, which is no flow's way here
    return (FoamPlace){drift, {still.x * round / 0.72f, still.y * round / 1.3f}};
}

// Ripples: a few octaves of noise that fade where the pixel is too coarse. White water heaves, and
// foam (color2) lies on it.
void pattern_water(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 6.0f;
    PatternOctaves waves = pattern_octaves(point, scale, 6, 0.5f, 1.0f, 151);
    Vec3 slope = vec3(waves.slope.x, 0.0f, waves.slope.z);
    slope = vec3_scale(slope, m->pattern_depth);
    if (point->foam > 0.0f) {
        const float wave = 1.1f, height = 0.16f; // m
        PatternOctaves heaves = pattern_octaves(point, wave, 5, 0.6f, 1.0f, 157);
        slope = vec3_madd(slope, height * point->foam, heaves.slope);
        // Water wells up in boils, which push foam aside into the lows between them, but where all
        // is white water.
        float boils =
            lerpf(0.9f - 0.45f * heaves.value, 1.0f, smoothstepf(0.96f, 1.0f, point->foam));
        float cover = clampf(point->foam * boils, 0.0f, 1.0f);
        FoamCover foam = {cover, smoothstepf(0.6f, 1.0f, point->foam)};
        shade->foam =
            point->foam < 1.0f ? foam_share(foam, stirred_foam(point), point->footprint) : 1.0f;
        shade->color = vec3_lerp(shade->color, m->color2, shade->foam);
    }
    shade->normal = pattern_tilt(shade->normal, slope);
}
