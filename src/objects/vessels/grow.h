// Growth of vessels, tree by tree and level by level.
#ifndef RAMIFY_OBJECTS_VESSELS_GROW_H
#define RAMIFY_OBJECTS_VESSELS_GROW_H

#include "objects/vessels/vessels.h"
#include "outtree/segment_grid.h"

// Streams of the object's seed; levels and stems use the streams from 0 on. THINNING + i: tree i.
enum { STREAM_FIELD = 5, STREAM_THINNING = 1000 };

// One of the trees while it grows.
typedef struct VesselTree {
    OutTree *tree;
    int64_t stem_count; // first nodes, which do not move
    float root_radius;  // m, of the full-grown tree
    int32_t colony;
    int32_t last_birth;
} VesselTree;

// Data shared by both trees.
typedef struct VesselBed {
    const VesselsParams *params;
    const Envelope *envelope;
    VesselTree trees[2];
    int tree_count;
    bool limbs; // the envelope must not be scaled: points inside would end up outside
    const Recipe *recipe;
    MurrayReport turned; // last rotation of forks, both trees together
    int64_t lost_stems;  // nodes of stems removed because stems of both trees touch
} VesselBed;

// Grows both trees to about the wanted number of terminals, coarse to fine and in turn, so that
// each level of one grows around the other tree.
bool vessel_bed_grow(VesselBed *bed, Error *e);

// Removes vessels that touch, then surplus terminals; computes the final radii and angles.
// (finish.c)
bool vessel_bed_finish(VesselBed *bed, Error *e);

// Wanted terminals per tree.
static inline int64_t vessel_wanted_terminals(const VesselBed *bed)
{
    int64_t wanted = bed->params->terminals / bed->tree_count;
    return wanted > 1 ? wanted : 1;
}

// Number of children of each node; the caller frees it. *terminals (may be NULL): nodes without
// children.
int32_t *vessel_child_counts(const OutTree *tree, int64_t *terminals, Error *e);

#endif
