#include "objects/dla/dla.h"

#include "base/noise.h"
#include "base/random.h"
#include "grow/aggregate/dla.h"
#include "mesh/lattice.h"
#include "outtree/radii.h"

#include <stddef.h>

enum { STREAM_GROWTH = 1, STREAM_HEAVE = 2 }; // of the object's seed

enum { SMOOTHING = 4 };

#define VOXELS_A_TIP 2.2f // voxels of the surface's level set to a tip's radius

DlaModel dla_model_default(void)
{
    return (DlaModel){.size = 1.0f,
                      .dimension = 2,
                      .particles = 40000,
                      .thickness = 1.0f,
                      .exponent = 7.0f,
                      .swell = 3.0f};
}

// Moves every particle half-way to its parent, twice: the chains' zigzag is that of the particles'
// size, which metal does not show.
static void relax(OutTree *tree)
{
    for (int pass = 0; pass < 2; pass++) {
        for (int64_t i = tree->count - 1; i > 0; i--) {
            tree->position[i] = vec3_lerp(tree->position[i], tree->position[tree->parent[i]], 0.5f);
        }
    }
}

static float largest_extent(const OutTree *tree)
{
    Aabb box = out_tree_bounds(tree);
    Vec3 extent = vec3_sub(box.high, box.low);
    float most = extent.x > extent.y ? extent.x : extent.y;
    return most > extent.z ? most : extent.z;
}

// Displaces a plane cluster (of unit particles) out of its plane by smooth noise.
static void heave(OutTree *tree, float swell, uint64_t seed)
{
    float extent = largest_extent(tree), wave = 6.0f / (extent > 1.0f ? extent : 1.0f);
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 *p = &tree->position[i];
        p->z += 2.0f * swell * noise_plane_fractal(p->x * wave, p->y * wave, 4, seed);
    }
}

bool dla_model_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const DlaModel *params = given;
    DlaParams grow = dla_params_default();
    grow.dimension = params->dimension;
    grow.count = params->particles;
    grow.seed = random_key(recipe->seed, STREAM_GROWTH);
    OutTree *tree = whole->tree = dla_grow(&grow, recipe->run, e);
    if (!tree) {
        return false;
    }
    relax(tree);
    float extent = largest_extent(tree), scale = params->size / (extent > 1.0f ? extent : 1.0f);
    if (params->dimension == 2) {
        heave(tree, params->swell, random_key(recipe->seed, STREAM_HEAVE));
    }
    Transform place = transform_compose(params->position, params->rotation, vec3_splat(scale));
    Transform turn = transform_compose(vec3(0, 0, 0), params->rotation, vec3_splat(1.0f));
    for (int64_t i = 0; i < tree->count; i++) {
        tree->position[i] = transform_point(&place, tree->position[i]);
        tree->normal[i] = transform_vector(&turn, tree->normal[i]);
        tree->radius[i] = 0.5f * params->thickness * scale; // at birth every node is a tip
    }
    return true;
}

bool dla_model_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                      Error *e)
{
    (void)recipe, (void)whole, (void)e;
    const DlaModel *params = given;
    OutTree *tree = grown->tree;
    out_tree_pipe_radii(tree, params->exponent, tree->count > 0 ? tree->radius[0] : 0.0f, 0.0f);
    return true;
}

static float thinnest(const OutTree *tree)
{
    float least = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        least = tree->radius[i] < least ? tree->radius[i] : least;
    }
    return least;
}

bool dla_model_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e)
{
    (void)params;
    Lattice lattice = {0};
    Mesh *mesh = lattice_add_tree(&lattice, grown->tree, e)
                     ? lattice_surface(&lattice, thinnest(grown->tree) / VOXELS_A_TIP, SMOOTHING,
                                       placing->recipe->run, e)
                     : NULL;
    lattice_clear(&lattice);
    return placing_add(placing, (Part){.mesh = mesh}, 0, e);
}
