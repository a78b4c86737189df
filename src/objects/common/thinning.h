// Which share of each kind of leaf a copy keeps, where all would be too many: leaves, petals and
// buds of one plant differ in size by a hundred times.
#ifndef RAMIFY_OBJECTS_COMMON_THINNING_H
#define RAMIFY_OBJECTS_COMMON_THINNING_H

#include <stdint.h>

typedef struct ThinnedLeaves {
    int64_t count;
    double area;  // m2, of all together
    double faces; // of one
    double share; // out: 0..1, those that are kept
} ThinnedLeaves;

// Sets the shares so that at most most_leaves leaves of most_faces faces are kept of all kinds
// together. Where those that are kept are enlarged to the area of all, the area within any outline
// then has the least variance for this limit, which is where a kind's number goes with its area
// over the square root of the cost of one (Neyman 1934); a kind is never given more than it has.
void thinning_shares(ThinnedLeaves *kind, int kinds, double most_leaves, double most_faces);

#endif
