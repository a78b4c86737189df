// Out-trees that the user brings: SWC files and painted lines.
#include "base/memory.h"
#include "base/random.h"
#include "objects/common/grey.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/trace.h"
#include "outtree/out_tree_io.h"

#include <stdlib.h>

static OutTree *read_file(const TreeSource *source, const Run *run, Error *e)
{
    OutTree *tree = out_tree_import_swc(source->file, run, e);
    for (int64_t i = 0; tree && i < tree->count; i++) {
        Vec3 p = tree->position[i];
        tree->position[i] = vec3(source->scale * p.x, 0.0f, source->scale * p.z);
        tree->radius[i] *= source->scale;
        tree->normal[i] = vec3(0, 1, 0);
    }
    if (tree) {
        tree->typed = false;
    }
    return tree;
}

static OutTree *read_picture(const TreeSource *source, float size, TreeUse use, uint64_t seed,
                             const Run *run, Error *e)
{
    Image *grey = grey_read(source->image, run, e);
    if (!grey) {
        return NULL;
    }
    float x = size / (float)grey->width, z = size / (float)grey->height;
    OutTree *tree = trace_lines(grey, source->invert, use == TREE_DRAINS ? TRACE_RIM : TRACE_WIDEST,
                                seed, run, e);
    image_free(grey);
    for (int64_t i = 0; tree && i < tree->count; i++) {
        Vec3 p = tree->position[i];
        tree->position[i] = vec3(x * p.x - 0.5f * size, 0.0f, z * p.z - 0.5f * size);
        tree->radius[i] *= 0.5f * (x + z);
        tree->normal[i] = vec3(0, 1, 0);
    }
    return tree;
}

static bool lies_within(const OutTree *tree, float size)
{
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        if (fabsf(p.x) <= 0.5f * size && fabsf(p.z) <= 0.5f * size) {
            return true;
        }
    }
    return false;
}

// ---- rivers

static Vec3 nearest_border(Vec3 p, float half)
{
    bool east = fabsf(p.x) > fabsf(p.z);
    return east ? vec3(p.x < 0.0f ? -half : half, 0.0f, p.z)
                : vec3(p.x, 0.0f, p.z < 0.0f ? -half : half);
}

// Adds pieces of at most `step` from the node `lower` to `to`; the last one has the birth and
// colony of node i. Returns the last node, or -1.
static int64_t add_pieces(OutTree *tree, int64_t lower, Vec3 to, const OutTree *from, int64_t i,
                          float step, Error *e)
{
    Vec3 a = tree->position[lower];
    float length = vec3_distance(a, to);
    int pieces = length > step ? 1 + (int)(length / step) : 1;
    for (int k = 1; k <= pieces && lower >= 0; k++) {
        Vec3 p = k == pieces ? to : vec3_lerp(a, to, (float)k / (float)pieces);
        uint64_t id = k == pieces ? from->id[i] : random_key(from->id[i], (uint64_t)k);
        lower = out_tree_add_node(tree, p, lower, from->birth[i], from->colony[i], id, e);
    }
    return lower;
}

static int64_t add_river_node(OutTree *tree, const OutTree *from, int64_t i, int64_t lower,
                              float size, Error *e)
{
    float half = 0.5f * size, step = size / 200.0f;
    Vec3 p = from->position[i];
    p = vec3(clampf(p.x, -half, half), 0.0f, clampf(p.z, -half, half));
    if (lower >= 0) {
        return add_pieces(tree, lower, p, from, i, step, e);
    }
    Vec3 border = nearest_border(p, half);
    if (vec3_distance(border, p) < 0.001f * size) {
        return out_tree_add_node(tree, border, -1, 0, from->colony[i], from->id[i], e);
    }
    lower = out_tree_add_node(tree, border, -1, 0, from->colony[i], random_key(from->id[i], 0), e);
    return lower < 0 ? -1 : add_pieces(tree, lower, p, from, i, step, e);
}

// A copy whose roots lie on the terrain's border, with pieces short enough for drainage areas to
// grow along them. Radii are left to the rivers' water.
static OutTree *as_rivers(const OutTree *from, float size, Error *e)
{
    OutTree *tree = out_tree_new(e);
    int64_t *place = memory_alloc(from->count, sizeof *place, e);
    bool done = tree && place;
    for (int64_t i = 0; done && i < from->count; i++) {
        int64_t lower = from->parent[i] < 0 ? -1 : place[from->parent[i]];
        place[i] = add_river_node(tree, from, i, lower, size, e);
        done = place[i] >= 0;
    }
    free(place);
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

OutTree *terrain_read_tree(const TerrainParams *params, const TreeSource *source, TreeUse use,
                           const Recipe *recipe, Error *e)
{
    OutTree *tree = source->file
                        ? read_file(source, recipe->run, e)
                        : read_picture(source, params->size, use, recipe->seed, recipe->run, e);
    if (tree && !lies_within(tree, params->size)) {
        error_set(e, ERROR_INPUT,
                  "'%s' has no node within the terrain's %g m about the origin; change its scale",
                  source->file ? source->file : source->image, (double)params->size);
        out_tree_free(tree);
        return NULL;
    }
    if (!tree || use == TREE_RISES) {
        return tree;
    }
    OutTree *rivers = as_rivers(tree, params->size, e);
    out_tree_free(tree);
    return rivers;
}
