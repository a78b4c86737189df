// Geometry of a forest: each stand skinned once and instanced, with ferns below.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/forest/forest.h"
#include "objects/forest/individuals.h"
#include "objects/forest/stand_places.h"
#include "objects/forest/tree_places.h"
#include "objects/ground/fern.h"
#include "objects/ground/grove.h"
#include "objects/tree/instanced.h"

#include <stdlib.h>

// Of the object's seed; its growth uses stream i for stand i, its skin STANDS + i.
enum { STREAM_PLACES = 20, STREAM_FERNS = 21, STREAM_STANDS = 30 };
enum { STREAM_PATCHES = 100 }; // of the ferns; variant i uses stream i
enum { STREAM_VARIANT_PLACES = 1, STREAM_VARIANT_MESH = 2 }; // of a variant
// Of a fern.
enum {
    STREAM_RADIUS = 1,
    STREAM_AZIMUTH = 2,
    STREAM_PATCH_EDGE = 3,
    STREAM_SIZE = 4,
    STREAM_TURN = 5
};

enum { FERN_VARIANTS = 3, INDIVIDUAL_FACES = 1000000 };
#define FERN_PATCH 7.0f // m, from patch to patch

// The places of one stand; *count may be 0. The caller frees the array.
static Transform *places_of(const StandPlaces *places, int stand, int64_t *count, Error *e)
{
    Transform *mine = memory_alloc(places->count, sizeof *mine, e);
    *count = 0;
    for (int64_t i = 0; mine && i < places->count; i++) {
        if (places->stand[i] == stand) {
            mine[(*count)++] = places->place[i];
        }
    }
    return mine;
}

// The materials are the forest's first three.
static bool add_stand(const OutTree *all, const ForestParams *params, int stand,
                      const StandPlaces *places, const Placing *placing, Error *e)
{
    TreeParams tree = tree_params_default();
    tree.height = params->height;
    tree.roots.count = 0; // here colonies are trees, not parts of one
    tree.grown_by = GROWN_BY_ATTRACTORS;
    tree.radii = params->radii;
    tree.leaves = params->leaves;
    tree.skin = params->skin;
    Recipe recipe = *placing->recipe;
    recipe.seed = random_key(recipe.seed, STREAM_STANDS + (uint64_t)stand);
    Geometry single = {0};
    Placing own = *placing;
    own.recipe = &recipe;
    own.geometry = &single;
    int64_t count;
    Transform *place = places_of(places, stand, &count, e);
    Grown nodes = {.tree = place && count > 0 ? forest_stand(all, params, stand, e) : NULL};
    bool done = place && (count == 0 || (nodes.tree && tree_geometry(&tree, &nodes, &own, e)));
    for (int64_t i = 0; done && i < single.count; i++) {
        done = grove_add_part(placing->geometry, &single.part[i], place, count, recipe.run, e);
    }
    free(place);
    grown_clear(&nodes);
    geometry_clear(&single);
    return done;
}

// Places ferns of one variant in patches, larger in the middle of each. -1 if interrupted.
static int64_t place_ferns(const ForestParams *params, uint64_t seed, uint64_t patches,
                           int64_t wanted, const Surroundings *around, Transform *place,
                           const Run *run, Error *e)
{
    int64_t count = 0;
    for (int64_t i = 0; i < wanted; i++) {
        if (!run_goes_on(run, i, e)) {
            return -1;
        }
        uint64_t key = random_key(seed, (uint64_t)i);
        float r =
            params->fern_radius * exact_pow(random_unit(random_key(key, STREAM_RADIUS)), 0.65f);
        float sine, cosine;
        exact_sincos(random_range(random_key(key, STREAM_AZIMUTH), 0.0f, 2.0f * PI_F), &sine,
                     &cosine);
        float dx = r * sine, dz = r * cosine; // from the glade's middle
        float x = params->glade_center.x + dx, z = params->glade_center.z + dz;
        float patch = noise_plane_fractal(dx / FERN_PATCH, dz / FERN_PATCH, 2, patches);
        Vec3 foot = vec3(x, land_height(&around->land, x, z), z);
        if (patch < random_range(random_key(key, STREAM_PATCH_EDGE), -0.25f, 0.25f) ||
            flood_covers(around->flood, foot)) {
            continue;
        }
        float size = random_range(random_key(key, STREAM_SIZE), 0.6f, 1.0f) * (0.8f + 0.8f * patch);
        exact_sincos(random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F), &sine, &cosine);
        place[count++] =
            transform_from_axes(vec3(size * cosine, 0, -size * sine), vec3(0, size, 0),
                                vec3(size * sine, 0, size * cosine), vec3(x, foot.y - 0.02f, z));
    }
    return count;
}

