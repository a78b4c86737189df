// The floodplain of a meandering river: sand on fresh point bars, willows behind it, meadows whose
// scrolls are pale on ridges and lush in swales, reeds where cut bends fill, fields on ground that
// the river has not reached. site.x is the age of the ground (HeightField.age), site.y how damp it
// is.
#include "render/material/pattern.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

enum {
    SEED_BROAD = 701,
    SEED_PATCH = 711,
    SEED_SAND = 721,
    SEED_SWARD = 731,
    SEED_FIELD = 741,
    SEED_SHRUB = 761
};

// What the river has left at a place.
typedef struct Laid {
    float lain;   // how long the ground has lain, in the time of meander.c
    float scroll; // -1 in a swale of the bar that it was, 1 on a ridge
    float line;   // -1..1: of finer ridges, which follow these
    float damp;
    float patch, broad; // noise of 30 and 260 m
} Laid;

// The age tells the time, and how much lower than a level bar of that time the ground lies is the
// scroll: meander.c. Finer ridges than the land's samples are noise over time alone.
static Laid laid_at(const SurfacePoint *point)
{
    const float banks = 0.045f, toe = 0.011f, scrolls = 0.22f;
    Laid l = {.damp = point->site.y};
    float age = point->site.x;
    l.broad = pattern_octaves(point, 260.0f, 5, 0.6f, 1.0f, SEED_BROAD).value;
    l.patch = pattern_octaves(point, 30.0f, 6, 0.66f, 1.0f, SEED_PATCH).value;
    l.lain = 9.0f * age / fmaxf(0.74f - age, 0.005f);
    float grown = l.lain / (l.lain + 2.5f), fades = 40.0f / (40.0f + l.lain);
    float level = ((1.0f - l.damp) * 1.25f - toe / banks) / (1.0f - toe / banks);
    float above = (level - grown) / fmaxf(scrolls * grown * fades, 0.03f);
    l.scroll = clampf(above + 0.12f * l.patch, -1.2f, 1.2f);
    float seen = pattern_detail(8.0f, point->footprint);
    float time = 5.0f * l.lain + 0.25f * l.patch;
    l.line = seen > 0.0f ? seen * noise_solid(vec3(time, 0.5f, 0.25f), SEED_SAND + 5, NULL) : 0.0f;
    return l;
}

// ---- shrubs

typedef struct Shrubs {
    float cover; // 0..1: is the place under one?
    Vec3 slope;  // of their crowns, per metre
    float tone;  // -1..1, of each
} Shrubs;

// Shrubs of very different widths up to `size` m, as many as `share` (0..1) of those that find
// room, each a crown with a ragged edge.
static Shrubs shrubs_at(const SurfacePoint *point, float size, float share, uint32_t seed)
{
    Shrubs s = {0};
    float seen = pattern_detail(1.6f * size, point->footprint);
    const float mean = 0.30f; // of the ground under them, where all stand
    if (share <= 0.0f) {
        return s;
    }
    s.cover = mean * share;
    if (seen <= 0.0f) {
        return s;
    }
    Vec3 p = vec3_scale(point->object_position, 1.0f / size);
    CellPoint cell = noise_cells_on(vec3(p.x, 0.5f, p.z), vec3(0, 1, 0), seed);
    bool stands = noise_unit(cell.cell, 1) < share;
    float own = noise_unit(cell.cell, 2), radius = 0.16f + 0.42f * own * own;
    float ragged = pattern_octaves(point, 0.5f * size, 4, 0.7f, 1.0f, seed + 1).value;
    float x = cell.point.x, z = cell.point.z, away = sqrtf(x * x + z * z);
    float inside = radius * (1.0f + 0.35f * ragged) - away, soft = point->footprint / size;
    float cover = stands ? smoothstepf(-0.5f * soft, 0.03f + 0.5f * soft, inside) : 0.0f;
    s.cover = lerpf(s.cover, cover, seen);
    s.tone = seen * (2.0f * noise_unit(cell.cell, 3) - 1.0f);
    float rise = seen * cover * 0.7f * away / fmaxf(radius, 0.05f);
    s.slope = away > 1e-4f ? vec3(rise * x / away, 0.0f, rise * z / away) : s.slope;
    return s;
}

