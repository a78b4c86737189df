// A growing set of points in cells, for the nearest point within a fixed reach.
#ifndef RAMIFY_SHAPE_POINT_HASH_H
#define RAMIFY_SHAPE_POINT_HASH_H

#include "base/error.h"
#include "base/vec.h"

typedef struct PointHash PointHash;

// reach: m, positive; no query reaches farther. Free with point_hash_free.
PointHash *point_hash_new(float reach, Error *e);
void point_hash_free(PointHash *hash); // NULL is fine
void point_hash_clear(PointHash *hash);
bool point_hash_add(PointHash *hash, Vec3 p, Error *e);

// Finds the point nearest to p if it is nearer than *least (at most the reach), and lowers *least
// to its distance. Ties go to the point added first.
bool point_hash_nearest(const PointHash *hash, Vec3 p, float *least, Vec3 *nearest);

#endif
