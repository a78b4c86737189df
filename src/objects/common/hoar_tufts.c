#include "objects/common/hoar_tufts.h"

#include "base/memory.h"
#include "mesh/hoar.h"

#include <stdlib.h>

#define SPREAD 55.0f // degrees, of the needles in a tuft

bool hoar_tufts_add(HoarTufts *tufts, Vec3 foot, Vec3 turned, Vec3 y, float size, uint64_t key,
                    Error *e)
{
    Vec3 x = vec3_normalize(vec3_madd(turned, -vec3_dot(turned, y), y)), z = vec3_cross(x, y);
    int k = (int)(HOAR_SHAPES * random_unit(key));
    if (!memory_reserve(&tufts->place[k], &tufts->capacity[k], tufts->count[k] + 1,
                        sizeof *tufts->place[k], e)) {
        return false;
    }
    tufts->place[k][tufts->count[k]++] =
        transform_from_axes(vec3_scale(x, size), vec3_scale(y, size), vec3_scale(z, size), foot);
    return true;
}

void hoar_tufts_clear(HoarTufts *tufts)
{
    for (int k = 0; k < HOAR_SHAPES; k++) {
        free(tufts->place[k]);
    }
    *tufts = (HoarTufts){0};
}

// Takes the tufts of one shape over into a part, whose mesh is NULL on failure.
static Part part_of(HoarTufts *tufts, int k, HoarHabit habit, uint64_t seed, Error *e)
{
    uint64_t key = random_key(seed, (uint64_t)k);
    Part part = {.mesh = habit == HOAR_FEATHERS ? hoar_feathers(SPREAD, key, e)
                                                : hoar_tuft(SPREAD, key, e),
                 .instance = tufts->place[k],
                 .instance_count = tufts->count[k]};
    tufts->place[k] = NULL;
    return part;
}

bool hoar_tufts_place(HoarTufts *tufts, HoarHabit habit, uint64_t seed, const Placing *placing,
                      int role, Error *e)
{
    bool done = true;
    for (int k = 0; done && k < HOAR_SHAPES; k++) {
        done = tufts->count[k] == 0 ||
               placing_add(placing, part_of(tufts, k, habit, seed, e), role, e);
    }
    hoar_tufts_clear(tufts);
    return done;
}
