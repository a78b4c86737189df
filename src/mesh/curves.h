// Round curves (twigs, hairs, grass): polylines with radii, traced as linear round segments.
#ifndef RAMIFY_MESH_CURVES_H
#define RAMIFY_MESH_CURVES_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct CurveSet {
    int64_t point_count, curve_count;
    Vec3 *position; // m, per point
    float *radius;  // m, per point
    float *birth;   // 0..1, per point
    float *along;   // m along the branch from its start, per point; for textures
    float *glow;    // factor on the radiance of an emitting material, per point; NULL = 1 (not
                    // allocated by curves_new; allocate with memory_alloc, the set takes ownership)
    uint64_t *id;   // per curve: stable name that keys its random draws
    int64_t *first; // curve_count + 1 entries: curve i has points first[i] .. first[i + 1] - 1, at
                    // least 2
} CurveSet;

CurveSet *curves_new(int64_t point_count, int64_t curve_count, Error *e);
void curves_free(CurveSet *curves); // NULL is fine

#endif
