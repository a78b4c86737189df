// The floodplain of a meandering river: sand on fresh point bars, willows behind it, meadows whose
// scrolls are pale on ridges and lush in swales, reeds where cut bends fill, fields on ground that
// the river has not reached. site.x is the age of the ground (HeightField.age), site.y how damp it
// is.
#include "render/material/pattern.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"

#include <math.h>

enum { SEED_BROAD = 701, SEED_PATCH = 711, SEED_SAND = 721, SEED_SWARD = 731, SEED_FIELD = 741 };

// ---- fields

// A parcel of farmland.
typedef struct Parcel {
    uint32_t hash;
    float edge;   // m to its border
    float across; // m, across its furrows
} Parcel;

// Where the border below a strip lies, in strips: each is moved a little.
static float strip_border(uint32_t row, float column)
{
    return column + 0.3f * (noise_unit(row + (uint32_t)(int32_t)column, 5) - 0.5f);
}

// Furlongs of one direction each, of strips that are cut to uneven lengths and widths.
static Parcel parcel_at(Vec3 p)
{
    const float furlong = 520.0f, length = 210.0f, width = 62.0f;
    CellPoint cell = noise_cells(vec3(p.x / furlong, 0.5f, p.z / furlong), SEED_FIELD);
    float across = noise_unit(cell.cell, 2) < 0.4f ? 0.5f * PI_F : 0.0f;
    float turn = 0.9f * (noise_unit(cell.cell, 1) - 0.5f) + across;
    float c = cosf(turn), s = sinf(turn), u = c * p.x + s * p.z, v = c * p.z - s * p.x;
    float row = floorf(u / length), end = u - row * length;
    uint32_t hash = cell.cell ^ (uint32_t)(int32_t)row * 2654435761u;
    float strip = width * (0.6f + 1.1f * noise_unit(hash, 3)); // of this row
    float at = v / strip, column = floorf(at);
    column -= at < strip_border(hash, column) ? 1.0f : 0.0f;
    column += at > strip_border(hash, column + 1.0f) ? 1.0f : 0.0f;
    float below = at - strip_border(hash, column), above = strip_border(hash, column + 1.0f) - at;
    float side = fminf(below, above) * strip;
    end = fminf(end, length - end);
    return (Parcel){.hash = hash + (uint32_t)(int32_t)column * 40503u,
                    .edge = fminf(fminf(side, end), cell.border * furlong),
                    .across = v};
}

// Late summer: stubble, straw, ploughed earth, pasture, beet and maize.
static Vec3 crop_color(uint32_t hash, float patch)
{
    static const Vec3 crops[] = {{0.225f, 0.180f, 0.088f}, {0.185f, 0.150f, 0.082f},
                                 {0.105f, 0.082f, 0.056f}, {0.098f, 0.104f, 0.040f},
                                 {0.076f, 0.092f, 0.030f}, {0.052f, 0.070f, 0.024f},
                                 {0.120f, 0.118f, 0.050f}, {0.155f, 0.138f, 0.066f}};
    int k = (int)(noise_unit(hash, 11) * 8.0f);
    Vec3 color = vec3_scale(crops[k > 7 ? 7 : k], 0.85f + 0.3f * noise_unit(hash, 12));
    return vec3_scale(color, 1.0f + 0.16f * clampf(patch, -1.2f, 1.2f));
}

static Ground fields(const Material *m, const SurfacePoint *point, float patch, float broad)
{
    Vec3 p = point->object_position;
    p.x += 5.0f * broad;
    p.z += 5.0f * patch;
    Parcel parcel = parcel_at(p);
    Ground g = {.color = crop_color(parcel.hash, patch)};
    const float tramline = 18.0f;
    float seen = pattern_detail(0.35f * tramline, point->footprint);
    float line = fabsf(parcel.across / tramline - floorf(parcel.across / tramline) - 0.5f);
    float worn = seen * smoothstepf(0.44f, 0.49f, line);
    g.color = vec3_scale(g.color, 1.0f - 0.18f * worn);
    // A balk of grass; along some of them a hedge.
    float fine = pattern_octaves(point, 7.0f, 4, 0.7f, 1.0f, SEED_FIELD + 3).value;
    float balk = smoothstepf(3.2f, 1.6f, parcel.edge + 1.2f * fine);
    Vec3 hedge = vec3_scale(m->color2, 0.40f + 0.2f * clampf(fine, -1.0f, 1.0f));
    Vec3 grass = vec3_scale(m->color2, 1.0f);
    float grown = smoothstepf(0.0f, 0.35f, broad + patch * 0.6f);
    g.color = vec3_lerp(g.color, vec3_lerp(grass, hedge, grown), balk);
    return g;
}

// ---- the river's own ground

static Ground sand(const SurfacePoint *point, Vec3 color, float damp)
{
    PatternOctaves sheets = pattern_octaves(point, 34.0f, 5, 0.6f, 1.0f, SEED_SAND);
    PatternOctaves ripples = pattern_octaves(point, 3.0f, 6, 0.7f, 1.0f, SEED_SAND + 9);
    float tone = 1.0f + 0.10f * clampf(sheets.value, -1.3f, 1.3f) +
                 0.09f * clampf(ripples.value, -1.3f, 1.3f);
    float wet = smoothstepf(0.72f, 0.82f, damp + 0.03f * sheets.value);
    Ground g = {.color = vec3_scale(color, tone * (1.0f - 0.42f * wet))};
    g.slope = vec3_madd(vec3_scale(ripples.slope, 0.03f), 0.1f, sheets.slope);
    return g;
}

