// Places on stems, for patterns of bark: metres around and along, without seams.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_STEM_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_STEM_H

#include "render/material/pattern.h"

typedef struct StemPlace {
    Vec3 p;       // m: where noise is looked up, on a straight stem along z; of grown stems p.z is
                  // the way along the wood from the plant's foot
    Vec3 along_u; // the direction there that u goes; v goes along z
    Vec3 u, v;    // world: unit directions around and along the stem
    float radius; // m; that of a thick trunk if unknown
    float height; // m above the object's origin
    float twist;  // rad per metre along the stem, that p turns
    Vec3 drift;   // m: added to p in lookups, so that no two trees have the same marks
} StemPlace;

// twist: degrees per metre.
StemPlace stem_place(const SurfacePoint *point, float twist);

// Colour, and the relief: its height, about 0..1, and its slope around and along the stem, per
// metre.
typedef struct BarkLook {
    Vec3 color;
    float height;
    float slope_u, slope_v;
} BarkLook;

// The position stretched: units of `around` metres around the stem and `along` metres along it.
static inline Vec3 stem_lookup(const StemPlace *place, float around, float along)
{
    return vec3((place->p.x + place->drift.x) / around, (place->p.y + place->drift.y) / around,
                (place->p.z + place->drift.z) / along);
}

// Sets the drift of the place in the object's space. It changes so slowly that marks keep their
// form.
void stem_drift(StemPlace *place, Vec3 position);

// The unit direction out of the stem, at such places; stretched lookups keep it.
static inline Vec3 stem_out(const StemPlace *place)
{
    return vec3(place->along_u.y, -place->along_u.x, 0.0f);
}

// How much of a root the place is, 0..1: near the foot, and not upright.
float stem_root(const StemPlace *place);

// The colour with soil and dust on it, where the stem meets the ground and on roots.
Vec3 stem_earth(const StemPlace *place, Vec3 color);

// Adds to the relief `height`; to its slope that of `scale` times a function with this gradient at
// such a lookup.
void stem_add_relief(BarkLook *look, const StemPlace *place, float height, float scale,
                     float around, float along, Vec3 gradient);

// What the colour needs of a place on a plate of bark.
typedef struct BarkPlate {
    float rise;  // 0 in the fissure, 1 on top
    float edge;  // 0..1: how near the step to a higher layer is
    float layer; // 0..1: random, per layer and plate
    float own;   // 0..1: random, per plate
} BarkPlate;

// Adds plates of these sizes (m) whose relief is 1 high: from the floor of the fissure up in steps
// with ragged edges. Fissures along the stem are wide, those across it cracks. wind: a smooth
// random vector that bends them.
BarkPlate bark_add_plates(BarkLook *look, const StemPlace *place, float around, float along,
                          Vec3 wind, uint32_t seed);

// The integral of smoothstepf(0, width, x) from 0 to x.
static inline float stem_smooth_ramp(float width, float x)
{
    float t = clampf(x / width, 0.0f, 1.0f);
    return width * (t * t * t - 0.5f * t * t * t * t) + fmaxf(x - width, 0.0f);
}

// What a bark is at a place.
typedef struct BarkSurface {
    Vec3 color;
    float height;           // m, of the relief, about its mean
    float slope_u, slope_v; // of it
    float form; // m, of what is no bump but the stem's own form: scars, ribs, hollows, moss
} BarkSurface;

// Height of the kind's relief where it is neither in furrows nor on ridges.
static inline float bark_mean_height(BarkKind bark)
{
    return bark == BARK_FURROWED || bark == BARK_PLATES || bark == BARK_GNARLED ? 0.65f : 0.0f;
}

// Add what the material asks for: scars of shed limbs, ribs and hollows; moss and lichen.
void bark_scars(const Material *m, const SurfacePoint *point, const StemPlace *place,
                BarkSurface *bark);
void bark_moss(const Material *m, const SurfacePoint *point, const StemPlace *place,
               BarkSurface *bark);

// m: the size of all that on a stem of this radius, for choosing where it is displaced.
float bark_form_size(const Material *m, float radius);

// The kinds of bark (Material.bark) but the furrowed one. scale: of their lengths, 1 = natural.
BarkLook bark_plates(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_birch(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_smooth(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_fibrous(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_flakes(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_scales(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_canes(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_gnarled(const Material *m, const StemPlace *place, float scale, float footprint);
BarkLook bark_bands(const Material *m, const StemPlace *place, float scale, float footprint);

#endif
