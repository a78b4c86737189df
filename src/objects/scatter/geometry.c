// Geometry of scattered objects.
#include "objects/scatter/scatter.h"

bool scatter_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const ScatteringParams *params = given;
    ThingPlaces places;
    bool done = scatter_places_init(&places, params, placing->recipe, &placing->around, e);
    int64_t settled = places.count / (1 + scatter_copies(params, placing->recipe->surface));
    if (done && settled < params->count) {
        recipe_warn(placing->recipe, NULL, "only %lld of %lld copies found a place",
                    (long long)settled, (long long)params->count);
    }
    done = done && things_geometry(&params->things, &places, placing, e);
    thing_places_free(&places);
    return done;
}
