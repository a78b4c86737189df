// Heaped clouds as trees of balls: rising columns of air bear balls on their flanks, and these
// smaller ones, as on a cauliflower (after Bouthors and Neyret, "Modeling Clouds Shape",
// Eurographics 2004).
#ifndef RAMIFY_RENDER_CLOUD_PUFFS_H
#define RAMIFY_RENDER_CLOUD_PUFFS_H

#include "base/error.h"
#include "base/vec.h"
#include "render/cloud/cloud.h"

#include <stdint.h>

typedef struct Puff {
    Vec3 center; // m
    float radius;
    float flatness; // 1 = a ball; more: its height is that much less than its width
} Puff;

typedef struct Puffs {
    Puff *puff; // owned
    int64_t count, capacity;
} Puffs;

// Adds the heaps of a square of `period` m from the origin, in which they cover the cloud's share;
// altitudes are absolute. No ball is smaller than `smallest`.
bool puffs_grow_cumulus(Puffs *puffs, const Cloud *cloud, float period, float smallest,
                        uint64_t key, Error *e);

// Adds one storm about (center_x, center_z): towers up to the anvil, which the wind draws out.
bool puffs_grow_storm(Puffs *puffs, const Cloud *cloud, float smallest, uint64_t key, Error *e);

void puffs_clear(Puffs *puffs);

#endif
