// A record of attractors: when each appeared and when growth removed it.
#ifndef RAMIFY_GROW_ATTRACTOR_LOG_H
#define RAMIFY_GROW_ATTRACTOR_LOG_H

#include "shape/points.h"

#include <stdint.h>

// Attractors that were there together, with one kill and one influence distance.
typedef struct AttractorGroup {
    int64_t first, count;  // its attractors
    float kill, influence; // m
    int32_t born;          // birth of the youngest nodes when the group appeared
} AttractorGroup;

#define ATTRACTOR_LEFT INT32_MAX // growth never removed it

// Initialize to {0}.
typedef struct AttractorLog {
    Vec3 *position, *normal; // owned; m, unit
    int32_t *removed;        // owned; birth of the node that removed it, or ATTRACTOR_LEFT
    int64_t count, capacity[3];
    AttractorGroup *group; // owned
    int64_t group_count, group_capacity;
} AttractorLog;

// Appends a group of attractors, all of them ATTRACTOR_LEFT.
bool attractor_log_add(AttractorLog *log, const PointSet *points, float kill, float influence,
                       int32_t born, Error *e);

// Copies what was there when the youngest node had this birth: the groups that had appeared, with
// the attractors that were left. Clear `then` with attractor_log_clear; it is empty on failure.
bool attractor_log_at(const AttractorLog *log, int32_t birth, AttractorLog *then, Error *e);

// Frees the arrays; the log is then empty.
void attractor_log_clear(AttractorLog *log);

#endif
