// A cascade: water that runs, slides and falls over the surface of another object into a pool, as
// an exposure of half a second or more shows it. Clots and drops are then drawn out along their
// ways, so that what is seen is the mean of many: strands and veils.
#ifndef RAMIFY_OBJECTS_CASCADE_CASCADE_H
#define RAMIFY_OBJECTS_CASCADE_CASCADE_H

#include "mesh/spray.h"
#include "objects/common/recipe.h"

typedef struct CascadeParams {
    char *over;      // the object with the rock
    Vec3 from, to;   // m: ends of the line across the stream from which its water comes, seen
                     // upstream from left to right
    float discharge; // m^3/s
    float speed;     // m/s, at the line
    float level;     // m: y of the pool in which it ends
    int strands;     // ways of water that are followed
    float width;     // m, of a strand
    float gather;    // 0..1: how unevenly water leaves the line
    float wander;    // 0..1: how far turbulence moves strands aside
    float drift;     // s in which foam on the pool fades to 1/e
} CascadeParams;

CascadeParams cascade_params_default(void);
extern const struct Table cascade_table;

enum { CASCADE_STEPS = 2400 }; // of a strand's way at most

// A moment of a strand's way.
typedef struct CascadePlace {
    Vec3 at, velocity; // m, m/s
    float seconds;     // until the next one
    float white;       // 0..1: how full of air it is
    bool on_rock, afloat;
} CascadePlace;

// The way of a strand, of the number of places, at most `most`, that it returns. surface: what it
// runs over.
int cascade_way(const CascadeParams *params, const struct ShapeSurface *surface, uint64_t seed,
                int strand, CascadePlace *place, int most);

// The share of the water that a strand carries; all of them about 1 in the mean.
float cascade_share(const CascadeParams *params, uint64_t seed, int strand);

// The unit level direction in which the water leaves the line.
Vec3 cascade_heading(const CascadeParams *params);

// The film of clear water where strands run side by side on the rock: a sheet, possibly without
// faces. The caller frees it with mesh_free.
Mesh *cascade_film(const CascadeParams *params, const Recipe *recipe, Error *e);

// What strands show of white water, and what they throw up.
typedef struct CascadeWater {
    SprayParcels *white, *mist; // NULL = not asked for
} CascadeWater;

// Adds those of a strand with this way. ERROR_MEMORY.
bool cascade_whiten(const CascadeParams *params, uint64_t seed, int strand,
                    const CascadePlace *place, int count, const CascadeWater *water, Error *e);

bool cascade_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

#endif
