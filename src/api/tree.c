#include "api/handles.h"

#include "outtree/out_tree_io.h"

#include <string.h>

static RamifyTree *hand_tree(OutTree *tree, const Error *e, RamifyError *error)
{
    if (!tree) {
        api_fail(error, e);
    }
    return (RamifyTree *)(void *)tree;
}

RamifyTree *ramify_grow(const RamifyScene *scene, int index, const RamifyRun *run,
                        RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    return hand_tree(scene_grow_object(scene_of(scene), index, &own, &e), &e, error);
}

RamifyTree *ramify_tree_read(const char *file, const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    return hand_tree(out_tree_import(file, &own, &e), &e, error);
}

bool ramify_tree_write(const RamifyTree *tree, const char *file, RamifyError *error)
{
    Error e = {0};
    return out_tree_write(tree_of(tree), file, &e) || api_fail(error, &e);
}

void ramify_tree_free(RamifyTree *tree)
{
    out_tree_free((OutTree *)(void *)tree);
}

int64_t ramify_tree_count(const RamifyTree *tree)
{
    return tree_of(tree)->count;
}

_Static_assert(sizeof(Vec3) == 3 * sizeof(float), "vectors are plain triples");

const float *ramify_tree_positions(const RamifyTree *tree)
{
    return &tree_of(tree)->position->x;
}

const int32_t *ramify_tree_parents(const RamifyTree *tree)
{
    return tree_of(tree)->parent;
}

const float *ramify_tree_radii(const RamifyTree *tree)
{
    return tree_of(tree)->radius;
}

const int32_t *ramify_tree_births(const RamifyTree *tree)
{
    return tree_of(tree)->birth;
}

const int32_t *ramify_tree_colonies(const RamifyTree *tree)
{
    return tree_of(tree)->colony;
}

const float *ramify_tree_normals(const RamifyTree *tree)
{
    return &tree_of(tree)->normal->x;
}

const uint64_t *ramify_tree_ids(const RamifyTree *tree)
{
    return tree_of(tree)->id;
}

void ramify_tree_bounds(const RamifyTree *tree, float *low, float *high)
{
    Aabb box = out_tree_bounds(tree_of(tree));
    memcpy(low, &box.low, sizeof box.low);
    memcpy(high, &box.high, sizeof box.high);
}

uint64_t ramify_tree_hash(const RamifyTree *tree)
{
    return out_tree_hash(tree_of(tree));
}
