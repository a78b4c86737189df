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
    int64_t stem_count; // nodes at the start that stay where they are
    float root_radius;  // m, when the tree is grown up
    int32_t colony;
    int32_t last_birth;
} VesselTree;

// What both trees share.
typedef struct VesselBed {
    const VesselsParams *params;
    const Envelope *envelope;
    VesselTree trees[2];
    int tree_count;
    bool limbs; // the envelope must not be scaled: what is inside would come to lie outside
    const Recipe *recipe;
    MurrayReport turned; // of the last turns, of both trees together
} VesselBed;

// Grows both trees to about the wanted terminals, coarse to fine and in turn, so that each level of
// one finds its way around what the other has so far.
bool vessel_bed_grow(VesselBed *bed, Error *e);

// Leaves out what touches, then the terminals that are too many; gives the final radii and angles.
// (vessels_finish.c)
bool vessel_bed_finish(VesselBed *bed, Error *e);

// Terminals that each tree shall have.
static inline int64_t vessel_wanted_terminals(const VesselBed *bed)
{
    int64_t wanted = bed->params->terminals / bed->tree_count;
    return wanted > 1 ? wanted : 1;
}

// How many children each node has; the caller frees it. *terminals (may be NULL): nodes without.
int32_t *vessel_child_counts(const OutTree *tree, int64_t *terminals, Error *e);

#endif
