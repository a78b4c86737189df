// Ponds: basins dug into the ground's relief, with a bed of mud and a level surface of water.
#ifndef RAMIFY_OBJECTS_GROUND_POND_H
#define RAMIFY_OBJECTS_GROUND_POND_H

#include "base/mesh.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Pond {
    float position[2];  // x and z of the middle, m
    float radius;       // m, mean
    float depth;        // m, of the water in the middle
    float bank;         // m: from the water up to the lowest land around it
    float irregularity; // 0 = a circle .. 1 = bays and spits
} Pond;

extern const struct Table pond_table;

Pond pond_default(void);

// A pond in its land.
typedef struct PondSite {
    const Pond *pond;
    float level; // m, of the water
    uint64_t seed;
} PondSite;

// How far from its middle a pond may change the land, m.
float pond_reach(const Pond *pond);

// Distance (m) from the middle to the shore in a direction, a unit vector.
float pond_shore(const Pond *pond, uint64_t seed, float x, float z);

// Distance from the middle to (x, z) as a share of the distance to the shore there: below 1 in the
// water.
float pond_share(const Pond *pond, uint64_t seed, float x, float z);

// Height (m) at (x, z) of the bed and the banks, where the land without a pond has this one.
float pond_height(const PondSite *site, float x, float z, float land);

// The land around is drawn by coarse cells. Within `inner` of the pond's reach they are hidden
// below a finer mesh, which goes on to `outer`, m.
typedef struct PondMargin {
    float inner, outer;
} PondMargin;

// Height (m) of the land's surface that is drawn.
typedef struct PondLand {
    Vec3 (*point)(const void *user, float x, float z);
    const void *user;
} PondLand;

int64_t pond_faces(const Pond *pond); // triangles of its meshes together, at most

Mesh *pond_water_mesh(const PondSite *site, Error *e); // level, reaches a little under the banks
Mesh *pond_bed_mesh(const PondSite *site, const PondLand *land, Error *e); // out to the wet rim
Mesh *pond_bank_mesh(const PondSite *site, const PondLand *land, const PondMargin *margin,
                     Error *e); // from there on

#endif
