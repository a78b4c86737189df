// A stratovolcano. site.x is the altitude as snow and plants feel it; site.y is the ground
// (HeightField.ground): positive = lava by its freshness, negative = red scoria, 0 = tephra.
#include "render/material/pattern.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_shore.h"
#include "render/material/pattern_slopes.h"

// Noise that several kinds of ground share.
typedef struct Fray {
    float broad, fine; // of hundreds of metres; of tens and less
    float both;
    PatternOctaves chutes; // run down the slopes; hollows are negative
} Fray;

// Ash and lapilli, in streaks down the slope; on steep ground the beds crop out.
static Ground tephra(const Material *m, const SurfacePoint *point, const Fray *f, Vec3 color,
                     float scale, float upright)
{
    PatternOctaves grain = pattern_octaves(point, 0.12f * scale, 6, 0.6f, 1.0f, 203);
    float level = point->object_position.y / (0.25f * scale) + 1.2f * f->broad + 0.3f * f->fine;
    float bed = noise_unit((uint32_t)(int32_t)floorf(level) * 2654435761u, 5);
    float crops = smoothstepf(0.80f, 0.68f, upright + 0.06f * f->fine) *
                  pattern_detail(0.25f * scale, point->footprint);
    float dark = clampf(0.45f + 0.5f * f->broad + 0.35f * f->chutes.value, 0.0f, 1.0f);
    Ground g = {.color = vec3_lerp(color, m->color2, 0.55f * dark)};
    g.color = vec3_scale(g.color, 1.0f + 0.25f * clampf(grain.value, -1.3f, 1.3f));
    g.color = vec3_scale(g.color, lerpf(1.0f, 0.55f + 0.95f * bed, 0.7f * crops));
    g.slope = vec3_scale(grain.slope, 0.012f * scale);
    g.slope = vec3_madd(g.slope, 0.02f * scale, f->chutes.slope);
    g.slope.y += crops * 0.8f * (bed - 0.5f);
    return g;
}

// Folds that a flow pushes up across its way as its crust stiffens: about along the contours, more
// of them the steeper it flows. Returns their slope per metre; *crest: 0 between them .. 1 on top.
static Vec3 pressure_ridges(const SurfacePoint *point, float scale, float upright, float *crest)
{
    const float bend = 2.6f; // of folds, in folds
    float rise = 0.05f * scale, height = 0.5f * rise;
    PatternOctaves warp = pattern_octaves(point, 1.3f * scale, 5, 0.55f, 1.0f, 217);
    float where = pattern_octaves(point, 1.9f * scale, 4, 0.6f, 1.0f, 221).value;
    float phase = PI_F * (point->object_position.y / rise + bend * warp.value);
    float wave = sinf(phase), side = wave < 0.0f ? -1.0f : 1.0f;
    float seen = pattern_detail(5.0f * rise, point->footprint) *
                 smoothstepf(0.75f, 0.92f, upright) * smoothstepf(-0.35f, 0.55f, where);
    *crest = lerpf(0.64f, fabsf(wave), seen);
    Vec3 way = vec3_madd(vec3(0.0f, 1.0f / rise, 0.0f), bend, warp.slope);
    return vec3_scale(way, seen * height * PI_F * side * cosf(phase));
}

// Blocky lava, in heaps and pressure ridges: black when fresh, in places red where hot gas came
// through; lichens and dust make it grey and brown, crests first.
static Ground lava(const Material *m, const SurfacePoint *point, const Fray *f, float scale,
                   float fresh, float upright)
{
    PatternOctaves heaps = pattern_octaves(point, 0.28f * scale, 6, 0.68f, 0.8f, 211);
    PatternOctaves zones = pattern_octaves(point, 2.6f * scale, 5, 0.6f, 1.0f, 219);
    float crest;
    Vec3 ridges = pressure_ridges(point, scale, upright, &crest);
    Vec3 old = {0.088f, 0.080f, 0.066f}, rust = {0.088f, 0.043f, 0.031f};
    Vec3 color = vec3_lerp(old, m->color2, smoothstepf(0.1f, 0.75f, fresh));
    float red = smoothstepf(0.28f, 0.62f, zones.value + 0.25f * f->fine + 0.2f * (crest - 0.6f));
    color = vec3_lerp(color, rust, 0.6f * red);
    float pale = smoothstepf(0.1f, 0.6f, -zones.value + 0.45f * (crest - 0.64f));
    color = vec3_lerp(color, vec3(0.125f, 0.124f, 0.108f), 0.45f * pale);
    Vec3 grey = vec3_add(vec3_scale(color, 1.25f), vec3(0.016f, 0.016f, 0.014f));
    Ground g = slopes_talus(point, vec3_scale(color, 0.85f), grey, 0.9f * scale);
    float shade = 1.0f + 0.25f * clampf(heaps.value, -1.3f, 1.3f) + 0.12f * f->broad;
    g.color = vec3_scale(g.color, clampf(shade, 0.4f, 1.6f));
    g.color = vec3_scale(g.color, 0.8f + 0.3f * crest);
    g.slope = vec3_add(vec3_madd(g.slope, 0.06f * scale, heaps.slope), ridges);
    return g;
}

