// A hierarchy of bounds over many small lights; draws one in proportion to an estimate of its
// contribution. Conty and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
// HPG 2018; importance and merging of cones as in Pharr, Jakob and Humphreys, PBRT, 4th
// ed., 12.6.3.
#ifndef RAMIFY_RENDER_LIGHT_LIGHT_TREE_H
#define RAMIFY_RENDER_LIGHT_LIGHT_TREE_H

#include "base/error.h"
#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

// Bounds of one or several lights: position, orientation and power. Every light emits into the half
// space in front of its surface.
typedef struct LightBounds {
    Aabb box;
    Vec3 axis;        // unit: middle of the surface normals
    float cos_normal; // of the half angle of the cone that holds the normals; -1 = all around
    float power;
    bool two_sided;
} LightBounds;

// A point to be lit. normal: unit, of an opaque surface; zero if light may arrive from all around.
typedef struct LightReceiver {
    Vec3 position, normal;
} LightReceiver;

// A stretch of a ray whose medium scatters light toward the ray's origin.
typedef struct LightSegment {
    Vec3 origin, direction; // unit direction
    float near, far;        // m; far may be INFINITY
} LightSegment;

typedef struct LightTree LightTree;

// bounds: count of them, at least 1; read only while building. ERROR_CANCELLED when cancelled.
LightTree *light_tree_new(const LightBounds *bounds, int64_t count, const Run *run, Error *e);
void light_tree_free(LightTree *tree); // NULL is fine

float light_tree_power(const LightTree *tree); // sum over all lights

// Draws a light with a uniform number u; *probability: of that light. -1 if none can reach the
// receiver.
int64_t light_tree_sample(const LightTree *tree, const LightReceiver *receiver, float u,
                          float *probability);
float light_tree_probability(const LightTree *tree, const LightReceiver *receiver, int64_t light);

// The same for light that is scattered along a segment.
int64_t light_tree_sample_segment(const LightTree *tree, const LightSegment *segment, float u,
                                  float *probability);
float light_tree_probability_segment(const LightTree *tree, const LightSegment *segment,
                                     int64_t light);

#endif
