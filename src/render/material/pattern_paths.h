// Paths that cattle and sheep tread into slopes: terracettes along the contours of steep ones,
// tracks that climb slowly over all. Lines finer than the pixel keep their share of it.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_PATHS_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_PATHS_H

#include "base/vec.h"
#include "render/surface.h"

#include <stdint.h>

typedef struct Paths {
    float share; // 0..1: of the pixel that is trodden
    float edge;  // 0..1: of the pixel on the shaded edge that overhangs a tread
    Vec3 slope;  // of the relief, dimensionless
} Paths;

// The share of a pixel `footprint` wide, at `away` from the middle of a line `width` wide, that
// the line covers: its mean over all `away` does not hang on the footprint. All in one unit.
float path_share(float away, float width, float footprint);

// Terracettes: treads about `rise` m of height from one to the next, which begin, end, meet and
// part, where herds go on slopes steeper than some 17 degrees.
Paths pattern_terracettes(const SurfacePoint *point, float rise, uint32_t seed);

// Tracks, `width` m wide, tens of metres apart.
Paths pattern_tracks(const SurfacePoint *point, float width, uint32_t seed);

#endif