// Scoria about the vents, and yellow sulphur where gas still rises.
static Ground scoria(const SurfacePoint *point, const Fray *f, float scale, float red)
{
    PatternOctaves grain = pattern_octaves(point, 0.10f * scale, 5, 0.6f, 1.0f, 223);
    Vec3 rust = {0.130f, 0.056f, 0.036f}, plum = {0.090f, 0.045f, 0.040f};
    Ground g = {.color = vec3_lerp(plum, rust, clampf(0.5f + 0.8f * f->both, 0.0f, 1.0f))};
    float gas = smoothstepf(0.9f, 1.25f, red + 0.5f * f->fine);
    g.color = vec3_lerp(g.color, vec3(0.46f, 0.40f, 0.14f), 0.8f * gas);
    g.color = vec3_scale(g.color, 1.0f + 0.25f * clampf(grain.value, -1.3f, 1.3f));
    g.slope = vec3_scale(grain.slope, 0.015f * scale);
    return g;
}

static Ground plants(const SurfacePoint *point, float scale, float height)
{
    const Turf turf = {.lush = {0.036f, 0.054f, 0.018f},
                       .straw = {0.096f, 0.084f, 0.040f},
                       .bush = {0.020f, 0.030f, 0.013f},
                       .soil = {0.078f, 0.066f, 0.056f},
                       .scale = 0.6f * scale,
                       .dry = clampf(0.2f + 0.5f * height, 0.0f, 1.0f)};
    return slopes_turf(point, &turf);
}

// The share of snow: low down it keeps to chutes, in streaks that end at heights of their own, and
// melts first on dark, rough lava.
static float snow_share(const Material *m, const SurfacePoint *point, const Fray *f, float upright)
{
    float cold = point->site.x - m->snow_line + 0.05f * f->broad + 0.03f * f->fine;
    cold -=
        0.05f * clampf(point->site.y, 0.0f, 1.0f) + 0.09f * clampf(f->chutes.value, -1.2f, 1.2f);
    float kept = upright - 0.10f * f->chutes.value + 0.03f * f->fine;
    float least = lerpf(0.92f, 0.60f, smoothstepf(-0.05f, 0.14f, cold));
    return smoothstepf(-0.02f, 0.02f, cold) * smoothstepf(least - 0.03f, least + 0.05f, kept);
}

void pattern_volcano(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 60.0f;
    float felt = point->site.x, ground = point->site.y;
    float upright = fabsf(surface_smooth_normal(point).y);
    Fray f = {.broad = pattern_octaves(point, 5.0f * scale, 5, 0.55f, 1.0f, 231).value,
              .fine = pattern_octaves(point, 0.5f * scale, 7, 0.62f, 1.0f, 237).value,
              .chutes = pattern_fall_lines(point, 0.6f * scale, 5, 0.62f, 241)};
    f.both = 0.5f * (f.broad + f.fine);
    Ground g = tephra(m, point, &f, shade->color, scale, upright);
    float red = smoothstepf(0.25f, 0.75f, -ground + 0.25f * f.both);
    Ground other = scoria(point, &f, scale, -ground);
    g = ground_blend(g, &other, red);
    float fresh = ground + 0.02f * f.fine;
    other = lava(m, point, &f, scale, fresh, upright);
    g = ground_blend(g, &other, smoothstepf(0.04f, 0.12f, fresh));
    if (m->grass_line > 0.0f) {
        // Plants climb, and settle on lava with the centuries.
        float rise = felt + 0.07f * f.both + 0.35f * clampf(ground, 0.0f, 1.0f) +
                     0.12f * clampf(-ground, 0.0f, 1.0f);
        float green = smoothstepf(m->grass_line + 0.03f, m->grass_line - 0.10f, rise) *
                      smoothstepf(0.62f, 0.76f, upright + 0.10f * f.both);
        green *= 1.0f - smoothstepf(0.35f, 0.6f, fresh + 0.1f * f.both);
        other = plants(point, scale, felt / m->grass_line);
        g = ground_blend(g, &other, green);
    }
    if (m->snow_line > 0.0f) {
        other = (Ground){.color = {0.84f, 0.86f, 0.89f}};
        g = ground_blend(g, &other, snow_share(m, point, &f, upright));
    }
    g = pattern_shore(point, vec3_scale(m->color, 1.2f), m->pattern_depth, g);
    shade->color = g.color;
    shade->normal = pattern_tilt(shade->normal, vec3_scale(g.slope, m->pattern_depth));
}