static bool add_ferns(const ForestParams *params, uint64_t seed, const Placing *placing, Error *e)
{
    for (int v = 0; v < FERN_VARIANTS; v++) {
        uint64_t key = random_key(seed, (uint64_t)v);
        int64_t wanted = grove_share(params->ferns, FERN_VARIANTS, v);
        Transform *place = memory_alloc(wanted, sizeof *place, e);
        int64_t count = place ? place_ferns(params, random_key(key, STREAM_VARIANT_PLACES),
                                            random_key(seed, STREAM_PATCHES), wanted,
                                            &placing->around, place, placing->recipe->run, e)
                              : -1;
        if (count <= 0) {
            free(place);
            if (count < 0) {
                return false;
            }
            continue;
        }
        Part part = {
            .mesh = fern_mesh_new(params->fern_height, random_key(key, STREAM_VARIANT_MESH), e),
            .instance = place,
            .instance_count = count};
        if (!placing_add(placing, part, FOREST_FERN, e)) {
            return false;
        }
    }
    return true;
}

// The individuals at their places, with a list of transforms for each in turn.
static bool add_individuals(const ForestParams *params, const Individuals *all,
                            const TreePlaces *places, const OutTree *grown, const Placing *placing,
                            Error *e)
{
    Transform *place = memory_alloc(places->count + 1, sizeof *place, e);
    bool done = place;
    for (int i = 0; done && i < all->count; i++) {
        const Individual *one = &all->one[i];
        int64_t count = 0;
        for (int64_t k = 0; k < places->count; k++) {
            if (places->individual[k] == i) {
                place[count++] = places->place[k];
            }
        }
        InstancedTree how = {.at = {.place = place,
                                    .count = count,
                                    .most_leaves = params->leaves.max_count,
                                    .most_faces = INDIVIDUAL_FACES,
                                    .eye = placing->around.eye,
                                    .seed = one->seed},
                             .material = placing->further + (int64_t)one->species * TREE_ROLES};
        Grown single = {.tree = count > 0 ? individuals_tree(all, grown, i, e) : NULL};
        done = count == 0 || (single.tree && tree_finish(NULL, NULL, NULL, &single, e) &&
                              tree_add_instanced(&one->params, &single, &how, placing, e));
        grown_clear(&single);
    }
    free(place);
    return done;
}

static bool add_species(const ForestParams *params, const OutTree *grown, const Placing *placing,
                        Error *e)
{
    uint64_t seed = placing->recipe->seed;
    Individuals all;
    TreePlaces places = {0};
    bool done = individuals_init(&all, params, seed, e) &&
                tree_places_init(&places, params, &all, random_key(seed, STREAM_PLACES),
                                 &placing->around, placing->recipe->run, e) &&
                add_individuals(params, &all, &places, grown, placing, e);
    tree_places_free(&places);
    individuals_free(&all);
    return done;
}

bool forest_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const ForestParams *params = given;
    uint64_t seed = placing->recipe->seed;
    StandPlaces places;
    if (params->species_count > 0) {
        return add_species(params, grown->tree, placing, e) &&
               (params->ferns == 0 ||
                add_ferns(params, random_key(seed, STREAM_FERNS), placing, e));
    }
    if (!stand_places_init(&places, params, random_key(seed, STREAM_PLACES), &placing->around,
                           placing->recipe->run, e)) {
        return false;
    }
    bool done = true;
    for (int i = 0; done && i < params->stands; i++) {
        done = add_stand(grown->tree, params, i, &places, placing, e);
    }
    stand_places_free(&places);
    return done &&
           (params->ferns == 0 || add_ferns(params, random_key(seed, STREAM_FERNS), placing, e));
}
