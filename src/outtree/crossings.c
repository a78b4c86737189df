#include "outtree/crossings.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

// Segments hashed by the cell of their midpoint. Cells are as wide as the longest segment, so
// crossing segments are in the same or in neighbouring cells.
typedef struct SegmentGrid {
    const OutTree *tree;
    float inverse_cell; // 1/m
    int32_t *head;      // by hash of the cell: the last node put in, -1
    int32_t *next;      // by node
    uint64_t mask;
} SegmentGrid;

static float across(Vec3 a, Vec3 b, Vec3 c, Vec3 normal)
{
    return vec3_dot(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), normal);
}

// Do the segments a0-a1 and b0-b1 cross, seen along the normal? Touching ends count.
static bool segments_cross(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1, Vec3 normal)
{
    float p = across(a0, a1, b0, normal), q = across(a0, a1, b1, normal);
    float r = across(b0, b1, a0, normal), s = across(b0, b1, a1, normal);
    return p * q <= 0.0f && r * s <= 0.0f && (p != 0.0f || q != 0.0f || r != 0.0f || s != 0.0f);
}

static Vec3 middle_of(const OutTree *tree, int32_t node)
{
    return vec3_lerp(tree->position[node], tree->position[tree->parent[node]], 0.5f);
}

static int64_t cell_of(float x, float inverse_cell)
{
    float c = x * inverse_cell;
    int64_t whole = (int64_t)c;
    return (float)whole > c ? whole - 1 : whole;
}

static uint64_t bucket(const SegmentGrid *grid, int64_t x, int64_t y, int64_t z)
{
    uint64_t key = random_key((uint64_t)x, (uint64_t)y);
    return random_key(key, (uint64_t)z) & grid->mask;
}

static bool crosses(const SegmentGrid *grid, int32_t node)
{
    const OutTree *tree = grid->tree;
    int32_t parent = tree->parent[node];
    Vec3 m = middle_of(tree, node), a = tree->position[parent], b = tree->position[node];
    int64_t x = cell_of(m.x, grid->inverse_cell), y = cell_of(m.y, grid->inverse_cell);
    int64_t z = cell_of(m.z, grid->inverse_cell);
    for (int k = 0; k < 27; k++) {
        uint64_t place = bucket(grid, x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1);
        for (int32_t i = grid->head[place]; i >= 0; i = grid->next[i]) {
            int32_t other = tree->parent[i];
            bool joined = i == parent || other == parent || other == node;
            Vec3 d = vec3_sub(middle_of(tree, i), m);
            bool near = vec3_dot(d, d) * grid->inverse_cell * grid->inverse_cell <= 1.0f;
            if (!joined && near &&
                segments_cross(a, b, tree->position[other], tree->position[i],
                               tree->normal[node])) {
                return true;
            }
        }
    }
    return false;
}

static void put_in(SegmentGrid *grid, int32_t node)
{
    Vec3 m = middle_of(grid->tree, node);
    uint64_t place = bucket(grid, cell_of(m.x, grid->inverse_cell),
                            cell_of(m.y, grid->inverse_cell), cell_of(m.z, grid->inverse_cell));
    grid->next[node] = grid->head[place];
    grid->head[place] = node;
}

static bool grid_init(SegmentGrid *grid, const OutTree *tree, Error *e)
{
    float longest = 1e-30f;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            float length = vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
            longest = length > longest ? length : longest;
        }
    }
    uint64_t buckets = 64;
    while (buckets < (uint64_t)tree->count) {
        buckets *= 2;
    }
    *grid = (SegmentGrid){.tree = tree, .inverse_cell = 1.0f / longest, .mask = buckets - 1};
    grid->head = memory_alloc((int64_t)buckets, sizeof *grid->head, e);
    grid->next = memory_alloc(tree->count, sizeof *grid->next, e);
    for (uint64_t i = 0; grid->head && i < buckets; i++) {
        grid->head[i] = -1;
    }
    return grid->head && grid->next;
}

// The nodes in order of birth, then of index.
static bool sort_by_birth(const OutTree *tree, int32_t *order, Error *e)
{
    int32_t last = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        last = tree->birth[i] > last ? tree->birth[i] : last;
    }
    int64_t *begin = memory_alloc_zero((int64_t)last + 2, sizeof *begin, e);
    if (!begin) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        begin[tree->birth[i] + 1]++;
    }
    for (int32_t b = 0; b <= last; b++) {
        begin[b + 1] += begin[b];
    }
    for (int64_t i = 0; i < tree->count; i++) {
        order[begin[tree->birth[i]]++] = (int32_t)i;
    }
    free(begin);
    return true;
}

static bool mark(SegmentGrid *grid, const int32_t *order, bool *keep, const Run *run, Error *e)
{
    const OutTree *tree = grid->tree;
    for (int64_t k = 0; k < tree->count; k++) {
        int32_t node = order[k], parent = tree->parent[node];
        if ((k & 4095) == 0 && run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        keep[node] = parent < 0 || (keep[parent] && !crosses(grid, node));
        if (keep[node] && parent >= 0) {
            put_in(grid, node);
        }
    }
    return true;
}

bool out_tree_drop_crossings(OutTree *tree, const Run *run, Error *e)
{
    SegmentGrid grid = {0};
    int32_t *order = memory_alloc(tree->count, sizeof *order, e);
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    bool done = order && keep && grid_init(&grid, tree, e) && sort_by_birth(tree, order, e) &&
                mark(&grid, order, keep, run, e) && out_tree_keep_nodes(tree, keep, e);
    free(order);
    free(keep);
    free(grid.head);
    free(grid.next);
    return done;
}
