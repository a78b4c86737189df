// Foam on water: rafts of bubbles that break up into a lace of strands about holes of many sizes,
// dense where a wave has just broken, a thin veil where foam is old.
#ifndef RAMIFY_RENDER_MATERIAL_FOAM_H
#define RAMIFY_RENDER_MATERIAL_FOAM_H

#include "base/vec.h"

#include <stdint.h>

// Places that foam is looked up at, m. What is large has drifted for long and lies in coordinates
// that the flow draws out; what is small is stirred anew within seconds and lies as it is.
typedef struct FoamPlace {
    Vec2 drift; // of patches and large holes
    Vec2 still; // of the lace
} FoamPlace;

// What foam is about a place.
typedef struct FoamCover {
    float cover; // 0..1: share of the water that it hides
    float fresh; // 0..1: how much of it is thick froth of water that breaks now; the rest is lace
} FoamCover;

// Share of a pixel of this width, m, that foam hides at a place of the water. Its mean over places
// is the cover, for any width; it grows with the cover; a wider pixel shows less of the lace. Holes
// are longer along x.
float foam_share(FoamCover foam, FoamPlace at, float width);

// Slopes along x and y of `still` of the top of foam: it lies on the water as thick as it is dense,
// froth in lumps from a metre down, lace nearly flat. share: foam_share there; drawn: the length
// that a metre along x has in `drift`. None that a pixel of this width does not show.
Vec2 foam_slope(FoamCover foam, float share, FoamPlace at, float drawn, float width);

// Where the water at a place, m, was before eddies of this spacing, m, turned it: parts of circles
// that do not overlap, each turned by up to `turns` radians about its middle, none at its rim.
// Lookups moved so curl into spirals. Areas are kept, so that means are.
Vec2 foam_stirred(Vec2 at, float spacing, float turns, uint32_t seed);

#endif
