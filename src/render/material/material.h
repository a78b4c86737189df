// Material descriptions: plain data, one struct for all kinds; a kind ignores the fields it does
// not use.
#ifndef RAMIFY_RENDER_MATERIAL_MATERIAL_H
#define RAMIFY_RENDER_MATERIAL_MATERIAL_H

#include "base/vec.h"

#include <stdint.h>

// The registry of kinds: KIND(name) is `name` in scene files and in enum MaterialKind, and
// material/<name>.c defines its MaterialOps, <name>_ops.
#define MATERIAL_KINDS(KIND)     \
    KIND(DIFFUSE, diffuse)       \
    KIND(CONDUCTOR, conductor)   \
    KIND(DIELECTRIC, dielectric) \
    KIND(WATER, water)           \
    KIND(PRINCIPLED, principled) \
    KIND(LEAF, leaf)             \
    KIND(EMISSION, emission)     \
    KIND(THIN_FILM, thin_film)   \
    KIND(PLASMA, plasma)

typedef enum MaterialKind {
#define KIND(NAME, name) MATERIAL_##NAME,
    MATERIAL_KINDS(KIND)
#undef KIND
} MaterialKind;

// What the ray tracer and the exporters ask of a kind.
enum {
    TRAIT_EMISSIVE = 1, // sends out `radiance`, reflects nothing
    TRAIT_OPAQUE = 2,   // light arrives from the viewer's side alone
    TRAIT_BODY = 4,     // encloses a medium: what is transmitted travels through it
    TRAIT_THIN = 8,     // a film: what is transmitted goes straight on, shadow rays too
    TRAIT_OPEN = 32,    // a body that light enters and leaves straight on where it is gathered: see
                        // path_surface.c
    TRAIT_MIRROR = 64,  // may be smooth, and is a mirror there
    TRAIT_GAS = 128,    // sends out `radiance` and hides nothing: rays go straight on through it
    TRAIT_PATTERNED = 16 // pattern, variation and texture change its colour; else at most bumps
};

typedef enum PatternKind {
    PATTERN_NONE,
    PATTERN_BARK,   // furrowed bark: ridges and furrows in (around, along) metres, seamless in 3D,
                    // scaled by radius
    PATTERN_GROUND, // soil and grass tones, patchy
    PATTERN_LEAF,   // veins, lighter midrib, blotches in leaf uv (0..1)
    PATTERN_NOISE,  // plain fractal noise between color and color2
    PATTERN_CORALLITE, // coral: cups with raised rims, paler (color2) where it grows
    PATTERN_BRAIN,     // brain coral: winding ridges, color2 in the valleys
    PATTERN_REEF,      // a living boulder of coral: fine cups, bites, dead patches with turf and
                       // coralline algae
    PATTERN_YOUTH,     // color2 where a branch grows, color where it is old
    PATTERN_SAND,      // ripples on a sea floor
    PATTERN_MOUNTAIN,  // rock, scree, grass and snow by altitude, slope and wetness of the land
    PATTERN_BADLANDS,  // rock in coloured beds, rills, sandy flats
    PATTERN_WATER,     // ripples
    PATTERN_MASONRY,   // a wall of stones in courses
    PATTERN_DRESSED,   // the same weathered stone, without joints
    PATTERN_STONE,     // weathered rock: broken faces, joints, minerals, stains
    PATTERN_ALTITUDE,  // the colours of a map, by the altitude of the land
    PATTERN_ALPS,      // rock, scree, meadows and snow where wind, hollows and ledges hold it
    PATTERN_VOLCANO,   // tephra, lava by its age, red scoria, plants and snow
    PATTERN_STRATA,    // the beds of the land in their own colours, talus, soil and shrubs
    PATTERN_DUNES,     // sand with ripples across the wind, slip faces, gravel between dunes
    PATTERN_HILLS,     // dry grass, fresh grass in hollows, terracettes, bare scars
    PATTERN_COAST,     // cliffs of the land's beds, tidal bands, wet sand, turf
    PATTERN_BRAIDED,   // gravel by its age, silt and wet edges of a braided river, terraces, slopes
    PATTERN_GLACIAL,   // its water: turbid by depth, ripples by speed
    PATTERN_KARST,     // limestone cliffs with streaks of water, bushes, fields on the plain
    PATTERN_MUD,       // the bed of a pond: ooze, darker with depth (color2), litter, a wet rim
    PATTERN_FLOODPLAIN, // point bars, scrolls, meadows, reeds and fields of a meandering river
    PATTERN_RIVER,      // its water: the bed in shoals, murky depth, ripples
    PATTERN_DELTA,      // mud flats, reeds, marsh, willows on levees, fields of a river's delta
    PATTERN_SILT,       // its water: mud and clear sea (color), the bed in shoals
    PATTERN_HEATH,      // dry turf of open slopes, bushes, stones, worn tracks of soil (color2)
    PATTERN_ICE,        // dark new ice: patches dulled by haze, grains of rime (color2)
    PATTERN_SNOW,       // hummocks, ripples of the wind, pits and crumbs of fallen clods
    PATTERN_RUBBLE,     // a wall of rough stones of all sizes in lime mortar
    PATTERN_WOOD        // weathered wood: fibres, knots, checks, rings on its ends
} PatternKind;