static Ground add_shrubs(Ground ground, const Shrubs *shrubs, Vec3 color)
{
    Vec3 own = vec3_scale(color, 1.0f + 0.30f * shrubs->tone);
    ground.color = vec3_lerp(ground.color, own, shrubs->cover);
    ground.slope = vec3_lerp(ground.slope, shrubs->slope, shrubs->cover);
    return ground;
}

// ---- fields

// A parcel of farmland.
typedef struct Parcel {
    uint32_t hash;
    float edge;          // m to its border
    float track;         // m to the track between furlongs
    float across, along; // m, across its furrows, and from its end
} Parcel;

// Where the border below a strip lies, in strips: each is moved a little.
static float strip_border(uint32_t row, float column)
{
    return column + 0.3f * (noise_unit(row + (uint32_t)(int32_t)column, 5) - 0.5f);
}

// Furlongs of one direction each, of strips that are cut to lengths and widths of their own: narrow
// ones here, there fields that have been laid together.
static Parcel parcel_at(Vec3 p)
{
    const float furlong = 560.0f;
    CellPoint cell = noise_cells(vec3(p.x / furlong, 0.5f, p.z / furlong), SEED_FIELD);
    float joined = noise_unit(cell.cell, 4);
    float length = 120.0f + 260.0f * noise_unit(cell.cell, 6);
    float width = 22.0f + 150.0f * joined * joined;
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
                    .edge = fminf(fminf(side, end), cell.border * furlong - 3.0f),
                    .track = cell.border * furlong,
                    .across = end < 11.0f ? u : v, // they turn on the headland
                    .along = end};
}

// Late summer: stubble, straw, ploughed earth, pasture, beet and maize.
static Vec3 crop_color(uint32_t hash)
{
    static const Vec3 crops[] = {{0.245f, 0.195f, 0.095f}, {0.195f, 0.160f, 0.088f},
                                 {0.092f, 0.070f, 0.050f}, {0.098f, 0.108f, 0.038f},
                                 {0.070f, 0.092f, 0.028f}, {0.045f, 0.066f, 0.022f},
                                 {0.125f, 0.122f, 0.050f}, {0.165f, 0.145f, 0.068f}};
    int k = (int)(noise_unit(hash, 11) * 8.0f);
    return vec3_scale(crops[k > 7 ? 7 : k], 0.85f + 0.3f * noise_unit(hash, 12));
}

// -1..1: rows `apart` m from each other, as far as the pixel shows them.
static float rows_at(float across, float apart, float footprint)
{
    float seen = pattern_detail(1.4f * apart, footprint);
    return seen > 0.0f ? seen * sinf(2.0f * PI_F * across / apart) : 0.0f;
}

// Wheel tracks 1.8 m from each other, every `apart` m: their share.
static float wheel_tracks(float across, float apart, float footprint)
{
    float line = fabsf(across - apart * floorf(across / apart + 0.5f));
    return pattern_detail(4.0f, footprint) * smoothstepf(0.75f, 0.35f, fabsf(line - 0.9f));
}

static Ground crops(const SurfacePoint *point, const Parcel *parcel, const Laid *l)
{
    Ground g = {.color = crop_color(parcel->hash)};
    float fine = pattern_octaves(point, 5.0f, 5, 0.72f, 1.0f, SEED_FIELD + 5).value;
    float apart = 2.2f + 2.8f * noise_unit(parcel->hash, 13);
    float rows = rows_at(parcel->across + 0.3f * fine, apart, point->footprint);
    float swath =
        rows_at(parcel->across, 11.0f + 7.0f * noise_unit(parcel->hash, 14), point->footprint);
    float tone = 1.0f + 0.15f * clampf(l->patch, -1.3f, 1.3f) + 0.10f * clampf(fine, -1.5f, 1.5f) +
                 0.10f * rows + 0.05f * swath;
    tone *= 1.0f - 0.28f * wheel_tracks(parcel->across, 24.0f, point->footprint);
    tone *= parcel->along < 11.0f ? 0.92f : 1.0f; // worn by turning
    g.color = vec3_scale(g.color, fmaxf(tone, 0.3f));
    // Wet or poor spots.
    float spot = smoothstepf(0.5f, 1.0f, l->patch + 0.5f * l->broad);
    g.color = vec3_lerp(g.color, vec3_scale(g.color, 0.72f), spot);
    return g;
}

