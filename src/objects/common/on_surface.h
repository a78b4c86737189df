// An envelope's surface as growth and jitter need it: nodes are moved onto it.
#ifndef RAMIFY_OBJECTS_COMMON_ON_SURFACE_H
#define RAMIFY_OBJECTS_COMMON_ON_SURFACE_H

#include "outtree/out_tree.h"
#include "shape/envelope.h"

typedef struct OnSurface {
    const Envelope *envelope; // borrowed
    float extent;             // m, largest side of the envelope's box
    float probe;  // m, half the step of the distance's finite differences; a node this near to the
                  // surface lies on it
    float stride; // m: distance over which surface_project is reliable
} OnSurface;

OnSurface on_surface(const Envelope *envelope);

// A SurfaceProject (outtree/jitter.h); surface: an OnSurface. Moves p down the gradient of the
// distance to the surface; where that is 0 (beyond a level set's band), along the previous normal;
// onto an existing surface, to the nearest point.
void surface_project(const void *surface, Vec3 *p, Vec3 *normal);

// Drops the nodes with a parent that are not on the surface or are farther than `jump` m from their
// parents, with all that grew from them: paths through the air or the body.
bool surface_drop_strays(const OnSurface *surface, OutTree *tree, float jump, Error *e);

// Moves the nodes onto the surface, of which steps are chords, and drops those that are not on it
// and those that a bridge leads to: a step whose middle is farther from the surface than a fifth of
// its length, with all that grew from them.
bool surface_settle(const OnSurface *surface, OutTree *tree, Error *e);

#endif
