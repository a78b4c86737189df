// Living coral: corallites (a raised ring about a dark cup, one beside the other), the winding
// ridges of brain corals, and the age of the tissue, pale where it is young.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

// Blends color and color2 by the nearness of a growing tip or margin.
static Vec3 tissue(const Material *m, Vec3 own, float birth)
{
    return vec3_lerp(own, m->color2, smoothstepf(0.15f, 1.0f, birth));
}

// The fine grain of the skin between cups, its spinules: a bump and a darker tone in its hollows.
static void add_grain(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.0004f;
    float seen = pattern_detail(scale, point->footprint);
    if (m->pattern_depth <= 0.0f || seen <= 0.0f) {
        return;
    }
    Vec3 p = vec3_scale(point->position, 1.0f / scale), slope, finer;
    float height = noise_solid(p, 51, &slope);
    height += 0.4f * noise_solid(vec3_scale(p, 2.3f), 52, &finer);
    slope = vec3_scale(vec3_madd(slope, 0.92f, finer), seen * m->pattern_depth / scale);
    shade->normal = pattern_tilt(shade->normal, slope);
    shade->color = vec3_scale(shade->color, 1.0f + 0.18f * seen * clampf(height, -1.0f, 1.0f));
}

void pattern_youth(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    Vec3 p = vec3_scale(point->position, 22.0f), old = shade->color;
    float blotch = 1.0f + 0.16f * noise_solid(p, 31, NULL);
    shade->color = vec3_scale(tissue(m, old, point->birth), blotch);
    if (m->kind == MATERIAL_LEAF) { // what reflects otherwise transmits otherwise
        shade->transmittance =
            vec3_mul(shade->transmittance, pattern_color_ratio(old, shade->color));
    }
    add_grain(m, point, shade);
}

// Height 0..1 and its slope as functions of the distance (in cells) from the border between two
// corallites: a groove, a rim, a cup.
static float ring(float border, float *slope)
{
    const float rim = 0.15f, cup = 0.34f;
    if (border < rim) {
        float t = border / rim;
        *slope = 6.0f * t * (1.0f - t) / rim;
        return t * t * (3.0f - 2.0f * t);
    }
    float t = clampf((border - rim) / (cup - rim), 0.0f, 1.0f);
    *slope = -0.85f * 6.0f * t * (1.0f - t) / (cup - rim);
    return 1.0f - 0.85f * t * t * (3.0f - 2.0f * t);
}

void pattern_corallite(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.0025f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale), warp;
    noise_solid(vec3_scale(p, 0.45f), 33, &warp);
    float large = noise_solid(vec3_scale(point->object_position, 0.045f / scale), 34, NULL);
    float detail = pattern_detail(0.8f * scale, point->footprint);
    Vec3 color = tissue(m, shade->color, point->birth);
    color = vec3_scale(color, 1.0f + 0.22f * large);
    if (detail > 0.0f) {
        CellPoint cell = noise_cells_on(vec3_madd(p, 0.12f, warp), shade->normal, 35);
        float slope, height = ring(cell.border, &slope);
        float cup = smoothstepf(0.2f, 0.36f, cell.border);
        float value =
            0.62f + 0.5f * height - 0.12f * cup + 0.16f * (noise_unit(cell.cell, 3) - 0.5f);
        color = vec3_lerp(color, vec3_scale(color, value), detail);
        Vec3 gradient = vec3_scale(cell.normal, slope / scale);
        shade->normal =
            pattern_tilt(shade->normal, vec3_scale(gradient, detail * m->pattern_depth));
    }
    shade->color = color;
}