static Ground fields(const Material *m, const SurfacePoint *point, const Laid *l)
{
    Vec3 p = point->object_position;
    p.x += 4.0f * l->broad + 1.2f * l->patch;
    p.z += 4.0f * l->broad - 1.2f * l->patch;
    Parcel parcel = parcel_at(p);
    Ground g = crops(point, &parcel, l);
    float fine = pattern_octaves(point, 4.0f, 4, 0.7f, 1.0f, SEED_FIELD + 3).value;
    float balk = smoothstepf(1.9f, 0.7f, parcel.edge + 0.7f * fine);
    Vec3 grass = vec3_scale(m->color2, 1.15f + 0.3f * clampf(fine, -1.0f, 1.0f));
    g.color = vec3_lerp(g.color, grass, balk);
    // A track with two ruts, here and there a hedge along it or along a balk.
    float verge = smoothstepf(3.6f, 2.6f, parcel.track + 0.5f * fine);
    float rut = smoothstepf(0.75f, 0.35f, fabsf(parcel.track - 0.95f) + 0.12f * fine);
    Vec3 dirt = vec3_scale(vec3(0.270f, 0.225f, 0.160f), 1.0f + 0.15f * clampf(fine, -1, 1));
    float worn = pattern_detail(3.0f, point->footprint);
    g.color = vec3_lerp(g.color, grass, verge);
    g.color = vec3_lerp(g.color, dirt, verge * lerpf(0.45f, 0.25f + 0.75f * rut, worn));
    float along = fminf(fabsf(parcel.track - 5.5f), fabsf(parcel.edge));
    bool hedged = noise_unit(parcel.hash, 15) < 0.45f || parcel.track < 9.0f;
    float width = hedged ? smoothstepf(2.6f, 1.6f, along) : 0.0f;
    float gaps = smoothstepf(-0.25f, 0.25f, l->broad + 0.9f * l->patch);
    Shrubs hedge = shrubs_at(point, 4.2f, fminf(2.0f * width * gaps, 1.0f), SEED_SHRUB + 7);
    return add_shrubs(g, &hedge, vec3_scale(m->color2, 0.50f));
}

// ---- the river's own ground

// Sheets and lines of sand that floods have laid down, drift of dark silt and wood between them.
static Ground sand(const SurfacePoint *point, Vec3 color, const Laid *l)
{
    PatternOctaves sheets = pattern_octaves(point, 34.0f, 5, 0.6f, 1.0f, SEED_SAND);
    PatternOctaves ripples = pattern_octaves(point, 3.0f, 6, 0.72f, 1.0f, SEED_SAND + 9);
    float tone = 1.0f + 0.10f * clampf(sheets.value, -1.3f, 1.3f) +
                 0.12f * clampf(ripples.value, -1.3f, 1.3f) + 0.16f * l->line;
    float wet = smoothstepf(0.70f, 0.80f, l->damp + 0.03f * sheets.value - 0.02f * l->line);
    Ground g = {.color = vec3_scale(color, tone * (1.0f - 0.50f * wet))};
    float drift = smoothstepf(0.30f, 0.55f, -l->line + 0.35f * ripples.value - 0.1f);
    g.color = vec3_lerp(g.color, vec3_mul(g.color, vec3(0.62f, 0.60f, 0.58f)), 0.8f * drift);
    g.slope = vec3_madd(vec3_scale(ripples.slope, 0.05f), 0.1f, sheets.slope);
    return g;
}

// Pioneers on the sand: first single plants, more on the ridges, then a thicket with gaps.
static Ground pioneers(Ground ground, const Material *m, const SurfacePoint *point, const Laid *l)
{
    float ripe = l->lain + 0.7f * l->scroll + 0.9f * l->patch + 0.8f * l->line;
    float herbs = smoothstepf(0.3f, 3.4f, ripe), brush = smoothstepf(0.9f, 4.5f, ripe);
    float fine = pattern_octaves(point, 1.6f, 4, 0.75f, 1.0f, SEED_SWARD + 41).value;
    float green = herbs * smoothstepf(0.75f - herbs, 1.1f - herbs, 0.5f + 0.4f * fine);
    Vec3 weeds = vec3_mul(m->color2, vec3(1.30f, 1.12f, 1.15f));
    ground.color = vec3_lerp(ground.color, weeds, 0.85f * green);
    Shrubs low = shrubs_at(point, 2.6f, 0.9f * brush, SEED_SHRUB);
    ground = add_shrubs(ground, &low, vec3_mul(m->color2, vec3(1.25f, 1.25f, 1.2f)));
    Shrubs high =
        shrubs_at(point, 5.5f, brush * smoothstepf(-0.3f, 0.6f, l->scroll), SEED_SHRUB + 2);
    return add_shrubs(ground, &high, vec3_mul(m->color2, vec3(1.1f, 1.1f, 1.05f)));
}

