// Badlands: soft bare beds. Each bed meets the next in a ragged, sharp contact; mud that rain has
// washed down hangs below contacts in tongues; hard beds stand out as ledges, broken along the
// strike, above chips of their own; clay swells and dries to crumbs like popcorn; runnels, finer
// than the land's own rills, follow the fall of each wall; washes are pale silt with threads of
// gravel. SurfacePoint.site.y: 0 on crests, up to 0.5 in rills, 1 on washes.
//
// Lengths are for a pattern_scale of 10 m, heights for a pattern_depth of 0.5 m.
#include "base/strata.h"
#include "render/material/pattern.h"
#include "render/material/pattern_beds.h"
#include "render/material/pattern_clay.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_slopes.h"

#include <stddef.h>

enum {
    SEED_FRAY = 111,
    SEED_RUNNEL = 1201,
    SEED_CRUMB = 127,
    SEED_SILT = 131,
    SEED_SCRUB = 141,
    SEED_VEIL = 145,
    SEED_LUMP = 151,
    SEED_BREAK = 161,
    SEED_CHIP = 165,
    SEED_TONGUE = 171,
    SEED_GRAVEL = 175
};

// ---- runnels

enum { WAYS = 8 }; // in half a turn

// Waves of noise across a way in plan, drawn out along it, folded so that they crease where the
// noise is 0: furrows with round ribs between. width: m, of the widest.
static PatternOctaves furrows_along(Vec3 p, Vec3 across, float width, uint32_t seed)
{
    const float length = 9.0f; // of a runnel, in its widths, down the slope
    PatternOctaves sum = {0};
    float height = 1.0f, norm = 0.0f;
    Vec3 along = vec3(-across.z, 0.0f, across.x);
    for (uint32_t k = 0; k < 5; k++, width *= 0.47f, height *= 0.6f) {
        float by = 1.0f / width, down = by / length;
        Vec3 gradient,
            q = vec3(vec3_dot(p, across) * by, 1.4f * p.y * down, vec3_dot(p, along) * down);
        float n = noise_solid(q, seed + k, &gradient), sign = n < 0.0f ? -2.0f : 2.0f;
        sum.value += height * (sign * n - 0.6f);
        Vec3 slope = vec3_scale(across, gradient.x * by);
        slope.y += 1.4f * gradient.y * down;
        slope = vec3_madd(slope, gradient.z * down, along);
        sum.slope = vec3_madd(sum.slope, height * width * sign, slope);
        norm += height;
    }
    sum.value /= norm;
    return sum;
}

// Runnels down the fall of the surface, `width` m apart: about -1 in their beds, 1 on ribs, 0 where
// it is level. slope: of a relief of a width's height.
static PatternOctaves runnels(const SurfacePoint *point, Vec3 normal, float width)
{
    PatternOctaves sum = {0};
    float level = normal.x * normal.x + normal.z * normal.z;
    float shown = smoothstepf(0.04f, 0.2f, level) * pattern_detail(width, point->footprint);
    if (shown <= 0.0f) {
        return sum;
    }
    static const float way[WAYS][2] = {{1.00000000f, 0.00000000f},  {0.92387953f, 0.38268343f},
                                       {0.70710678f, 0.70710678f},  {0.38268343f, 0.92387953f},
                                       {0.00000000f, 1.00000000f},  {-0.38268343f, 0.92387953f},
                                       {-0.70710678f, 0.70710678f}, {-0.92387953f, 0.38268343f}};
    float by = 1.0f / sqrtf(level), squares = 0.0f;
    for (uint32_t k = 0; k < WAYS; k++) {
        // Of the two ways on both sides of the fall, and no others.
        float along = fabsf(normal.x * way[k][0] + normal.z * way[k][1]) * by;
        float weight = fmaxf(0.0f, (along - 0.92387953f) * (1.0f / 0.07612047f));
        if (weight > 0.0f) {
            Vec3 across = vec3(-way[k][1], 0.0f, way[k][0]);
            PatternOctaves one =
                furrows_along(point->object_position, across, width, SEED_RUNNEL + 16 * k);
            sum.value += weight * one.value;
            sum.slope = vec3_madd(sum.slope, weight, one.slope);
            squares += weight * weight;
        }
    }
    float scale = shown / sqrtf(fmaxf(squares, 1e-6f));
    sum.value *= scale;
    sum.slope = vec3_scale(sum.slope, scale);
    return sum;
}

