// Copies of things: each variant is built once and instanced.
#include "objects/common/things.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/common/instanced.h"
#include "objects/kinds.h"

#include <stdlib.h>

enum { STREAM_THINGS = 1000 };                       // of the object's seed; THINGS + variant
enum { MOST_LEAVES = 250000, MOST_FACES = 1000000 }; // of a copy

bool thing_places_alloc(ThingPlaces *places, int64_t most, Error *e)
{
    *places = (ThingPlaces){0};
    places->place = memory_alloc(most, sizeof *places->place, e);
    places->thing = places->place ? memory_alloc(most, sizeof *places->thing, e) : NULL;
    return places->thing != NULL;
}

void thing_places_free(ThingPlaces *places)
{
    free(places->place);
    free(places->thing);
}

int things_choose(const Things *things, float u)
{
    float shares = 0.0f;
    for (int i = 0; i < things->count; i++) {
        shares += things->list[i].share;
    }
    float at = shares * u;
    int last = things->count - 1;
    for (int i = 0; i < last; i++) {
        at -= things->list[i].share;
        if (at < 0.0f) {
            return i;
        }
    }
    return last;
}

float things_clump_share(float clumping, float noise)
{
    return 1.0f - clumping * smoothstepf(0.25f, -0.05f, noise);
}

// OBJECT_MOST_MATERIALS of each thing, by its kind's roles.
const char *things_material(const Things *things, int index)
{
    int number = index / OBJECT_MOST_MATERIALS, role = index % OBJECT_MOST_MATERIALS;
    if (number >= things->count) {
        return NULL;
    }
    const SceneObject *object = &things->list[number].object;
    const char *given = object->material[role],
               *own = kind_material(object->kind, object->params, role);
    const char *first =
        object->material[0] ? object->material[0] : kind_material(object->kind, object->params, 0);
    return given ? given : own ? own : first;
}

void things_need(const Things *things, int64_t copies, Needs *needs)
{
    enum { PARTS = 4 };
    for (int i = 0; i < things->count; i++) {
        const SceneObject *object = &things->list[i].object;
        for (int v = 0; object->kind->needs && v < things->variants; v++) {
            object->kind->needs(object->params, needs);
        }
    }
    needs_add_groups(needs, "count", (double)copies, PARTS);
}

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
static bool add_variant(const Things *things, int variant, const ThingPlaces *all, Transform *place,
                        const Placing *placing, Error *e)
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
    int number = variant / things->variants;
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
    bool done = build(&things->list[number], &own, e) && instanced_add(&single, &how, placing, e);
    geometry_clear(&single);
    return done;
}

bool things_geometry(const Things *things, const ThingPlaces *places, const Placing *placing,
                     Error *e)
{
    Transform *place = memory_alloc(places->count + 1, sizeof *place, e);
    bool done = place != NULL;
    for (int v = 0; done && v < things->count * things->variants; v++) {
        done = add_variant(things, v, places, place, placing, e);
    }
    free(place);
    return done;
}