// Height 0..1 of a brain coral by the cosine of the phase (1 on a ridge), and its slope: broad
// ridges with a groove along their crests, narrow valleys.
static float ridge(float cosine, float *slope)
{
    const float foot = -0.75f, head = 0.35f, groove = 0.9f;
    float t = clampf((cosine - foot) / (head - foot), 0.0f, 1.0f);
    float deep = fmaxf(0.0f, cosine - groove) / (1.0f - groove);
    *slope = 6.0f * t * (1.0f - t) / (head - foot) - 0.5f * deep / (1.0f - groove);
    return t * t * (3.0f - 2.0f * t) - 0.25f * deep * deep;
}

void pattern_brain(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const float wavelength = 0.4f; // of a unit cell of the noise
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.012f;
    Vec3 p = vec3_scale(point->object_position, wavelength / scale);
    float large = noise_solid(vec3_scale(point->object_position, 0.12f / scale), 36, NULL);
    float detail = pattern_detail(0.5f * scale, point->footprint);
    Vec3 middle = vec3_lerp(m->color2, shade->color, 0.6f), color = middle;
    if (detail > 0.0f) {
        Stripes stripes = noise_stripes_on(p, shade->normal, wavelength, 37);
        float slope, height = ridge(stripes.cosine, &slope);
        float sure = detail * smoothstepf(0.0f, 0.2f, stripes.strength);
        Vec3 own = vec3_lerp(m->color2, shade->color, smoothstepf(0.1f, 0.75f, height));
        color = vec3_lerp(middle, vec3_scale(own, 0.75f + 0.3f * height), sure);
        float steep = -stripes.sine * slope * wavelength / scale;
        Vec3 gradient = vec3_scale(stripes.gradient, steep * sure * m->pattern_depth);
        shade->normal = pattern_tilt(shade->normal, gradient);
    }
    shade->color = vec3_scale(color, 1.0f + 0.2f * large);
}

// ---- a boulder that lives

// What covers a point of a boulder of coral.
typedef struct ReefCover {
    float dead;   // 0..1: the coral has died here and algae grow on it
    float margin; // 0..1: bleached tissue along the border of a dead patch
    float bite;   // 0..1: scraped by a fish
    float turf;   // 0..1, of what is dead: turf, else coralline algae
} ReefCover;

// Scrapes of a beak, in groups: pairs of short grooves across a cell. Lengths in units of `size`.
static float bites_at(Vec3 p, Vec3 normal, float size, float amount, float *age)
{
    CellPoint cell = noise_cells_on(vec3_scale(p, 1.0f / size), normal, 41);
    float grazed = 0.5f + 0.5f * noise_solid(vec3_scale(p, 0.12f / size), 42, NULL);
    *age = noise_unit(cell.cell, 1);
    if (noise_unit(cell.cell, 2) > amount * grazed * grazed * 1.6f) {
        return 0.0f;
    }
    Vec3 turned = vec3(noise_unit(cell.cell, 4) - 0.5f, noise_unit(cell.cell, 5) - 0.5f,
                       noise_unit(cell.cell, 6) - 0.5f);
    Vec3 along = vec3_normalize(vec3_madd(turned, -vec3_dot(turned, normal), normal));
    Vec3 off = vec3_madd(cell.point, -vec3_dot(cell.point, normal), normal);
    float length = vec3_dot(off, along);
    float across = fabsf(vec3_dot(off, vec3_cross(normal, along)));
    float groove = (across - 0.075f) / 0.06f, end = length / (0.14f + 0.14f * *age);
    return 1.0f - smoothstepf(0.6f, 1.1f, sqrtf(groove * groove + end * end));
}