static Ground meadow(const Material *m, const SurfacePoint *point, float dry)
{
    PatternOctaves sward = pattern_octaves(point, 9.0f, 6, 0.66f, 1.0f, SEED_SWARD);
    PatternOctaves tufts = pattern_octaves(point, 1.1f, 4, 0.7f, 0.8f, SEED_SWARD + 9);
    Vec3 straw = {0.178f, 0.150f, 0.066f};
    float t = clampf(dry + 0.16f * sward.value, 0.0f, 1.0f);
    Ground g = {.color = vec3_lerp(m->color2, straw, t)};
    g.color = vec3_scale(g.color, 1.0f + 0.15f * clampf(sward.value, -1.3f, 1.3f) +
                                      0.14f * clampf(tufts.value, -1.3f, 1.3f));
    g.slope = vec3_madd(vec3_scale(tufts.slope, 0.10f), 0.10f, sward.slope);
    return g;
}

// Willows that seedlings on bare sand have become, and the scrub that fills wet hollows.
static Ground thicket(const Material *m, const SurfacePoint *point)
{
    Vec3 color = vec3_mul(m->color2, vec3(0.74f, 0.80f, 0.80f));
    return ground_crowns(point, 6.0f, color, 0.4f, SEED_SWARD + 20);
}

static Ground reeds(const SurfacePoint *point)
{
    PatternOctaves beds = pattern_octaves(point, 12.0f, 6, 0.65f, 1.0f, SEED_SWARD + 30);
    Vec3 green = {0.070f, 0.082f, 0.030f}, brown = {0.128f, 0.104f, 0.055f};
    Ground g = {.color = vec3_lerp(green, brown, smoothstepf(-0.5f, 0.6f, beds.value))};
    g.color = vec3_scale(g.color, 1.0f + 0.18f * clampf(beds.value, -1.2f, 1.2f));
    g.slope = vec3_scale(beds.slope, 0.15f);
    return g;
}

void pattern_floodplain(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float age = point->site.x, damp = point->site.y;
    float upright = fabsf(surface_smooth_normal(point).y);
    float broad = pattern_octaves(point, 260.0f, 5, 0.6f, 1.0f, SEED_BROAD).value;
    float patch = pattern_octaves(point, 30.0f, 6, 0.66f, 1.0f, SEED_PATCH).value;
    // How long the ground has lain: meander.c.
    float lain = 9.0f * age / fmaxf(0.74f - age, 0.005f) + 0.7f * patch;
    Ground ground = sand(point, shade->color, damp), over;
    over = thicket(m, point);
    float ridge = smoothstepf(0.62f, 0.45f, damp);
    float young = smoothstepf(0.9f, 2.1f, lain + 0.6f * ridge);
    ground = ground_blend(ground, &over, young * (0.5f + 0.5f * smoothstepf(-0.3f, 0.3f, patch)));
    over = meadow(m, point, 1.05f - 2.2f * damp + 0.30f * broad + 0.12f * patch);
    ground = ground_blend(ground, &over, smoothstepf(3.0f, 7.0f, lain + 1.5f * broad));
    over = reeds(point);
    float marsh = smoothstepf(0.50f, 0.62f, damp + 0.04f * patch) * smoothstepf(2.5f, 4.5f, lain);
    ground = ground_blend(ground, &over, marsh);
    over = fields(m, point, patch, broad);
    ground = ground_blend(ground, &over, smoothstepf(0.715f, 0.73f, age));
    // Earth of banks that the river undercuts.
    Vec3 earth = vec3_scale(vec3(0.150f, 0.112f, 0.072f), 1.0f + 0.2f * clampf(patch, -1.0f, 1.0f));
    float steep = smoothstepf(0.955f, 0.90f, upright) * smoothstepf(0.03f, 0.06f, age);
    ground.color = vec3_lerp(ground.color, earth, 0.85f * steep);
    shade->color = ground.color;
    shade->normal = pattern_tilt(shade->normal, vec3_scale(ground.slope, m->pattern_depth));
}

// Silt and what is dissolved hide the bed (color2) within a metre or so. site.x = depth / (1 m +
// depth), site.y how rough the flow is.
void pattern_river(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const float clear = 0.45f; // m: depth in which the bed fades to 1 / e
    float depth = point->site.x / fmaxf(1.0f - point->site.x, 0.02f), rough = point->site.y;
    PatternOctaves drift = pattern_octaves(point, 60.0f, 4, 0.6f, 1.0f, 463);
    float seen = expf(-depth / clear);
    Vec3 body = vec3_scale(shade->color, 1.0f + 0.12f * clampf(drift.value, -1.0f, 1.0f));
    shade->color = vec3_lerp(body, m->color2, 0.8f * seen);
    // Wind and boils ruffle some of it.
    float ruffled = smoothstepf(-0.4f, 0.6f, drift.value);
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 3.0f;
    PatternOctaves waves = pattern_octaves(point, scale, 6, 0.55f, 1.0f, 467);
    float height = m->pattern_depth * (0.3f + 0.7f * ruffled) * (0.6f + rough);
    Vec3 slope = vec3(waves.slope.x, 0.0f, waves.slope.z);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, height));
}