// ---- beds

// The phase of a level within beds of this thickness, gently folded.
static float own_level(const SurfacePoint *point, float thickness)
{
    Vec3 p = point->object_position, q = vec3_scale(p, 0.11f / thickness);
    float fold =
        1.8f * noise_solid(vec3_scale(q, 0.12f), 51, NULL) + 0.35f * noise_solid(q, 52, NULL);
    return (0.05f * p.x + p.y + 0.03f * p.z) / thickness + fold;
}

// blur: the height that a pixel covers, in beds.
static float own_tone(float level, float blur, uint32_t seed)
{
    float floor_level = floorf(level), t = level - floor_level;
    uint32_t bed = (uint32_t)(int32_t)floor_level * 2654435761u + seed;
    float soft = 1.0f - clampf(0.03f + 0.12f * noise_unit(bed, 4), blur, 1.0f);
    return lerpf(noise_unit(bed, 3), noise_unit(bed + 2654435761u, 3), smoothstepf(soft, 1.0f, t));
}

// Bands of the material's colours, where the land has no beds.
static Vec3 own_bed(const Material *m, const SurfacePoint *point, Vec3 base, float rough)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 40.0f;
    float level = own_level(point, scale) + 0.05f * rough,
          blur = fminf(point->footprint / scale, 1.0f);
    float tone = own_tone(level, blur, 11);
    tone = lerpf(tone, own_tone(3.7f * level, fminf(3.7f * blur, 1.0f), 13),
                 0.45f * pattern_detail(0.3f * scale, point->footprint));
    Vec3 pale = {0.47f, 0.36f, 0.25f}, dark = {0.16f, 0.065f, 0.043f};
    Vec3 color = vec3_lerp(base, m->color2, smoothstepf(0.25f, 0.55f, tone));
    color = vec3_lerp(color, pale, smoothstepf(0.66f, 0.86f, tone));
    return vec3_lerp(color, dark, 0.75f * smoothstepf(0.24f, 0.08f, tone));
}

// ---- the relief of walls

typedef struct Wall {
    float scale, tall; // of lengths, and of heights
    float level;       // m: in the beds, where contacts are ragged
    float hardness;    // of its bed
    float veil, rough; // noise about 0: of tens of metres; of a metre and less
    float run;         // -1 in runnels, 1 on ribs
    float tone;        // of the lamina, 0..1
    float shade;       // 0..1: in cracks and under ledges
    float chips, chip; // share covered by chips of the ledges above; tone of one
    float crumb;       // about -1..1: tone of a crumb of dried clay
    float height;      // m: of all of it
} Wall;

// Is the ledge of a bed whole here? Blocks have fallen out of it, and others stand out less.
static float unbroken(const SurfacePoint *point, const Wall *w)
{
    Vec3 p = point->object_position;
    PatternOctaves gaps = pattern_octaves(point, 4.0f * w->scale, 4, 0.6f, 0.25f, SEED_BREAK);
    float by = 1.0f / (0.9f * w->scale);
    CellPoint block = noise_cells(vec3(by * p.x, 0.35f * by * p.y, by * p.z), SEED_BREAK + 8);
    float joint = 1.0f - smoothstepf(0.0f, 0.09f, block.border);
    float out = 0.4f + 0.6f * noise_unit(block.cell, 3) - 0.5f * joint;
    return out * smoothstepf(-0.35f, 0.15f, gaps.value);
}

