// The sheets that a crack network on a surface makes when it is swept inward: what fracture.h
// removes.
#ifndef RAMIFY_MODEL_CRACK_H
#define RAMIFY_MODEL_CRACK_H

#include "base/error.h"
#include "base/run.h"
#include "tree/out_tree.h"

typedef struct CrackParams {
    Vec3 center;      // m: what the cracks are swept to,
    bool to_axis;     // or the vertical through it
    float outward;    // m: how far sheets go beyond the network
    float known;      // m: how far from them distances are told
    float roughness;  // m: by how much noise displaces the sheets
    float wavelength; // m: of its largest bumps
    uint64_t seed;
} CrackParams;

typedef struct Crack Crack;

// The sheets of all bars of the network, for points within the box.
Crack *crack_new(const OutTree *network, const CrackParams *params, Aabb box, const Run *run,
                 Error *e);
void crack_free(Crack *crack); // NULL is fine

// Distance to the nearest sheet, m, at most `known`. Safe to call from many threads.
float crack_distance(const Crack *crack, Vec3 p);

// Distance of a point to a triangle.
float triangle_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

#endif
