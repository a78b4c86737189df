#include "objects/sculpture/sculpture.h"

#include "base/memory.h"
#include "base/random.h"
#include "mesh/lattice.h"
#include "objects/common/starts.h"
#include "outtree/join.h"
#include "outtree/radii.h"

#include <stdlib.h>

enum { STREAM_ROOTS = 1, STREAM_CANDIDATES = 2, STREAM_GROWTH = 3 }; // of the object's seed

enum { CANDIDATES_A_ROOT = 60, SMOOTHING = 6, LEVELS = 2 };

#define VOXELS_A_BAR 3.0f // voxels of the surface's level set to the thinnest bar's radius
#define EXPONENT 3.0f     // of the pipe model, before radii are mapped onto the contrast

SculptureParams sculpture_params_default(void)
{
    SculptureParams params = {
        .clusters = 9, .attractors = 1800, .thickness = 0.42f, .contrast = 2.6f, .reach = 3.2f};
    params.element.points.place = SCATTER_SURFACE;
    params.element.points.pattern = SCATTER_POISSON;
    params.element.growth.max_children = 2;
    params.element.growth.noise = 0.12f;
    params.element.growth.field_weight = 1.0f;
    return params;
}

// Coarse bars first, then finer ones between them.
static void fill_levels(GrowLevel levels[LEVELS], int64_t attractors, float noise)
{
    levels[0] = (GrowLevel){.attractors = attractors / 9 > 0 ? attractors / 9 : 1,
                            .step = 0.15f,
                            .kill = 0.7f,
                            .influence = 3.5f,
                            .scale = 1.0f,
                            .noise = noise,
                            .relax = 0.5f};
    levels[1] = (GrowLevel){.attractors = attractors,
                            .step = 0.3f,
                            .kill = 0.9f,
                            .influence = 2.5f,
                            .scale = 1.0f,
                            .noise = noise,
                            .relax = 0.5f};
}

// Roots on the surface; *spacing = mean spacing of as many attractors as the finest level has.
static bool plant_roots(OutTree *tree, const SculptureParams *params, const ElementParams *element,
                        const Recipe *recipe, double *spacing, Error *e)
{
    Envelope *envelope = element_envelope(element, recipe->run, e);
    if (!envelope) {
        return false;
    }
    ScatterParams scatter = scatter_params_default();
    scatter.place = SCATTER_SURFACE;
    scatter.count = (int64_t)params->clusters * CANDIDATES_A_ROOT;
    scatter.seed = random_key(recipe->seed, STREAM_CANDIDATES);
    PointSet *points = points_scatter(envelope, &scatter, recipe->run, e);
    bool done = points && starts_spread(tree, points, vec3(0, -1, 0), params->clusters,
                                        random_key(recipe->seed, STREAM_ROOTS), recipe->run, e);
    if (done) {
        const GrowLevel *finest = &element->levels[element->level_count - 1];
        *spacing = sqrt(points->measure / (double)finest->attractors);
    }
    points_free(points);
    envelope_free(envelope);
    return done;
}

// A bar that closes a loop has the radius of its parent.
static void compute_radii(OutTree *tree, int64_t grown, float thin, float contrast)
{
    int64_t all = tree->count;
    tree->count = grown;
    out_tree_pipe_radii(tree, EXPONENT, thin, contrast > 1.0f ? contrast * thin : 0.0f);
    tree->count = all;
    for (int64_t i = grown; i < all; i++) {
        tree->radius[i] = tree->radius[tree->parent[i]];
    }
}

static bool grow_shell(OutTree *tree, const SculptureParams *params, const ElementParams *element,
                       const Recipe *recipe, Error *e)
{
    double spacing;
    if (!plant_roots(tree, params, element, recipe, &spacing, e) ||
        !element_grow(tree, element, random_key(recipe->seed, STREAM_GROWTH), recipe, NULL, e)) {
        return false;
    }
    JoinParams join = {.reach = params->reach * (float)spacing,
                       .least_path = 3.0f * params->reach * (float)spacing,
                       .least_cosine = -0.5f,
                       .all_one = true};
    int64_t grown = tree->count;
    if (!out_tree_join_tips(tree, &join, NULL, recipe->run, e)) {
        return false;
    }
    compute_radii(tree, grown, 0.5f * params->thickness * (float)spacing, params->contrast);
    return true;
}

bool sculpture_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const SculptureParams *params = given;
    Shape ball = {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()};
    GrowLevel levels[LEVELS];
    ElementParams element = params->element;
    element.points.place = SCATTER_SURFACE;
    if (element.shape_count == 0) {
        element.shapes = &ball;
        element.shape_count = 1;
    }
    if (element.level_count == 0) {
        fill_levels(levels, params->attractors, element.growth.noise);
        element.levels = levels;
        element.level_count = LEVELS;
    }
    whole->tree = out_tree_new(e);
    return whole->tree && grow_shell(whole->tree, params, &element, recipe, e);
}

bool sculpture_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e)
{
    (void)params;
    const OutTree *tree = grown->tree;
    float thinnest = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        thinnest = tree->radius[i] < thinnest ? tree->radius[i] : thinnest;
    }
    Lattice lattice = {0};
    Mesh *mesh =
        lattice_add_tree(&lattice, tree, e)
            ? lattice_surface(&lattice, thinnest / VOXELS_A_BAR, SMOOTHING, placing->recipe->run, e)
            : NULL;
    lattice_clear(&lattice);
    return placing_add(placing, (Part){.mesh = mesh}, 0, e);
}