// Is relief displaced near the camera?
typedef enum Displacement {
    DISPLACEMENT_AUTO, // of barks, stone, walls and dressed stone, of displacement_texture
    DISPLACEMENT_OFF,  // bumps everywhere
    DISPLACEMENT_ON    // of all patterns that can be
} Displacement;

typedef enum BarkKind {
    BARK_FURROWED, // long ridges and deep furrows: oak, lime, ash
    BARK_PLATES,   // thick scaly plates; thin orange flakes (color2) on thinner stems: pine
    BARK_BIRCH,    // white, dark lenticels across, peeling, black (color2) diamonds and foot
    BARK_SMOOTH,   // a grey skin with faint wrinkles and scars (color2): beech
    BARK_FIBROUS,  // long stringy strips: cypress, juniper
    BARK_FLAKES,   // patches of several ages, from color to color2: plane, eucalyptus
    BARK_BANDS,    // glossy, corky bands (color2) across: cherry
    BARK_SCALES,   // thin scales in layers, redder (color2) where one came off: spruce
    BARK_CANES,    // a smooth cane with raised rings at its nodes, bloom (color2) below: bamboo
    BARK_GNARLED   // plates of several sizes, broken, weathered to grey: old olive, apple
} BarkKind;

// How pictures are laid on a surface.
typedef enum TextureMapping {
    MAPPING_AUTO, // by UVs where the surface has them, else along the axes
    MAPPING_UV,
    MAPPING_TRIPLANAR // along the three axes of the object's own space
} TextureMapping;

// A point of a map's scale of colours.
typedef struct ColorStop {
    float at;   // altitude, 0..1 of the land's relief
    Vec3 color; // reflectance
} ColorStop;

// Another material where maps of the surface allow it.
typedef struct MaterialLayer {
    char *material;         // its name: of MATERIAL_DIFFUSE or MATERIAL_PRINCIPLED, without layers
    struct MapRange *where; // conditions that all hold (land/where.h); borrowed
    int where_count;
    float strength; // 0..1: share that the layer covers where they hold
    float fray;     // m by which noise displaces its borders
} MaterialLayer;