// Dry on ridges, lush in swales and where it was mown late; tussocks, and paths of cattle.
static Ground meadow(const Material *m, const SurfacePoint *point, const Laid *l)
{
    PatternOctaves sward = pattern_octaves(point, 9.0f, 6, 0.7f, 1.0f, SEED_SWARD);
    PatternOctaves tufts = pattern_octaves(point, 1.5f, 4, 0.75f, 0.8f, SEED_SWARD + 9);
    Vec3 straw = {0.200f, 0.165f, 0.074f}, lush = vec3_mul(m->color2, vec3(0.80f, 0.94f, 0.85f));
    float dry = 0.36f + 0.30f * l->scroll + 0.16f * l->line + 0.22f * l->broad + 0.12f * l->patch;
    float t = clampf(dry + 0.20f * sward.value, 0.0f, 1.0f);
    Ground g = {.color = vec3_lerp(lush, straw, t)};
    g.color = vec3_scale(g.color, 1.0f + 0.20f * clampf(sward.value, -1.4f, 1.4f) +
                                      0.22f * clampf(tufts.value, -1.4f, 1.4f));
    g.slope = vec3_madd(vec3_scale(tufts.slope, 0.16f), 0.14f, sward.slope);
    float path = fabsf(pattern_octaves(point, 85.0f, 3, 0.5f, 1.0f, SEED_SWARD + 51).value);
    float worn = pattern_detail(2.2f, point->footprint) * smoothstepf(0.012f, 0.004f, path);
    g.color = vec3_lerp(g.color, vec3(0.215f, 0.180f, 0.115f), 0.65f * worn);
    return g;
}

// Hay meadows of the older plain: parcels that were mown at different times.
static void mow(const SurfacePoint *point, const Laid *l, Ground *g)
{
    Vec3 p = point->object_position;
    Parcel parcel = parcel_at(vec3(p.x + 4.0f * l->broad, p.y, p.z + 3.0f * l->patch));
    float hay = smoothstepf(14.0f, 24.0f, l->lain + 6.0f * l->broad);
    float tone = 0.78f + 0.5f * noise_unit(parcel.hash, 21);
    tone *= 1.0f + 0.09f * rows_at(parcel.across, 7.0f, point->footprint);
    tone *= 1.0f - 0.35f * smoothstepf(1.4f, 0.5f, parcel.edge);
    Vec3 tint = vec3(tone * (0.9f + 0.25f * noise_unit(parcel.hash, 22)), tone, tone * 0.95f);
    g->color = vec3_lerp(g->color, vec3_mul(g->color, tint), hay);
    float rut = smoothstepf(0.75f, 0.35f, fabsf(parcel.track - 0.95f));
    rut *= pattern_detail(3.0f, point->footprint);
    g->color = vec3_lerp(g->color, vec3(0.230f, 0.195f, 0.130f), 0.8f * hay * rut);
}

// Rows of willows on the ridges of scrolls, single bushes elsewhere, in places none at all.
static Ground scrub(Ground ground, const Material *m, const SurfacePoint *point, const Laid *l)
{
    float old = smoothstepf(2.0f, 5.0f, l->lain) * smoothstepf(30.0f, 14.0f, l->lain);
    float where = smoothstepf(-0.35f, 0.35f, l->broad + 0.5f * l->patch);
    float row = old * where * smoothstepf(0.15f, 0.75f, l->scroll + 0.4f * l->line);
    float single = 0.05f * smoothstepf(-0.1f, 0.6f, l->patch);
    Shrubs tall = shrubs_at(point, 6.5f, fminf(row + single, 1.0f), SEED_SHRUB + 4);
    return add_shrubs(ground, &tall, vec3_mul(m->color2, vec3(1.15f, 1.15f, 1.05f)));
}

