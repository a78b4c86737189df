// Shared by the parts of jointing.c.
#ifndef RAMIFY_LAND_JOINTING_PARTS_H
#define RAMIFY_LAND_JOINTING_PARTS_H

#include "land/jointing.h"

enum { JOINT_SETS = 2 };

#define JOINT_MASK 0.35f   // spacings around steep land that change, too
#define JOINT_LONGEST 2.8f // spacings: at most, from joint to joint of a set

// Blocks of one size.
typedef struct JointScale {
    const JointingParams *params;
    const HeightField *field; // for its grid
    const Strata *strata;
    const float *rock;       // m, of each sample: heights before this scale
    const float *mask;       // 0..1: how far they change
    const float *dx, *dz;    // mean gradient about each sample
    float spacing, thick;    // m
    float shown;             // 0..1: less of blocks of few samples
    float throws;            // m
    Vec2 normal[JOINT_SETS]; // unit: across the joints of a set
    Vec2 along[JOINT_SETS];  // unit: along them
    uint64_t key;
} JointScale;

// jointing_steep.c: fills, for each sample, 0..1 how far rock breaks there at a scale, and the mean
// slopes that it breaks on. other: of the same size, overwritten.
void jointing_find_steep(const JointScale *s, float *mask, float *dx, float *dz, float *other,
                         int threads);

// jointing_block.c: m, the height that a sample at a place in plan takes. mask: 0..1, how far it
// changes.
float jointing_height(const JointScale *s, float x, float z, float mask);

#endif
