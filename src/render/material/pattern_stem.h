// Places on stems, for patterns of bark: metres around and along, without seams.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_STEM_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_STEM_H

#include "render/material/pattern.h"

typedef struct StemPlace {
    Vec3 p;       // m: where noise is looked up, on a straight stem along z
    Vec3 along_u; // the direction there that u goes; v goes along z
    Vec3 u, v;    // world: unit directions around and along the stem
    float radius; // m; that of a thick trunk if unknown
    float height; // m above the object's origin
} StemPlace;

StemPlace stem_place(const SurfacePoint *point);

// Colour, and the slope of the relief around and along the stem: of heights 0..1, per metre.
typedef struct BarkLook {
    Vec3 color;
    float slope_u, slope_v;
} BarkLook;

// The position stretched: units of `around` metres around the stem and `along` metres along it.
static inline Vec3 stem_lookup(const StemPlace *place, float around, float along)
{
    return vec3(place->p.x / around, place->p.y / around, place->p.z / along);
}

// Adds to the slope that of `height` times a function with this gradient at such a lookup.
void stem_add_slope(BarkLook *look, const StemPlace *place, float height, float around, float along,
                    Vec3 gradient);

// The kinds of bark (Material.bark) but the furrowed one. scale: of their lengths, 1 = natural.
BarkLook bark_plates(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_birch(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_smooth(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_fibrous(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_flakes(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_bands(const Material *m, const StemPlace *place, float scale, float footprint);

#endif
