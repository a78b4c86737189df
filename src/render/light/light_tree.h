// A hierarchy of bounds over many small lights, from which one is drawn in proportion to what it
// may contribute. Conty and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting", HPG 2018; importance and merging of cones as in Pharr, Jakob and Humphreys, PBRT, 4th
// ed., 12.6.3.
#ifndef RAMIFY_RENDER_LIGHT_LIGHT_TREE_H
#define RAMIFY_RENDER_LIGHT_LIGHT_TREE_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

// One light, or several: where they are, which way they face, what they send out. Every light
// shines into the half space before its surface.
typedef struct LightBounds {
    Aabb box;
    Vec3 axis;        // unit: middle of the surface normals
    float cos_normal; // of the half angle of the cone that holds the normals; -1 = all around
    float power;
    bool two_sided;
} LightBounds;

// A point that asks for light. normal: unit, of a surface that light from behind does not reach;
// zero where light may come from all around.
typedef struct LightReceiver {
    Vec3 position, normal;
} LightReceiver;

// A stretch of a ray that asks for light: what a medium scatters toward its origin.
typedef struct LightSegment {
    Vec3 origin, direction; // unit direction
    float near, far;        // m; far may be INFINITY
} LightSegment;

typedef struct LightTree LightTree;

// bounds: count of them, at least 1; read only while building.
LightTree *light_tree_new(const LightBounds *bounds, int64_t count, Error *e);
void light_tree_free(LightTree *tree); // NULL is fine

float light_tree_power(const LightTree *tree); // sum over all lights

// A light drawn with a uniform number u and the probability of that; -1 where none can reach the
// receiver.
int64_t light_tree_sample(const LightTree *tree, const LightReceiver *receiver, float u,
                          float *probability);
float light_tree_probability(const LightTree *tree, const LightReceiver *receiver, int64_t light);

// The same for light scattered along a segment.
int64_t light_tree_sample_segment(const LightTree *tree, const LightSegment *segment, float u,
                                  float *probability);
float light_tree_probability_segment(const LightTree *tree, const LightSegment *segment,
                                     int64_t light);

#endif
