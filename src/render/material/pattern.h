// Procedural surfaces: colour and bumps from noise, evaluated at a surface point. Details finer
// than the point's footprint fade into their mean.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_H

#include "render/material/material.h"
#include "render/surface.h"

typedef struct PatternShade {
    Vec3 color, transmittance;
    Vec3 normal;     // unit; on the side of the point's normal
    float foam;      // of water and ice: share of the pixel that is white, without gloss
    float roughness; // of the gloss; the material's own unless the pattern changes it
} PatternShade;

// Applies the material's pattern and its variation between instances to shade, which holds the
// material's colours and the point's normal.
void pattern_apply(const Material *material, const SurfacePoint *point, PatternShade *shade);

// Does the pattern change the roughness of the material's gloss?
bool pattern_varies_roughness(const Material *material);

// Height of the pattern's relief, m along the normal, about its mean; 0 if the pattern cannot be
// displaced. Its size, m, from about the lowest to the highest.
float pattern_height(const Material *material, const SurfacePoint *point);
float pattern_height_size(const Material *material);

// Of rock faces, m: the mean distance of joints between the largest blocks.
float pattern_mountain_blocks(const Material *material);
float pattern_alps_blocks(const Material *material);
#define COAST_BLOCKS 9.0f
#define KARST_BLOCKS 26.0f

// The kinds, one file each.
void pattern_bark(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_bark_height(const Material *material, const SurfacePoint *point); // m
void pattern_masonry(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_masonry_height(const Material *material, const SurfacePoint *point); // m
void pattern_rubble(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_rubble_height(const Material *material, const SurfacePoint *point); // m
void pattern_wood(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_stone(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_stone_height(const Material *material, const SurfacePoint *point); // m
void pattern_ground(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_mountain(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_mountain_height(const Material *material, const SurfacePoint *point); // m
void pattern_badlands(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_badlands_height(const Material *material, const SurfacePoint *point); // m
void pattern_alps(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_alps_height(const Material *material, const SurfacePoint *point); // m
void pattern_altitude(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_volcano(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_strata(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_strata_height(const Material *material, const SurfacePoint *point); // m
void pattern_water(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_leaf(const Material *material, const SurfacePoint *point, PatternShade *shade);
// Yellow and brown where the leaf is withered (SurfacePoint.withered).
void pattern_wither(const Material *m, const SurfacePoint *point, PatternShade *shade);

// The leaf's colours at its season: turned from the edge inward, or young.
void pattern_season(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_corallite(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_brain(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_reef(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_youth(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_hills(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_coast(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_coast_height(const Material *material, const SurfacePoint *point); // m
void pattern_dunes(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_mud(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_braided(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_floodplain(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_river(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_karst(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_delta(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_heath(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_ice(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_snow(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_snow_height(const Material *material, const SurfacePoint *point); // m
void pattern_silt(const Material *material, const SurfacePoint *point, PatternShade *shade);
float pattern_karst_height(const Material *material, const SurfacePoint *point); // m
void pattern_glacial(const Material *material, const SurfacePoint *point, PatternShade *shade);
void pattern_sand(const Material *material, const SurfacePoint *point, PatternShade *shade);

// The gradient of a relief (its height, m, at p in the object's space) for bumps, by differences
// over a quarter of the pixel, at least `step` m.
Vec3 pattern_slope(const Material *material, const SurfacePoint *point,
                   float (*height)(const Material *, const SurfacePoint *, Vec3 p), float step);

// The gradient of what the geometry does not show of that relief.
Vec3 pattern_bump(const Material *material, const SurfacePoint *point,
                  float (*height)(const Material *, const SurfacePoint *, Vec3 p), float step);

// The point as the geometry's relief was made: for the part of the slopes that it shows.
SurfacePoint pattern_coarse_point(const SurfacePoint *point);

// Noise summed over the octaves that the pixel resolves, and its gradient per metre.
typedef struct PatternOctaves {
    float value;
    Vec3 slope;
} PatternOctaves;

// Octaves from `wavelength` (m, in the object's space) down, each half as long and `gain` times as
// high as the last. squash: the ratio of length to height of the features.
PatternOctaves pattern_octaves(const SurfacePoint *point, float wavelength, int octaves, float gain,
                               float squash, uint32_t seed);

// Per channel, how much lighter `to` is than `from`: the factor on a leaf's transmittance.
Vec3 pattern_color_ratio(Vec3 from, Vec3 to);

// n tilted by the surface gradient of a height field (slope: world, dimensionless). Slopes are
// bounded softly, so that bumps never turn a surface over.
Vec3 pattern_tilt(Vec3 n, Vec3 slope);

// The share 0..1 of a feature of this wavelength that a pixel of this footprint still shows.
float pattern_detail(float wavelength, float footprint);

// A random number per layer of this thickness, 0..1, by the level in the beds; 0.5 where the pixel
// does not show layers. Borders are soft from the share `soft` of a layer up.
float pattern_lamina(float level, float thickness, float footprint, float soft, uint32_t seed);

#endif
