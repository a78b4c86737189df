// Shared by the files of the lightning.
#ifndef RAMIFY_OBJECTS_LIGHTNING_PARTS_H
#define RAMIFY_OBJECTS_LIGHTNING_PARTS_H

#include "objects/lightning/lightning.h"
#include "outtree/jitter.h"

// Streams of the object's seed; bolts in the air use stream i for bolt i.
enum { STREAM_SURFACE_ROOTS = 3, STREAM_SURFACE_GROWTH = 4, STREAM_WANDER = 9 };

// Streams of a bolt's seed.
enum {
    STREAM_BOLT_LEADERS = 1,
    STREAM_BOLT_LEADER_GROWTH = 2,
    STREAM_BOLT_ROOT_ID = 3,
    STREAM_BOLT_BRANCHES = 4,
    STREAM_BOLT_GROUND_POINTS = 5,
    STREAM_BOLT_STREAMERS = 6,
    STREAM_BOLT_STRIKE = 77
};

// The frame of one bolt, all lengths filled in.
typedef struct Bolt {
    const LightningParams *params;
    Vec3 start, strike; // m
    Vec3 axis;          // unit, from start toward strike
    Vec3 side, depth;   // unit, across it
    float height;       // m: |strike - start|
    int colony;
    uint64_t seed;
} Bolt;

enum { LIGHTNING_MOST_LEVELS = 3 };

// The default growth levels of side branches (on a surface: of everything); returns how many.
int lightning_own_levels(const LightningParams *params, GrowLevel levels[LIGHTNING_MOST_LEVELS]);

// Until radii are computed, marks the end nodes of main channels; the radius of others is 0.
#define LIGHTNING_STRIKE 1.0f

// Grows one bolt in the air.
OutTree *lightning_grow_bolt(const Bolt *bolt, const Recipe *recipe, Error *e);

// Adds the short leaders that rise around the strike, each with its own root.
bool lightning_add_streamers(OutTree *tree, const Bolt *bolt, int32_t last_birth, Error *e);

// Grows all bolts on the surface of the element's envelope; whole->state is the envelope.
bool lightning_grow_surface(const LightningParams *params, const Recipe *recipe, Grown *whole,
                            Error *e);
bool lightning_finish_surface(const LightningParams *params, const Recipe *recipe,
                              const Envelope *envelope, Grown *grown, Error *e);

// How channels are jittered, besides the parameters.
typedef struct Wander {
    SurfaceProject *project; // NULL in space
    const void *surface;
    float stride; // m, see JitterParams
    uint64_t seed;
    const Run *run;
} Wander;

// Takes the tree and returns it with jittered channels and radii: resampled to steps, jittered,
// resampled to segments, jittered within the steps. Radii: core from a root to each strike;
// elsewhere, and on a surface everywhere, by the length of the channels beyond.
OutTree *lightning_wander(OutTree *tree, const LightningParams *params, float size, float core,
                          const Wander *wander, Error *e);

#endif
