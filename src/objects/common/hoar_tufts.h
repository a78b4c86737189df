// Tufts of hoar frost while they are placed. Private to the frost's files.
#ifndef RAMIFY_OBJECTS_COMMON_HOAR_TUFTS_H
#define RAMIFY_OBJECTS_COMMON_HOAR_TUFTS_H

#include "objects/common/hoar.h"
#include "objects/common/recipe.h"

enum { HOAR_SHAPES = 5 }; // of tufts

#define HOAR_SPACING 0.22f // m between tufts for a metre of needles

// Initialize to {0}.
typedef struct HoarTufts {
    Transform *place[HOAR_SHAPES];
    int64_t count[HOAR_SHAPES], capacity[HOAR_SHAPES];
} HoarTufts;

// Adds a tuft that grows along y (unit), `size` m long, and is turned about y toward `turned`.
bool hoar_tufts_add(HoarTufts *tufts, Vec3 foot, Vec3 turned, Vec3 y, float size, uint64_t key,
                    Error *e);

// Adds the tufts as instanced parts. Clears them, also on failure.
bool hoar_tufts_place(HoarTufts *tufts, HoarHabit habit, uint64_t seed, const Placing *placing,
                      int role, Error *e);

void hoar_tufts_clear(HoarTufts *tufts);

#endif