// Hard beds stand out, with an edge below that is sharper than above; soft ones are undercut.
static void stand_out(const SurfacePoint *point, Wall *w)
{
    const Strata *strata = point->strata;
    int bed = strata_bed(strata, w->level), last = strata->bed_count - 1;
    float own = strata->bed[bed].ledge, above = bed > 0 ? strata->bed[bed - 1].ledge : 0.0f;
    float over = bed > 0 ? strata->floor[bed - 1] - w->level : 1e3f;
    float under = bed < last ? w->level - strata->floor[bed] : 1e3f;
    float edge = fmaxf(0.025f, 0.5f * point->footprint);
    if (own <= 0.0f && (above <= 0.0f || over > 2.0f * above)) {
        return;
    }
    float whole = unbroken(point, w);
    if (own > 0.0f) {
        float low = smoothstepf(0.0f, edge, under), high = clampf(over / (0.7f * own), 0.0f, 1.0f);
        w->height += own * whole * low * (1.0f - (1.0f - high) * (1.0f - high));
    } else {
        float near = 1.0f - smoothstepf(0.0f, 2.0f * above, over);
        w->height -= 0.4f * above * whole * near;
        w->shade = 0.6f * whole * near;
    }
}

// Chips of the ledge above, ever fewer down the wall.
static void scatter_chips(const SurfacePoint *point, Wall *w, float upright)
{
    const float reach = 4.0f * w->scale;
    const Strata *strata = point->strata;
    int bed = strata_bed(strata, w->level);
    float away = reach;
    for (int i = bed; i > 0 && away >= reach; i--) {
        float down = strata->floor[i - 1] - w->level;
        if (down > reach) {
            break;
        }
        away = strata->bed[i - 1].ledge > 0.0f ? down : reach;
    }
    float density = 0.4f * (1.0f - away / reach) * smoothstepf(0.35f, 0.65f, upright);
    density *= clampf(0.5f - 0.6f * w->run + 0.8f * w->veil, 0.0f, 1.0f);
    if (density > 0.0f) {
        float size = 0.14f * w->scale;
        Mounds large = pattern_mounds(point, density, size, SEED_CHIP);
        Mounds small = pattern_mounds(point, density, 0.45f * size, SEED_CHIP + 1);
        w->chips = fmaxf(large.share, small.share);
        w->chip = large.share > small.share ? large.tone : small.tone;
        w->height += 0.22f * size * w->tall * large.share + 0.1f * size * w->tall * small.share;
    }
}

// Clay that has swollen and dried: crumbs of two sizes with cracks between.
static void crumble(const SurfacePoint *point, Wall *w)
{
    float size = 0.12f * w->scale, clay = 1.0f - smoothstepf(0.3f, 0.5f, w->hardness);
    clay *= smoothstepf(-0.7f, 0.2f, w->veil + 0.7f * w->rough + 0.3f);
    for (uint32_t k = 0; k < 2; k++, size *= 0.42f) {
        float seen = clay * pattern_detail(size, point->footprint);
        if (seen <= 0.0f) {
            return;
        }
        CellPoint cell = noise_cells_on(vec3_scale(point->object_position, 1.0f / size),
                                        surface_smooth_normal(point), SEED_CRUMB + k);
        float dome = smoothstepf(0.0f, 0.45f, cell.border);
        float high = dome * (0.6f + 0.8f * noise_unit(cell.cell, 3)) - 0.55f;
        w->height += 0.42f * size * w->tall * seen * high;
        w->shade = fmaxf(w->shade, 0.38f * seen * (1.0f - smoothstepf(0.0f, 0.16f, cell.border)));
    }
}

// The skin of clay, of whatever bed, that steep walls and chips of ledges do not hold.
static void dry(const Material *m, const SurfacePoint *point, Wall *w)
{
    if (m->cracks > 0.0f) {
        float upright = fabsf(surface_smooth_normal(point).y);
        float stays = smoothstepf(0.2f, 0.65f, upright) * (1.0f - 0.6f * w->chips);
        DriedClay clay = pattern_dried_clay(point, m->cracks * stays, 0.0f);
        w->height += clay.height;
        w->shade = fmaxf(w->shade, clay.shade);
        w->crumb = clay.tone;
    }
}

