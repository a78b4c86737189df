// Joints of rock: upright cracks in sets of about parallel lines, with blocks between them. Private
// to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_JOINTS_H
#define RAMIFY_OBJECTS_TERRAIN_JOINTS_H

#include <stdint.h>

typedef struct JointSet {
    double spacing; // m, from line to line
    double width;   // m, of a joint
    float jitter;   // 0..0.5 spacings: by how much a line is off its place
    double least;   // 0..1: how open the tightest joint is; the widest has 1
    uint64_t key;
} JointSet;

typedef struct Joint {
    double share;  // 0..1: how much of a joint is at a place
    int64_t block; // number of the last line before it
} Joint;

// across: m, along the normal of the set's lines. cell: m between samples; a joint too narrow for
// it is wider and fainter.
Joint joint_at(const JointSet *set, double across, double cell);

#endif