static ReefCover reef_cover(const Material *m, const SurfacePoint *point, Vec3 normal, float scale)
{
    Vec3 p = point->object_position;
    ReefCover cover = {0};
    // Patches a hand wide, with ragged borders; sides and undersides die first.
    float patch = noise_fractal(vec3_scale(p, 5.5f), 3, 43) +
                  0.22f * noise_fractal(vec3_scale(p, 60.0f), 3, 44);
    float side = 0.5f - 0.5f * normal.y;
    float line = patch + 0.55f * side - lerpf(1.15f, -0.75f, m->moss);
    float soft = fmaxf(0.03f, 1.5f * point->footprint);
    cover.dead = m->moss > 0.0f ? smoothstepf(-soft, soft, line) : 0.0f;
    cover.margin = m->moss > 0.0f ? (1.0f - cover.dead) * smoothstepf(-0.14f, -0.02f, line) : 0.0f;
    float size = 16.0f * scale, age = 0.0f, seen = pattern_detail(0.5f * size, point->footprint);
    if (m->scars > 0.0f && seen > 0.0f) {
        cover.bite = seen * (1.0f - cover.dead) * (normal.y > -0.2f ? 1.0f : 0.0f) *
                     bites_at(p, normal, size, m->scars, &age) * (0.45f + 0.55f * age);
    }
    float crust = noise_fractal(vec3_scale(p, 17.0f), 3, 45) + 0.5f * side;
    cover.turf =
        1.0f - m->lichen * smoothstepf(0.15f - 0.5f * m->lichen, 0.35f - 0.25f * m->lichen, crust);
    return cover;
}

// Algae on dead coral: a felt of turf, dusty with sand on top, or a pink crust with pale rims.
static Vec3 algae_color(const SurfacePoint *point, Vec3 normal, float turf)
{
    Vec3 p = point->object_position;
    float fine =
        noise_fractal(vec3_scale(p, 240.0f), 3, 46) * pattern_detail(0.004f, point->footprint);
    float broad = noise_fractal(vec3_scale(p, 26.0f), 3, 47);
    Vec3 felt = vec3_lerp(vec3(0.105f, 0.09f, 0.045f), vec3(0.20f, 0.165f, 0.10f),
                          clampf(0.5f + 0.7f * broad, 0.0f, 1.0f));
    float dust = smoothstepf(0.45f, 1.0f, normal.y) * clampf(0.5f + broad, 0.0f, 1.0f);
    felt = vec3_lerp(felt, vec3(0.36f, 0.33f, 0.26f), 0.5f * dust);
    Vec3 crust = vec3_lerp(vec3(0.26f, 0.105f, 0.135f), vec3(0.44f, 0.27f, 0.29f),
                           clampf(0.4f + 0.9f * broad, 0.0f, 1.0f));
    return vec3_scale(vec3_lerp(crust, felt, turf), 1.0f + 0.45f * fine);
}

void pattern_reef(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.0015f;
    Vec3 normal = surface_smooth_normal(point), p = point->object_position;
    ReefCover cover = reef_cover(m, point, normal, scale);
    // Swellings and what faces the light are paler; the tissue's tone drifts over the colony.
    float swelling = noise_fractal(vec3_scale(p, 14.0f), 2, 48);
    float drift = noise_fractal(vec3_scale(p, 4.0f), 2, 49);
    float pale = clampf(0.22f + 0.3f * swelling + 0.28f * normal.y, 0.0f, 1.0f);
    Vec3 own = vec3_lerp(shade->color, m->color2, 0.6f * pale);
    own = vec3_mul(own, vec3(1.0f + 0.12f * drift, 1.0f, 1.0f - 0.14f * drift));
    own = vec3_scale(own, lerpf(0.5f, 1.0f, smoothstepf(-0.7f, 0.25f, normal.y)));
    shade->color = own;
    pattern_corallite(m, point, shade);
    Vec3 skeleton = vec3(0.66f, 0.63f, 0.55f);
    Vec3 living =
        vec3_lerp(shade->color, skeleton, fmaxf(0.85f * cover.bite, 0.55f * cover.margin));
    shade->color = vec3_lerp(living, algae_color(point, normal, cover.turf), cover.dead);
    // Living tissue is as fine as its cups, algae are coarse.
    PatternOctaves rough = pattern_octaves(point, 0.022f, 4, 0.55f, 1.0f, 50);
    float height = lerpf(0.0016f, 0.006f, cover.dead);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(rough.slope, height));
}
