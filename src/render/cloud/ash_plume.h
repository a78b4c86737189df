// A volcano's plume: a jet of ash that takes in air and widens in proportion to its way (Morton,
// Taylor and Turner 1956), which the wind bends to a curve of height^3 ~ distance^2 (Briggs 1969),
// as puffs that rise one after another, each with billows on its flanks.
#ifndef RAMIFY_RENDER_CLOUD_ASH_PLUME_H
#define RAMIFY_RENDER_CLOUD_ASH_PLUME_H

#include "render/cloud/puffs.h"

// Of the whole plume, m.
Aabb ash_plume_box(const Cloud *cloud);

// m: width of its large billows, by which detail is made.
float ash_plume_billow(const Cloud *cloud);

// The middle of the plume and its radius, m; t: 0 = at the vent, 1 = where it has risen by the
// cloud's thickness, up to ASH_PLUME_END far downwind.
#define ASH_PLUME_END 1.6f
Vec3 ash_plume_axis(const Cloud *cloud, float t, float *radius);

// Share of the ash's density that dilution leaves at a place, 0..1.
float ash_plume_share(const Cloud *cloud, Vec3 p);

// Adds its balls. Errors: ERROR_MEMORY.
bool ash_plume_grow(Puffs *puffs, const Cloud *cloud, uint64_t key, Error *e);

#endif
