// Material descriptions: plain data, one struct for all kinds; fields a kind does not use are
// ignored.
#ifndef RAMIFY_RENDER_MATERIAL_MATERIAL_H
#define RAMIFY_RENDER_MATERIAL_MATERIAL_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef enum MaterialKind {
    MATERIAL_DIFFUSE,    // energy-preserving rough diffuse (roughness as sigma-like 0..1)
    MATERIAL_CONDUCTOR,  // GGX, multiple-scattering compensated
    MATERIAL_DIELECTRIC, // rough glass or ice: GGX reflection and transmission, compensated
    MATERIAL_PRINCIPLED, // diffuse + specular coat + metallic
    MATERIAL_LEAF,       // thin sheet: diffuse reflection and transmission under a glossy coat
    MATERIAL_EMISSION,
    MATERIAL_THIN_FILM // soap film: clear, mirrors in interference colours
} MaterialKind;

typedef enum PatternKind {
    PATTERN_NONE,
    PATTERN_BARK,   // furrowed bark: ridges and furrows in (around, along) metres, seamless in 3D,
                    // scaled by radius
    PATTERN_GROUND, // soil and grass tones, patchy
    PATTERN_LEAF,   // veins, lighter midrib, blotches in leaf uv (0..1)
    PATTERN_NOISE,  // plain fractal noise between color and color2
    PATTERN_CORALLITE, // coral: cups with raised rims, paler (color2) where it grows
    PATTERN_YOUTH,     // color2 where a branch grows, color where it is old
    PATTERN_SAND,      // ripples on a sea floor
    PATTERN_MOUNTAIN,  // rock, scree, grass and snow by altitude, slope and wetness of the land
    PATTERN_BADLANDS,  // rock in coloured beds, rills, sandy flats
    PATTERN_WATER      // ripples
} PatternKind;

typedef struct Material {
    char name[64];
    MaterialKind kind;
    Vec3 color;           // reflectance (leaf: of the upper side; dielectric: tint of what passes)
    Vec3 color2;          // the pattern's second colour (bark: of the furrows)
    Vec3 transmittance;   // MATERIAL_LEAF: colour of light let through; dielectric: unused
    Vec3 absorption;      // MATERIAL_DIELECTRIC: per metre, Beer-Lambert
    Vec3 scattering;      // MATERIAL_DIELECTRIC: per metre: clouded, milky, flesh
    float anisotropy;     // of that scattering: mean cosine, -1..1
    float roughness;      // GGX alpha = roughness^2; 0..1
    float metallic;       // MATERIAL_PRINCIPLED
    float specular;       // strength of the coat of principled and leaf, 0..1; 0.5 = ior 1.5
    float ior;            // MATERIAL_DIELECTRIC: 1 = no surface, only what is inside
    Vec3 radiance;        // MATERIAL_EMISSION: W / (m^2 sr)
    float film_thickness; // MATERIAL_THIN_FILM: nm where the film stands upright
    float film_drainage;  // 0..1: how much thinner it is where it faces up, thicker where down
    float film_swirl;     // 0..1: how far the thickness varies in streaks, pattern_scale wide
    PatternKind pattern;
    float pattern_scale; // m: wavelength of the pattern's largest feature; 0 = the kind's own
    float pattern_depth; // m: bump height; 0 = none
    float snow_line, grass_line; // PATTERN_MOUNTAIN: altitudes, 0..1 of the land's relief, above
                                 // and below which they lie; 0 = none
    float variation;             // 0..1: how far hue and value differ from instance to instance
    const char *texture;         // file that multiplies color, by uv; NULL = none; borrowed
    const char *alpha_texture;   // NULL = opaque; borrowed
} Material;

Material material_default(MaterialKind kind);

#endif