// Reeds and sedges in zones from the last water outward.
static Ground reeds(const SurfacePoint *point, const Laid *l)
{
    PatternOctaves beds = pattern_octaves(point, 12.0f, 6, 0.7f, 1.0f, SEED_SWARD + 30);
    PatternOctaves fine = pattern_octaves(point, 1.4f, 4, 0.75f, 1.0f, SEED_SWARD + 35);
    Vec3 sedge = {0.058f, 0.076f, 0.026f}, reed = {0.150f, 0.124f, 0.066f};
    float zone = smoothstepf(0.60f, 0.74f, l->damp + 0.06f * beds.value);
    Ground g = {.color = vec3_lerp(sedge, reed, zone)};
    g.color = vec3_scale(g.color, 1.0f + 0.24f * clampf(beds.value, -1.2f, 1.2f) +
                                      0.20f * clampf(fine.value, -1.2f, 1.2f));
    g.slope = vec3_madd(vec3_scale(fine.slope, 0.12f), 0.18f, beds.slope);
    return g;
}

void pattern_floodplain(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    Laid l = laid_at(point);
    float age = point->site.x, upright = fabsf(surface_smooth_normal(point).y);
    Ground ground = sand(point, shade->color, &l), over;
    ground = pioneers(ground, m, point, &l);
    float turf = smoothstepf(3.0f, 7.0f, l.lain + 1.5f * l.broad + 1.0f * l.patch);
    if (turf > 0.0f) {
        over = meadow(m, point, &l);
        mow(point, &l, &over);
        over = scrub(over, m, point, &l);
        ground = ground_blend(ground, &over, turf);
    }
    float wet = smoothstepf(0.50f, 0.60f, l.damp + 0.05f * l.patch);
    wet = fmaxf(wet, 0.85f * smoothstepf(-0.45f, -0.85f, l.scroll + 0.2f * l.line));
    float marsh = wet * smoothstepf(2.5f, 4.5f, l.lain) * smoothstepf(70.0f, 45.0f, l.lain);
    if (marsh > 0.0f) {
        over = reeds(point, &l);
        ground = ground_blend(ground, &over, marsh);
    }
    float farmed = smoothstepf(0.715f, 0.73f, age);
    if (farmed > 0.0f) {
        over = fields(m, point, &l);
        ground = ground_blend(ground, &over, farmed);
    }
    // Earth of banks that the river undercuts.
    Vec3 earth = vec3_scale(vec3(0.150f, 0.112f, 0.072f), 1.0f + 0.25f * clampf(l.patch, -1, 1));
    float steep = smoothstepf(0.955f, 0.88f, upright) * smoothstepf(0.03f, 0.06f, age);
    ground.color = vec3_lerp(ground.color, earth, 0.9f * steep);
    shade->color = ground.color;
    shade->normal = pattern_tilt(shade->normal, vec3_scale(ground.slope, m->pattern_depth));
}

// Silt and what is dissolved hide the bed (color2) within a metre or two: over shoals it shows
// through, golden, then green, until the water's own colour is left. site.x = depth / (1 m +
// depth), site.y how rough the flow is.
void pattern_river(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    static const float clear[3] = {1.35f, 1.15f, 0.70f}; // m: depth in which it fades to 1 / e
    float depth = point->site.x / fmaxf(1.0f - point->site.x, 0.02f), rough = point->site.y;
    PatternOctaves drift = pattern_octaves(point, 60.0f, 4, 0.6f, 1.0f, 463);
    PatternOctaves bars = pattern_octaves(point, 14.0f, 4, 0.6f, 1.0f, 465);
    float over = depth * (1.0f + 0.25f * clampf(bars.value, -1.0f, 1.0f));
    Vec3 body = vec3_scale(shade->color, 1.0f + 0.18f * clampf(drift.value, -1.0f, 1.0f));
    Vec3 seen = vec3(expf(-over / clear[0]), expf(-over / clear[1]), expf(-over / clear[2]));
    Vec3 bed = vec3_scale(m->color2, 0.9f * (1.0f + 0.1f * clampf(bars.value, -1.0f, 1.0f)));
    shade->color = vec3_add(body, vec3_mul(seen, vec3_sub(bed, body)));
    // Wind and boils ruffle some of it; between them it is calm.
    float ruffled = smoothstepf(-0.35f, 0.45f, drift.value + 0.25f * bars.value);
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 3.0f;
    PatternOctaves waves = pattern_octaves(point, scale, 6, 0.55f, 1.0f, 467);
    float height = m->pattern_depth * (0.15f + 1.1f * ruffled) * (0.6f + rough);
    Vec3 slope = vec3(waves.slope.x, 0.0f, waves.slope.z);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, height));
}
