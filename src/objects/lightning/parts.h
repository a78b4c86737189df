// What the files of the lightning share.
#ifndef RAMIFY_OBJECTS_LIGHTNING_PARTS_H
#define RAMIFY_OBJECTS_LIGHTNING_PARTS_H

#include "objects/lightning/lightning.h"
#include "outtree/jitter.h"

// Where one bolt runs, every length filled in.
typedef struct Bolt {
    const LightningParams *params;
    Vec3 start, strike; // m
    Vec3 axis;          // unit, from start toward strike
    Vec3 side, depth;   // unit, across it
    float height;       // m, of the bolt: |strike - start|
    int colony;
    uint64_t seed;
} Bolt;

enum { LIGHTNING_MOST_LEVELS = 3 };

// The levels by which side branches (on a surface: everything) grow when the scene names none;
// returns how many.
int lightning_own_levels(const LightningParams *params, GrowLevel levels[LIGHTNING_MOST_LEVELS]);

// Grows one bolt in the air. At `struck` the number of its main channels that reached their end, 0
// or ground_points, and their ends' ids at strike_id (ground_points entries).
OutTree *lightning_grow_bolt(const Bolt *bolt, uint64_t *strike_id, const Recipe *recipe, Error *e);

// Adds the short leaders that rise about the strike as roots of their own.
bool lightning_add_streamers(OutTree *tree, const Bolt *bolt, int32_t last_birth, Error *e);

// Grows everything over the surface of the element's envelope.
OutTree *lightning_grow_surface(const LightningParams *params, const Recipe *recipe, Error *e);

// How ways wander, besides the parameters.
typedef struct Wander {
    SurfaceProject *project; // NULL in space
    const void *surface;
    float stride; // m, see JitterParams
    uint64_t seed;
    const Run *run;
} Wander;

// Takes the tree and gives it its ways and radii: resampled to steps, jittered, resampled to
// segments, jittered within the steps. Radii: core for the way from a root to each node of id
// strike_id[0 .. strike_count - 1] that there is, dimmer and dimmer for what leaves it, fading
// toward tips.
OutTree *lightning_wander(OutTree *tree, const LightningParams *params, float size, float core,
                          const uint64_t *strike_id, int strike_count, const Wander *wander,
                          Error *e);

#endif
