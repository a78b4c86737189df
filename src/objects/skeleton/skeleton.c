#include "objects/skeleton/skeleton.h"

#include "base/memory.h"
#include "outtree/out_tree_io.h"
#include "skin/skin.h"

#include <stdlib.h>

#define LEAST_RADIUS 0.0003f // of the extent, where the file says 0
#define FARTHEST 1e7f        // m: beyond, a float cannot tell points a metre apart

SkeletonParams skeleton_params_default(void)
{
    return (SkeletonParams){.scale = 1.0f,
                            .axon = true,
                            .basal = true,
                            .apical = true,
                            .rest = true,
                            .radius_factor = 1.0f,
                            .smoothing = 2,
                            .spine_length = 1.5f,
                            .skin = {.levels = 2, .ring_spacing = 1.0f}};
}

// ---- selection ----

static bool is_shown(const SkeletonParams *params, int32_t type)
{
    switch (type) {
    case SWC_SOMA:
        return params->soma != SKELETON_NO_SOMA;
    case SWC_AXON:
        return params->axon;
    case SWC_BASAL:
        return params->basal;
    case SWC_APICAL:
        return params->apical;
    default:
        return params->rest;
    }
}

// Copies the nodes of visible types; children of hidden nodes become roots.
static OutTree *pick(const OutTree *tree, const SkeletonParams *params, Error *e)
{
    OutTree *out = out_tree_new(e);
    int32_t *place = memory_alloc(tree->count, sizeof *place, e);
    bool done = out && place;
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        place[i] = -1;
        if (is_shown(params, tree->colony[i])) {
            int64_t above = parent < 0 ? -1 : place[parent];
            place[i] = (int32_t)out_tree_copy_node(out, above, tree, i, e);
            done = place[i] >= 0;
        }
    }
    free(place);
    if (done && out->count == 0) {
        done = error_set(e, ERROR_INPUT,
                         "all nodes of '%s' are hidden; show at least one type that it contains",
                         params->file);
    }
    if (!done) {
        out_tree_free(out);
        return NULL;
    }
    out->typed = true;
    return out;
}

// ---- placing ----

static Vec3 origin_of(const OutTree *tree, SkeletonOrigin origin)
{
    if (origin == SKELETON_ROOT) {
        return tree->position[0];
    }
    Aabb box = out_tree_bounds(tree);
    return origin == SKELETON_MIDDLE ? vec3_lerp(box.low, box.high, 0.5f) : vec3(0, 0, 0);
}

static bool is_placed_well(const OutTree *tree)
{
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        if (!(vec3_length(p) <= FARTHEST) || !(tree->radius[i] <= FARTHEST)) {
            return false;
        }
    }
    return true;
}

static bool put_in_place(OutTree *tree, const SkeletonParams *params, Error *e)
{
    float s = params->scale;
    Vec3 from = origin_of(tree, params->origin);
    Transform t = transform_compose(params->position, params->rotation, vec3(s, s, s));
    for (int64_t i = 0; i < tree->count; i++) {
        tree->position[i] = transform_point(&t, vec3_sub(tree->position[i], from));
        tree->radius[i] *= s * params->radius_factor;
    }
    if (!is_placed_well(tree)) {
        error_set(e, ERROR_INPUT,
                  "'%s' reaches farther than %g m; its lengths are often in micrometres, so that "
                  "scale should be less than %g",
                  params->file, (double)FARTHEST, (double)s);
        return error_key(e, "scale");
    }
    return true;
}

static void thicken(OutTree *tree, float min_radius)
{
    Aabb box = out_tree_bounds(tree);
    float nothing = fmaxf(LEAST_RADIUS * vec3_distance(box.low, box.high), 1e-9f);
    float least = min_radius > 0.0f ? min_radius : nothing;
    for (int64_t i = 0; i < tree->count; i++) {
        bool thin = min_radius > 0.0f ? tree->radius[i] < least : tree->radius[i] <= 0.0f;
        tree->radius[i] = thin ? least : tree->radius[i];
    }
}

// Takes the tree; NULL and e on failure.
static OutTree *with_soma(OutTree *tree, SkeletonSoma soma, Error *e)
{
    if (soma != SKELETON_ROUND) {
        return tree;
    }
    OutTree *round = skeleton_round_soma(tree, e);
    out_tree_free(tree);
    return round;
}

