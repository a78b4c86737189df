// A swarm as a kind of object.
#include "objects/swarm/swarm.h"

#include <stdio.h>

static const char *further_material(const void *params, int index)
{
    const SwarmParams *swarm = params;
    return things_material(&swarm->things, index);
}

static void needs(const void *params, Needs *needs)
{
    const SwarmParams *swarm = params;
    things_need(&swarm->things, swarm->count, needs);
    for (int i = 0; i < swarm->shape_count; i++) {
        needs_add_mesh_file(needs, "envelope", swarm->shapes[i].file);
    }
}

static void describe(const void *params, char *text, size_t size)
{
    const SwarmParams *swarm = params;
    snprintf(text, size, ", %lld copies of %d things in space", (long long)swarm->count,
             swarm->things.count);
}

static int64_t copies(const void *params)
{
    const SwarmParams *swarm = params;
    return swarm->count;
}

static bool swarm_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const SwarmParams *params = given;
    ThingPlaces places;
    bool done = swarm_places_init(&places, params, placing->recipe, e);
    if (done && places.count < params->count) {
        recipe_warn(placing->recipe, NULL, "only %lld of %lld copies found a place",
                    (long long)places.count, (long long)params->count);
    }
    done = done && things_geometry(&params->things, &places, placing, e);
    thing_places_free(&places);
    return done;
}

static const Key NO_MATERIALS[] = {{0}};

const Kind kind_swarm = {
    .variant = {KIND_ROW("swarm", &swarm_table,
                         "Copies of any objects in space: a school of fish, a flock of birds."),
                NO_MATERIALS},
    .materials = {"clay"},
    .further_material = further_material,
    .reads_scene = true, // what is copied may
    .needs = needs,
    .describe = describe,
    .copies = copies,
    .geometry = swarm_geometry};