static Wall wall_at(const Material *m, const SurfacePoint *point)
{
    float s = 0.1f * (m->pattern_scale > 0.0f ? m->pattern_scale : 40.0f);
    Wall w = {.scale = s, .tall = 2.0f * m->pattern_depth, .tone = 0.5f};
    const Strata *strata = point->strata;
    Vec3 p = point->object_position, normal = surface_smooth_normal(point);
    w.veil = pattern_octaves(point, 22.0f * s, 5, 0.6f, 0.6f, SEED_VEIL).value;
    w.rough = pattern_octaves(point, 1.7f * s, 8, 0.56f, 1.2f, SEED_FRAY).value;
    w.run = runnels(point, normal, 1.3f * s).value;
    w.height = w.tall * s * (0.2f * w.run + 0.03f * w.rough);
    if (strata) {
        float base = strata_base(strata, p.x, p.z);
        w.level = p.y - base + s * (0.4f * w.veil + 0.05f * w.rough);
        w.hardness = strata->bed[strata_bed(strata, w.level)].hardness;
        w.tone = beds_lamina_tone(strata, w.level, point->footprint, 0.14f);
        float firm = 0.25f + 0.75f * smoothstepf(0.2f, 0.5f, w.hardness);
        w.height += 0.22f * w.tall * s * firm * (w.tone - 0.5f);
        stand_out(point, &w);
        scatter_chips(point, &w, fabsf(normal.y));
    }
    crumble(point, &w);
    dry(m, point, &w);
    return w;
}

// ---- walls and washes

// What rain has washed down from the beds above hangs over those below in tongues.
static Vec3 washed_beds(const SurfacePoint *point, const Wall *w, float gully)
{
    const Strata *strata = point->strata;
    const float contact = 0.02f; // m
    float half = 0.5f * (contact + point->footprint);
    Vec3 own = beds_mean_between(strata, w->level - half, w->level + half);
    float streak =
        pattern_fall_lines(point, 0.45f * w->scale, 4, 0.7f, SEED_TONGUE).value + 0.25f * w->veil;
    float tongue = smoothstepf(-0.05f, 0.6f, streak - 0.15f * w->run + 0.3f * gully);
    float above = w->level + w->scale * (0.1f + 2.2f * tongue);
    Vec3 mud = beds_mean_between(strata, above - half, above + half + 0.4f * w->scale * tongue);
    float firm = smoothstepf(0.35f, 0.55f, w->hardness);
    float share =
        clampf(0.12f + 0.6f * tongue + 0.1f * w->rough, 0.0f, 0.8f) * (1.0f - 0.7f * firm);
    return vec3_lerp(own, mud, share);
}

static Ground wall(const Material *m, const SurfacePoint *point, Vec3 base)
{
    Wall w = wall_at(m, point);
    Vec3 mud = vec3_lerp(base, m->color2, 0.5f);
    float gully = smoothstepf(0.05f, 0.45f, point->site.y);
    Ground g = {.color = point->strata ? washed_beds(point, &w, gully)
                                       : own_bed(m, point, base, w.rough)};
    float dust = 0.1f + 0.2f * w.veil - 0.06f * w.run + 0.25f * gully;
    g.color = vec3_lerp(g.color, mud, clampf(dust, 0.02f, 0.5f));
    float light = 1.0f + 0.45f * (w.tone - 0.5f) + 0.1f * w.rough + 0.07f * w.run + 0.25f * w.crumb;
    g.color = vec3_scale(g.color, clampf(light, 0.5f, 1.5f) * (1.0f - 0.5f * w.shade));
    g.color = vec3_lerp(g.color, vec3_scale(vec3(0.47f, 0.41f, 0.33f), 0.6f + 0.5f * w.chip),
                        0.8f * w.chips);
    return g;
}

// Threads of the last flood, 1 in their beds, between bars of gravel.
static float threads(const SurfacePoint *point, float s)
{
    float n = pattern_octaves(point, 7.0f * s, 4, 0.5f, 1.0f, SEED_SILT + 8).value;
    return 1.0f - smoothstepf(0.08f, 0.3f, fabsf(n));
}

// Pebbles of three sizes on the bars; their share, and the tone and height of the highest.
static float pebbles(const SurfacePoint *point, float density, float s, float *tone, float *height)
{
    float share = 0.0f, size = 0.3f * s;
    *tone = 0.5f;
    *height = 0.0f;
    for (uint32_t k = 0; k < 3; k++, size *= 0.45f, density = fminf(1.6f * density, 0.95f)) {
        Mounds one = pattern_mounds(point, density, size, SEED_GRAVEL + k);
        *tone = one.share > share ? one.tone : *tone;
        share = fmaxf(share, one.share);
        *height = fmaxf(*height, 0.3f * size * one.share);
    }
    return share;
}

