// Geometry of scattered objects: each variant is built once and instanced.
#include "base/memory.h"
#include "base/random.h"
#include "objects/common/instanced.h"
#include "objects/scatter/scatter.h"

#include <stdlib.h>

enum { STREAM_THINGS = 1000 };                       // of the object's seed; THINGS + variant
enum { MOST_LEAVES = 250000, MOST_FACES = 1000000 }; // of a copy

// Builds the thing where it would stand alone in the scene.
static bool build(const Thing *thing, const Placing *placing, Error *e)
{
    const Kind *kind = thing->object.kind;
    OwnSpace own;
    Grown grown = {0};
    bool done = own_space_enter(&own, kind, thing->object.params, e) &&
                kind_grow(kind, own.params, placing->recipe, 1.0f, NULL, &grown, e) &&
                kind->geometry(own.params, &grown, placing, e) &&
                own_space_carry_parts(&own, placing->geometry, 0, e);
    grown_clear(&grown);
    own_space_leave(&own);
    return done;
}

// Copies of one variant. place: room for all places.
static bool add_variant(const ScatteringParams *params, int variant, const ScatterPlaces *all,
                        Transform *place, const Placing *placing, Error *e)
{
    int64_t count = 0;
    for (int64_t i = 0; i < all->count; i++) {
        if (all->thing[i] == variant) {
            place[count++] = all->place[i];
        }
    }
    if (count == 0) {
        return true;
    }
    int number = variant / params->variants;
    Geometry single = {0};
    Recipe recipe = {.seed = random_key(placing->recipe->seed, STREAM_THINGS + (uint64_t)variant),
                     .label = placing->recipe->label,
                     .run = placing->recipe->run};
    Placing own = {.recipe = &recipe,
                   .geometry = &single,
                   .material = placing->further + (int64_t)number * OBJECT_MOST_MATERIALS,
                   .object = placing->object,
                   .around = {.eye = placing->around.eye, .material = placing->around.material}};
    Instanced how = {.place = place,
                     .count = count,
                     .most_leaves = MOST_LEAVES,
                     .most_faces = MOST_FACES,
                     .eye = placing->around.eye,
                     .seed = recipe.seed};
    bool done = build(&params->things[number], &own, e) && instanced_add(&single, &how, placing, e);
    geometry_clear(&single);
    return done;
}

bool scatter_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const ScatteringParams *params = given;
    ScatterPlaces places;
    bool done = scatter_places_init(&places, params, placing->recipe, &placing->around, e);
    Transform *place = done ? memory_alloc(places.count + 1, sizeof *place, e) : NULL;
    if (place && places.count < params->count) {
        recipe_warn(placing->recipe, NULL, "only %lld of %lld copies found a place",
                    (long long)places.count, (long long)params->count);
    }
    for (int v = 0; place && done && v < params->thing_count * params->variants; v++) {
        done = add_variant(params, v, &places, place, placing, e);
    }
    free(place);
    scatter_places_free(&places);
    return done && place;
}
