// A cascade's parts: the clear film of its water on the rock, with what clouds show of it.
#include "base/memory.h"
#include "objects/cascade/cascade.h"

#include <stdlib.h>

enum { BATCH = 64 }; // strands that are followed at once

static void follow(const CascadeParams *params, const Recipe *recipe, int first, int strands,
                   CascadePlace *place, int *count)
{
#pragma omp parallel for schedule(dynamic) num_threads(recipe->run->threads)
    for (int i = 0; i < strands; i++) {
        count[i] = cascade_way(params, recipe->surface, recipe->seed, first + i,
                               place + (int64_t)i * CASCADE_STEPS, CASCADE_STEPS);
    }
}

static bool whiten(const CascadeParams *params, const Recipe *recipe, const CascadeWater *water,
                   Error *e)
{
    CascadePlace *place = memory_alloc(BATCH * CASCADE_STEPS, sizeof *place, e);
    bool done = place;
    for (int first = 0; done && first < params->strands; first += BATCH) {
        if (run_is_cancelled(recipe->run)) {
            done = run_cancel_error(e);
            break;
        }
        int count[BATCH], strands = params->strands - first;
        strands = strands < BATCH ? strands : BATCH;
        follow(params, recipe, first, strands, place, count);
        for (int i = 0; done && i < strands; i++) {
            done = cascade_whiten(params, recipe->seed, first + i,
                                  place + (int64_t)i * CASCADE_STEPS, count[i], water, e);
        }
    }
    free(place);
    return done;
}

static bool new_parcels(SprayParcels **parcels, Error *e)
{
    *parcels = memory_alloc_zero(1, sizeof **parcels, e);
    return *parcels;
}

bool cascade_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const CascadeParams *params = given;
    const Recipe *recipe = placing->recipe;
    Part part = {.is_water = true};
    bool done = (!placing->keep_water || new_parcels(&part.water, e)) &&
                (!placing->keep_spray || new_parcels(&part.spray, e));
    if (done && (part.water || part.spray)) {
        done = whiten(params, recipe, &(CascadeWater){part.water, part.spray}, e);
    }
    if (!done || !(part.mesh = cascade_film(params, recipe, e))) {
        part_clear(&part);
        return recipe_fail(recipe, NULL, e);
    }
    return placing_add(placing, part, 0, e);
}
