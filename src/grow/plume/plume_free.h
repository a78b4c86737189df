// The free places of a growth of plumes: attractors, each with its nearest node. Private to plumes.
#ifndef RAMIFY_GROW_PLUME_FREE_H
#define RAMIFY_GROW_PLUME_FREE_H

#include "grow/attractor_grid.h"
#include "grow/room.h"

typedef struct FreePlaces {
    AttractorGrid grid;
    NodeBits changed; // what the grid asks for; not read
    int64_t seen;     // nodes that the grid knows
    const Room *room; // NULL = none
} FreePlaces;

// Release with free_places_clear, also on failure.
bool free_places_init(FreePlaces *places, const PointSet *attractors, float influence, float kill,
                      const Room *room, const Run *run, Error *e);
void free_places_clear(FreePlaces *places);

// Tells the attractors and rivals the nodes since the last call.
bool free_places_update(FreePlaces *places, const OutTree *tree, const Run *run, Error *e);

// Adds up the unit vectors from the node to its own attractors, those nearer to it than to any
// other node, that lie within the angle of this cosine about the unit heading. Returns their
// number.
int64_t free_places_pull(const FreePlaces *places, const OutTree *tree, int32_t node, Vec3 heading,
                         float least_cos, Vec3 *pull);

#endif
