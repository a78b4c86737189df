// Rock that breaks along joints: two sets of upright cracks, and planes along the beds, part it
// into blocks. Where land is steep, a block shows the profile through its middle, so that its face
// follows one set of joints, its sides the other; it stands out of the wall or back, bed by bed,
// and gullies follow open joints into the wall. The land is only read from another place a little
// aside: rock that is gone is gone, none is added elsewhere (mass is not kept).
//
// Blocks are found by their place in plan, in metres, at several scales, so more samples show the
// same blocks, and the result at a sample depends on samples within jointing_reach alone. A block
// smaller than some samples is not made.
#ifndef RAMIFY_LAND_JOINTING_H
#define RAMIFY_LAND_JOINTING_H

#include "base/run.h"
#include "base/strata.h"
#include "land/height_field.h"

typedef struct JointingParams {
    float spacing; // m: mean distance between the joints of a set, of the largest blocks
    float azimuth; // degrees from north (-z), clockwise: the strike of the first set
    float angle;   // degrees from it to the strike of the second set
    int scales;    // of blocks, each JOINTING_RATIO as large as the one before; 1 to JOINTING_MOST
    float bends;   // shares of the spacing by which joints wander from straight lines
    float facets;  // 0..1: how far faces turn into joints
    float relief;  // shares of the spacing by which blocks stand out or back, at most
    float gullies; // shares of the spacing by which open joints reach back into walls, at most
    float bedding; // shares of the spacing: mean thickness of what breaks along the beds
    float throws;  // m: by how much the largest blocks have slipped along their joints, at most
    float slope;   // degrees: steeper land is bare rock that breaks
    uint64_t seed;
} JointingParams;

enum { JOINTING_MOST = 4 };
#define JOINTING_RATIO 0.38f

// m: a sample's new height depends on heights within so far.
float jointing_reach(const JointingParams *params);

// Breaks the rock of a field: changes heights, loose ground and the wetness that tells of it, and
// what is recorded of the change. Loose ground that lay on rock stays where it is not in the way.
// strata: the beds, NULL = level ones. Samples that are farther than its reach from steep land keep
// their bits. The same bits for any number of threads.
bool jointing_break(HeightField *field, const JointingParams *params, const Strata *strata,
                    const Run *run, Error *e);

#endif
