// Rock faces: beds cut by two sets of joints into blocks of several sizes. Each block is a plane of
// its own that stands out or back; borders are steps, cracks and ledges.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_CRAGS_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_CRAGS_H

#include "render/surface.h"

typedef struct CragsRock {
    float size;  // m, in the object's space: mean distance of the joints between the largest blocks
    float thick; // thickness of beds, relative to the distance of joints
    int scales;  // at most CRAGS_MOST; blocks of each are about a third as large as of the last
    Vec3 up;     // unit: across the beds
    float level; // m: of the point within its beds, along up
} CragsRock;

typedef struct Crags {
    float height;  // m: to displace by, about its mean
    Vec3 slope;    // the gradient of the relief, dimensionless, as pattern_tilt takes it
    float tone;    // about -1..1, one value a block, at every size
    float crevice; // 0..1: in cracks, and in corners below and beside what stands out
    float ledge;   // 0..1: on top of what stands out, where soil and snow lie
} Crags;

enum { CRAGS_MOST = 6 };

// The relief of a face, as far as the pixel shows it. Its height is about a tenth of the size.
Crags pattern_crags(const SurfacePoint *point, const CragsRock *rock);

// A face of level beds: the land's own where it has some. size, thick: as above.
CragsRock crags_level(const SurfacePoint *point, float size, float thick);

// Height (m) by which a face is displaced: none where the mesh is more level than `level`, all of
// it where it is steeper than `steep`, both heights of its normal.
float crags_height(const SurfacePoint *point, const CragsRock *rock, float level, float steep);

// n tilted by a slope of the relief. Faces whose relief is geometry take the gradient of the relief
// in place of the normal of their mesh, which rounds the blocks' edges.
Vec3 crags_normal(const SurfacePoint *point, Vec3 n, Vec3 slope);

// The share 0..1 of films that water leaves where it runs down faces, in streaks about `size` m
// wide and longer.
float pattern_streaks(const SurfacePoint *point, float size);

#endif
