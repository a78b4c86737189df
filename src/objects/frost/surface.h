// The surface that frost grows on: a pane or a sphere. Private to the frost's files.
#ifndef RAMIFY_OBJECTS_FROST_SURFACE_H
#define RAMIFY_OBJECTS_FROST_SURFACE_H

#include "objects/frost/frost.h"
#include "shape/points.h"

float frost_area(const FrostParams *params);         // m^2
float frost_side_spacing(const FrostParams *params); // m, mean, of the sides' attractors

// Moves p to the nearest point of the surface; returns the unit normal there.
Vec3 frost_project(const FrostParams *params, Vec3 *p);

// About `count` attractors, one at random in each cell of a regular pattern. Owned by the caller.
PointSet *frost_points(const FrostParams *params, int64_t count, uint64_t seed, const Run *run,
                       Error *e);

// Position of nucleus number i, and the normal there.
Vec3 frost_nucleus(const FrostParams *params, int i, uint64_t seed, Vec3 *normal);

// Number of nuclei, listed and placed.
int frost_nucleus_total(const FrostParams *params);

// Distance of p from the pane's border over half the shorter side; on a bubble, its height above
// the lowest point over the diameter. 0..1.
float frost_depth(const FrostParams *params, Vec3 p);

#endif
