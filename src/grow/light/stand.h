// The light among plants that grow side by side: all give their leaves, one grid carries the sky's
// light through them, and all read it. The result does not depend on the order of the plants.
#ifndef RAMIFY_GROW_LIGHT_STAND_H
#define RAMIFY_GROW_LIGHT_STAND_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct LightStand LightStand;

// For so many plants, without leaves. Free with light_stand_free.
LightStand *light_stand_new(int plants, Error *e);
void light_stand_free(LightStand *stand); // NULL is fine

// Sets the leaves of plant number `plant` in place of those that it had. leaf: count places, m, in
// a space that all share; area: m2 of each across the light; cell: m, edge of the voxels that it
// needs.
bool light_stand_give(LightStand *stand, int plant, const Vec3 *leaf, int64_t count, float area,
                      float cell, Error *e);

// Offsets, m, at which all leaves cast their shade once more. Borrows the list.
void light_stand_repeat(LightStand *stand, const Vec3 *offset, int count);

// Area and voxel that the plant's leaves were given with.
void light_stand_leaf(const LightStand *stand, int plant, float *area, float *cell);

// Carries the light through all leaves that were given. The same bits for any number of threads.
bool light_stand_solve(LightStand *stand, int threads, Error *e);

// As shade_grid_light and shade_grid_brightest, of the last solution; p: m.
float light_stand_light(const LightStand *stand, Vec3 p);
Vec3 light_stand_brightest(const LightStand *stand, Vec3 p);

#endif
