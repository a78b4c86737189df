// A picture at falling resolutions (Williams 1983), for lookups that average over the footprint of
// a pixel. A lookup allocates nothing, takes no lock and cannot fail.
#ifndef RAMIFY_RENDER_MATERIAL_MIP_MAP_H
#define RAMIFY_RENDER_MATERIAL_MIP_MAP_H

#include "base/vec.h"
#include "image/image.h"

typedef struct MipMap MipMap;

// Halves the picture until one texel is left, in the texels' own type: a third more memory. The
// texels stay the caller's and must outlive the map. ERROR_MEMORY.
MipMap *mip_map_new(const Texels *texels, Error *e);
void mip_map_free(MipMap *map); // NULL is fine

// The first channels (at most 4, no more than the texels have) at uv, averaged over a patch of du
// by dv. The whole picture, which may be larger than its texels, repeats; v points up, and what has
// no texels is 0. Magnified texels are smoothed by a cubic B-spline. May be called from many
// threads.
void mip_map_lookup(const MipMap *map, Vec2 uv, float du, float dv, int channels, float value[]);

#endif