bool skeleton_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const SkeletonParams *params = given;
    OutTree *file = out_tree_import_swc(params->file, recipe->run, e);
    if (!file) {
        return error_key(e, "file");
    }
    whole->tree = pick(file, params, e);
    out_tree_free(file);
    if (!whole->tree || !put_in_place(whole->tree, params, e)) {
        return false;
    }
    thicken(whole->tree, params->min_radius);
    whole->tree = with_soma(whole->tree, params->soma, e);
    return whole->tree;
}

float skeleton_tip_radius(const void *params, const OutTree *whole)
{
    (void)params;
    float least = INFINITY;
    for (int64_t i = 0; i < whole->count; i++) {
        least = fminf(least, whole->radius[i]);
    }
    return least;
}

// ---- geometry ----

// Thick ways as a smooth skin, thin ones as round curves.
static bool add_skin(const OutTree *tree, const SkeletonParams *params, int role,
                     const Placing *placing, Error *e)
{
    SkinParams skin = branches_skin(&params->skin);
    skin.smoothing = params->smoothing;
    Part thick = {.mesh = skin_tree(tree, &skin, placing->recipe->run, e)};
    if (!placing_add(placing, thick, role, e)) {
        return false;
    }
    return !(skin.min_radius > 0.0f) ||
           placing_add(placing, (Part){.curves = skin_curves(tree, skin.min_radius, &skin, e)},
                       role, e);
}

// The axons with their descendants, each starting inside its parent branch.
static OutTree *axons_of(const OutTree *tree, const bool *of_axon, Error *e)
{
    OutTree *axons = out_tree_new(e);
    int32_t *place = memory_alloc(tree->count, sizeof *place, e);
    bool done = axons && place;
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (!of_axon[i]) {
            continue;
        }
        int64_t above = parent >= 0 && of_axon[parent] ? place[parent] : -1;
        if (above < 0 && parent >= 0) {
            above = out_tree_add_node(axons, tree->position[parent], -1, tree->birth[parent],
                                      SWC_AXON, tree->id[parent], e);
            done = above >= 0;
            if (done) {
                axons->radius[above] = tree->radius[i];
            }
        }
        place[i] = done ? (int32_t)out_tree_copy_node(axons, above, tree, i, e) : -1;
        done = place[i] >= 0;
    }
    free(place);
    if (!done) {
        out_tree_free(axons);
        return NULL;
    }
    return axons;
}

static bool add_apart(const OutTree *tree, bool *of_axon, const SkeletonParams *params,
                      const Placing *placing, Error *e)
{
    OutTree *axons = axons_of(tree, of_axon, e), *body = out_tree_copy(tree, e);
    for (int64_t i = 0; i < tree->count; i++) {
        of_axon[i] = !of_axon[i];
    }
    bool done = axons && body && out_tree_keep_nodes(body, of_axon, e) &&
                (body->count == 0 || add_skin(body, params, SKELETON_BODY, placing, e)) &&
                (axons->count == 0 || add_skin(axons, params, SKELETON_AXON, placing, e));
    out_tree_free(axons);
    out_tree_free(body);
    return done;
}

static bool add_all(const OutTree *tree, const SkeletonParams *params, const Placing *placing,
                    Error *e)
{
    if (placing->material[SKELETON_AXON] == placing->material[SKELETON_BODY]) {
        return add_skin(tree, params, SKELETON_BODY, placing, e);
    }
    bool *of_axon = memory_alloc(tree->count, sizeof *of_axon, e);
    for (int64_t i = 0; of_axon && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        of_axon[i] = tree->colony[i] == SWC_AXON || (parent >= 0 && of_axon[parent]);
    }
    bool done = of_axon && add_apart(tree, of_axon, params, placing, e);
    free(of_axon);
    return done;
}

// Descendants of a curve are curves, so a soma, thin at its pole, must not be a curve.
bool skeleton_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const SkeletonParams *params = given;
    OutTree *solid = out_tree_copy(grown->tree, e);
    for (int64_t i = 0; solid && i < solid->count; i++) {
        if (solid->colony[i] == SWC_SOMA) {
            solid->radius[i] = fmaxf(solid->radius[i], params->skin.curve_radius);
        }
    }
    bool done = solid && skeleton_dress(solid, params, placing->recipe, e) &&
                add_all(solid, params, placing, e);
    out_tree_free(solid);
    return done;
}
