// Balls at many places: markers of points, lamps on branches.
#ifndef RAMIFY_OBJECTS_COMMON_BALLS_H
#define RAMIFY_OBJECTS_COMMON_BALLS_H

#include "objects/common/recipe.h"

enum { BALL_FACES = 224 }; // of each

// Adds a part with a ball of this radius (m) at every position; nothing if there are none.
bool balls_add(const Vec3 *position, int64_t count, float radius, const Placing *placing, int role,
               Error *e);

// The same with a radius (m) for each.
bool balls_add_each(const Vec3 *position, const float *radius, int64_t count,
                    const Placing *placing, int role, Error *e);

#endif
