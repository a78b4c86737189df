// Geometry of scattered objects.
#include "objects/scatter/scatter.h"

bool scatter_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const ScatteringParams *params = given;
    ThingPlaces places;
    int64_t settled;
    bool done =
        scatter_places_init(&places, params, placing->recipe, &placing->around, &settled, e);
    if (done && params->beyond > 0 && scatter_copies(params, placing->recipe->surface) == 0) {
        recipe_warn(placing->recipe, NULL,
                    "beyond is %d, but '%s' has no copies around it that things could stand on",
                    params->beyond, params->on);
    }
    if (done && settled < params->count) {
        recipe_warn(placing->recipe, NULL, "only %lld of %lld copies found a place",
                    (long long)settled, (long long)params->count);
    }
    done = done && things_geometry(&params->things, &places, placing, e);
    thing_places_free(&places);
    return done;
}
