// A swarm: copies of any objects in a region of space, as a school of fish, a flock of birds,
// leaves and snowflakes in the air.
#ifndef RAMIFY_OBJECTS_SWARM_SWARM_H
#define RAMIFY_OBJECTS_SWARM_SWARM_H

#include "objects/common/things.h"
#include "shape/envelope.h"

typedef struct SwarmParams {
    Shape *shapes; // the region, at least one
    int shape_count;
    float voxel; // m, of the region's level set; 0 = by its extent
    int64_t count;
    float spacing;    // m: least distance between two places; 0 = any
    float clumping;   // 0 = even .. 1 = in clumps with gaps between them
    float clump_size; // m, from clump to clump
    float scale[2];   // least and largest size, relative to the thing's
    float azimuth;    // degrees from north (-z), clockwise: where they head
    float stray;      // degrees: most turn of each from the heading of those around it
    float swirl;      // degrees: most turn of headings from place to place
    float swirl_size; // m: over which headings turn
    float climb;      // degrees: most rise or dive of each
    float roll;       // degrees: most roll of each, to any side
    Things things;
} SwarmParams;

SwarmParams swarm_params_default(void);

// A copy's z axis points where it heads, its x axis to its left, its y axis up. Fewer than
// params->count if there is no room for all. Clear with thing_places_free, also on failure.
bool swarm_places_init(ThingPlaces *places, const SwarmParams *params, const Recipe *recipe,
                       Error *e);

extern const struct Table swarm_table; // of its parameters

#endif
