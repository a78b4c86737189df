// From grown stands to a forest: each stand skinned once and instanced; ferns under them.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/forest/forest.h"
#include "objects/forest/stand_places.h"
#include "objects/ground/fern.h"
#include "objects/ground/grove.h"

#include <stdlib.h>

enum { FERN_VARIANTS = 3 };
#define FERN_PATCH 7.0f // m, from patch to patch

// Adds a part of a single stand at every place of that stand; leaves are baked into one mesh first.
static bool add_part(Geometry *geometry, Part *part, const StandPlaces *places, int stand,
                     const Run *run, Error *e)
{
    Part copy = {.kind = part->kind, .material = part->material, .object = part->object};
    copy.instance = memory_alloc(places->count, sizeof *copy.instance, e);
    if (!copy.instance) {
        return false;
    }
    for (int64_t i = 0; i < places->count; i++) {
        if (places->stand[i] == stand) {
            copy.instance[copy.instance_count++] = places->place[i];
        }
    }
    if (part->instance_count > 0) {
        copy.mesh = geometry_bake(part, run, e);
    } else {
        copy.mesh = part->mesh;
        copy.curves = part->curves;
        part->mesh = NULL;
        part->curves = NULL;
    }
    if ((!copy.mesh && !copy.curves) || copy.instance_count == 0) {
        bool empty = copy.instance_count == 0; // no place for this stand
        mesh_free(copy.mesh);
        curves_free(copy.curves);
        free(copy.instance);
        return empty;
    }
    return geometry_add(geometry, copy, e);
}

static bool add_stand(const OutTree *all, const ForestParams *params,
                      const ForestMaterials *materials, int object, int stand,
                      const StandPlaces *places, uint64_t seed, Geometry *geometry, const Run *run,
                      Error *e)
{
    TreeMaterials own = {materials->bark, materials->twig, materials->leaf};
    TreeParams tree = tree_params_default();
    tree.height = params->height;
    tree.roots.count = 0; // colonies are trees of the stand here
    tree.radii = params->radii;
    tree.leaves = params->leaves;
    tree.skin = params->skin;
    Geometry single = {0};
    OutTree *nodes = forest_stand(all, params, stand, e);
    bool done = nodes && tree_geometry(nodes, &tree, &own, object, seed, &single, run, e);
    for (int64_t i = 0; done && i < single.count; i++) {
        done = add_part(geometry, &single.part[i], places, stand, run, e);
    }
    out_tree_free(nodes);
    geometry_clear(&single);
    return done;
}

// Ferns of one variant, in patches, larger in their middle. -1 when interrupted.
static int64_t place_ferns(const ForestParams *params, uint64_t seed, uint64_t patches,
                           int64_t wanted, ForestLand *land, const void *user, const Flood *flood,
                           Transform *place, const Run *run, Error *e)
{
    int64_t count = 0;
    for (int64_t i = 0; i < wanted; i++) {
        if (!run_goes_on(run, i, e)) {
            return -1;
        }
        uint64_t key = random_key(seed, (uint64_t)i);
        float r = params->fern_radius * exact_pow(random_unit(random_key(key, 1)), 0.65f);
        float sine, cosine;
        exact_sincos(random_range(random_key(key, 2), 0.0f, 2.0f * PI_F), &sine, &cosine);
        float dx = r * sine, dz = r * cosine; // from the glade's middle
        float x = params->glade_center.x + dx, z = params->glade_center.z + dz;
        float patch = noise_plane_fractal(dx / FERN_PATCH, dz / FERN_PATCH, 2, patches);
        Vec3 foot = vec3(x, land(user, x, z), z);
        if (patch < random_range(random_key(key, 3), -0.25f, 0.25f) || flood_covers(flood, foot)) {
            continue;
        }
        float size = random_range(random_key(key, 4), 0.6f, 1.0f) * (0.8f + 0.8f * patch);
        exact_sincos(random_range(random_key(key, 5), 0.0f, 2.0f * PI_F), &sine, &cosine);
        place[count++] =
            transform_from_axes(vec3(size * cosine, 0, -size * sine), vec3(0, size, 0),
                                vec3(size * sine, 0, size * cosine), vec3(x, foot.y - 0.02f, z));
    }
    return count;
}

static bool add_ferns(const ForestParams *params, int material, int object, uint64_t seed,
                      ForestLand *land, const void *user, const Flood *flood, Geometry *geometry,
                      const Run *run, Error *e)
{
    for (int v = 0; v < FERN_VARIANTS; v++) {
        uint64_t key = random_key(seed, (uint64_t)v);
        int64_t wanted = grove_share(params->ferns, FERN_VARIANTS, v);
        Transform *place = memory_alloc(wanted, sizeof *place, e);
        int64_t count = place ? place_ferns(params, random_key(key, 1), random_key(seed, 100),
                                            wanted, land, user, flood, place, run, e)
                              : -1;
        if (count <= 0) {
            free(place);
            if (count < 0) {
                return false;
            }
            continue;
        }
        Part part = {.kind = PART_MESH,
                     .mesh = fern_mesh_new(params->fern_height, random_key(key, 2), e),
                     .material = material,
                     .object = object,
                     .instance = place,
                     .instance_count = count};
        if (!part.mesh) {
            free(place);
            return false;
        }
        if (!geometry_add(geometry, part, e)) {
            return false;
        }
    }
    return true;
}

bool forest_geometry(const OutTree *tree, const ForestParams *params,
                     const ForestMaterials *materials, int object, uint64_t seed, ForestLand *land,
                     const void *user, const Flood *flood, Geometry *geometry, const Run *run,
                     Error *e)
{
    StandPlaces places;
    if (!stand_places_init(&places, params, random_key(seed, 20), land, user, flood, run, e)) {
        return false;
    }
    bool done = true;
    for (int i = 0; done && i < params->stands; i++) {
        done = add_stand(tree, params, materials, object, i, &places,
                         random_key(seed, 30 + (uint64_t)i), geometry, run, e);
    }
    stand_places_free(&places);
    return done &&
           (params->ferns == 0 || add_ferns(params, materials->fern, object, random_key(seed, 21),
                                            land, user, flood, geometry, run, e));
}