// Silt, with mud that has cracked where the last water stood.
static Ground silt(const Material *m, const SurfacePoint *point, Vec3 base, float *height)
{
    float s = 0.1f * (m->pattern_scale > 0.0f ? m->pattern_scale : 40.0f), tone, high;
    PatternOctaves sand = pattern_octaves(point, 3.0f * s, 8, 0.55f, 1.0f, SEED_SILT);
    float thread = threads(point, s);
    float share = pebbles(point, 0.3f * (1.0f - thread) * clampf(0.6f + sand.value, 0.0f, 1.5f), s,
                          &tone, &high);
    Vec3 mean = point->strata ? point->strata->mean_color : vec3_lerp(base, m->color2, 0.5f);
    Ground g = {.color = vec3_lerp(mean, vec3(0.53f, 0.46f, 0.37f), 0.6f)};
    float light = 0.93f + 0.1f * clampf(sand.value, -1.3f, 1.3f) + 0.16f * thread;
    Vec3 p = vec3_scale(point->object_position, 1.0f / (0.28f * s));
    float dried = smoothstepf(0.5f, 0.9f, thread - 0.3f * sand.value);
    float crack = 0.0f;
    if (dried > 0.0f && pattern_detail(0.28f * s, point->footprint) > 0.0f) {
        float seen = dried * pattern_detail(0.28f * s, point->footprint);
        crack = seen * (1.0f - smoothstepf(0.02f, 0.09f, noise_cells(p, SEED_SILT + 31).border));
    }
    g.color = vec3_scale(g.color, light * (1.0f - 0.4f * crack));
    g.color = vec3_lerp(g.color, vec3_scale(mean, 0.6f + 0.9f * tone), 0.8f * share);
    float scrub = pattern_octaves(point, 0.9f * s, 3, 0.7f, 1.0f, SEED_SCRUB).value;
    scrub = smoothstepf(0.5f, 0.7f, scrub - 0.5f * thread);
    g.color = vec3_lerp(g.color, vec3(0.12f, 0.115f, 0.065f), 0.4f * scrub);
    float relief = 0.04f * sand.value - 0.1f * thread - 0.025f * crack + high + 0.05f * scrub;
    *height = 2.0f * m->pattern_depth * s * relief;
    if (m->cracks > 0.0f) {
        DriedClay clay = pattern_dried_clay(point, m->cracks * (1.0f - share), 1.0f);
        *height += clay.height;
        g.color = vec3_scale(g.color, (1.0f + 0.25f * clay.tone) * (1.0f - 0.5f * clay.shade));
    }
    return g;
}

// The share of wash, not wall.
static float washes(const Material *m, const SurfacePoint *point)
{
    float s = 0.1f * (m->pattern_scale > 0.0f ? m->pattern_scale : 40.0f);
    float upright = fabsf(surface_smooth_normal(point).y);
    float fray = pattern_octaves(point, 1.2f * s, 4, 0.6f, 1.0f, SEED_SILT + 16).value;
    return smoothstepf(0.55f, 0.85f, point->site.y + 0.08f * fray) *
           smoothstepf(0.90f, 0.97f, upright + 0.03f * fray);
}

float pattern_badlands_height(const Material *m, const SurfacePoint *point)
{
    float flat = washes(m, point), floor = 0.0f, height = 0.0f;
    if (flat < 1.0f) {
        height = (1.0f - flat) * wall_at(m, point).height;
    }
    if (flat > 0.0f) {
        silt(m, point, m->color, &floor);
    }
    return height + flat * floor;
}

static float height_near(const Material *m, const SurfacePoint *point, Vec3 p)
{
    SurfacePoint at = *point;
    at.object_position = p;
    return pattern_badlands_height(m, &at);
}

void pattern_badlands(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float flat = washes(m, point), height;
    Ground g = {0}, floor = {0};
    g = flat < 1.0f ? wall(m, point, shade->color) : g;
    floor = flat > 0.0f ? silt(m, point, shade->color, &height) : floor;
    shade->color = ground_blend(g, &floor, flat).color;
    if (m->pattern_depth > 0.0f) {
        shade->normal = pattern_tilt(shade->normal, pattern_bump(m, point, height_near, 0.004f));
    }
}