typedef struct Material {
    char name[64];
    MaterialKind kind;
    Vec3 color;           // reflectance (leaf: of the upper side; dielectric: tint of what passes)
    Vec3 color2;          // the pattern's second colour (bark: of the furrows; MATERIAL_PLASMA:
                          // factor on the radiance at the ends of branches)
    Vec3 transmittance;   // MATERIAL_LEAF: diffuse transmittance
    Vec3 autumn_color;    // MATERIAL_LEAF: reflectance of a leaf that has turned
    Vec3 young_color;     // MATERIAL_LEAF: of a leaf out of its bud; black = paler than color
    Vec3 underside_color; // MATERIAL_LEAF: of the lower side; black = paler than color
    Vec3 faded_color;     // MATERIAL_LEAF: of tissue without green; black = of its own green
    Vec3 absorption;      // MATERIAL_DIELECTRIC: per metre, Beer-Lambert
    Vec3 scattering;      // MATERIAL_DIELECTRIC: per metre: clouded, milky, flesh
    float anisotropy;     // of that scattering: mean cosine, -1..1
    float roughness;      // GGX alpha = roughness^2; of MATERIAL_DIFFUSE that of its facets; of
                          // MATERIAL_PLASMA the softness of its edge; 0..1
    float metallic;       // MATERIAL_PRINCIPLED
    float specular;       // strength of the coat of principled and leaf, 0..1; 0.5 = ior 1.5
    float ior;            // MATERIAL_DIELECTRIC: 1 = index-matched, no surface
    Vec3 radiance;        // MATERIAL_EMISSION, MATERIAL_PLASMA: W / (m^2 sr)
    float film_thickness; // MATERIAL_THIN_FILM: nm where the film stands upright
    float film_drainage;  // 0..1: how much thinner it is where it faces up, thicker where down
    float film_swirl;     // 0..1: how far the thickness varies in streaks, pattern_scale wide
    PatternKind pattern;
    BarkKind bark;       // PATTERN_BARK
    float pattern_scale; // m: wavelength of the pattern's largest feature; 0 = the kind's own
    float pattern_depth; // m: bump height; 0 = none
    // MATERIAL_WATER without the waves of a sea (wind_ripples.h):
    float wind;         // m/s; 0 = none, and no ripples of it
    float wind_azimuth; // degrees: where it comes from, clockwise from -z
    float calm;         // 0..1: share of the surface that gusts leave still
    float gusts;        // m: size of the patches
    Displacement displacement;
    // PATTERN_BARK, 0..1 each:
    float moss, lichen; // how much of it grows there
    float scars;        // how many shed limbs have left theirs
    float ribs;         // depth of the stem's ribs: 1 = half of its radius
    float hollows;      // how many holes rot has left
    float twist;        // degrees per metre, of the grain about the stem
    float bark_height;  // m along the wood up to which old bark reaches; 0 = by thickness alone
    float veins;        // PATTERN_LEAF: side veins on each half; 0 = veins along the blade
    float rays;         // PATTERN_LEAF: veins from the point (0.5, 0.5), instead; 0 = none
    float pale_veins;   // PATTERN_LEAF, 0..1: how much paler than the blade they are from above
    Vec3 mortar;        // PATTERN_RUBBLE: reflectance of its mortar
    float cracks;       // PATTERN_BADLANDS, 0..1: how far its clay has dried to crumbs and plates
    float snow_line, grass_line;   // PATTERN_MOUNTAIN: altitudes, 0..1 of the land's relief, above
                                   // and below which they lie; 0 = none
    ColorStop *colors;             // PATTERN_ALTITUDE: borrowed, `at` ascends; NULL = from color to
    int color_count;               // color2
    float variation;               // 0..1: how far hue and value differ from instance to instance
    const char *texture;           // file that multiplies color, by uv; NULL = none; borrowed
    const char *alpha_texture;     // NULL = opaque; borrowed
    const char *normal_texture;    // tangent-space normals, green along v; NULL = none; borrowed
    const char *roughness_texture; // red multiplies roughness; NULL = none; borrowed
    const char *transmittance_texture; // multiplies transmittance; NULL = none; borrowed
    const char *displacement_texture;  // red is the height; NULL = none; borrowed
    MaterialLayer *layers; // of MATERIAL_DIFFUSE and MATERIAL_PRINCIPLED: on it, from the lowest to
    int layer_count;       // the topmost; borrowed
    TextureMapping texture_mapping;
    float texture_scale;      // m, or units of uv, that the pictures cover; 0 = 1
    float displacement_depth; // m, of white over black of displacement_texture
} Material;

Material material_default(MaterialKind kind);

// All of these traits?
bool material_has(const Material *material, unsigned traits);

// An index-matched interface: light enters and leaves the body without reflection or refraction.
static inline bool material_is_index_matched(const Material *m)
{
    return m->ior <= 1.0f && material_has(m, TRAIT_BODY);
}

// Do rays go straight on through such an interface, out of the body or both ways?
static inline bool material_lets_through(const Material *m)
{
    return material_is_index_matched(m) || material_has(m, TRAIT_OPEN) ||
           material_has(m, TRAIT_GAS);
}

// Does the colour change over the surface; from instance to instance?
static inline bool material_has_pattern(const Material *m)
{
    return m->pattern != PATTERN_NONE && material_has(m, TRAIT_PATTERNED);
}

static inline bool material_varies(const Material *m)
{
    return (m->variation > 0.0f || m->kind == MATERIAL_LEAF) && material_has(m, TRAIT_PATTERNED);
}

// Share of a shadow ray's light that the surface holds back at this cosine: 1 unless TRAIT_THIN.
float material_shadow_opacity(const Material *material, float cosine);

#endif
