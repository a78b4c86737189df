#include "outtree/out_tree.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>
#include <string.h>

OutTree *out_tree_new(Error *e)
{
    return memory_alloc_zero(1, sizeof(OutTree), e);
}

void out_tree_free(OutTree *tree)
{
    if (tree) {
        free(tree->position);
        free(tree->parent);
        free(tree->birth);
        free(tree->colony);
        free(tree->radius);
        free(tree->normal);
        free(tree->id);
        free(tree);
    }
}

bool out_tree_reserve(OutTree *tree, int64_t count, Error *e)
{
    if (count <= tree->capacity) {
        return true;
    }
    if (count > INT32_MAX) {
        return error_set(e, ERROR_MEMORY, "an out-tree of %lld nodes; fewer than 2^31 are possible",
                         (long long)count);
    }
    // All arrays start from the same capacity and grow by the same rule, so they stay equally long.
    int64_t capacity[7];
    for (int i = 0; i < 7; i++) {
        capacity[i] = tree->capacity;
    }
    bool grown = memory_reserve(&tree->position, &capacity[0], count, sizeof(Vec3), e) &&
                 memory_reserve(&tree->parent, &capacity[1], count, sizeof(int32_t), e) &&
                 memory_reserve(&tree->birth, &capacity[2], count, sizeof(int32_t), e) &&
                 memory_reserve(&tree->colony, &capacity[3], count, sizeof(int32_t), e) &&
                 memory_reserve(&tree->radius, &capacity[4], count, sizeof(float), e) &&
                 memory_reserve(&tree->normal, &capacity[5], count, sizeof(Vec3), e) &&
                 memory_reserve(&tree->id, &capacity[6], count, sizeof(uint64_t), e);
    if (grown) {
        tree->capacity = capacity[6];
    }
    return grown;
}

OutTree *out_tree_copy(const OutTree *tree, Error *e)
{
    OutTree *copy = out_tree_new(e);
    if (!copy || !out_tree_reserve(copy, tree->count, e)) {
        out_tree_free(copy);
        return NULL;
    }
    size_t n = (size_t)tree->count;
    if (n > 0) {
        memcpy(copy->position, tree->position, n * sizeof(Vec3));
        memcpy(copy->parent, tree->parent, n * sizeof(int32_t));
        memcpy(copy->birth, tree->birth, n * sizeof(int32_t));
        memcpy(copy->colony, tree->colony, n * sizeof(int32_t));
        memcpy(copy->radius, tree->radius, n * sizeof(float));
        memcpy(copy->normal, tree->normal, n * sizeof(Vec3));
        memcpy(copy->id, tree->id, n * sizeof(uint64_t));
    }
    copy->count = tree->count;
    copy->typed = tree->typed;
    copy->scanned = tree->scanned;
    return copy;
}

int64_t out_tree_add_node(OutTree *tree, Vec3 position, int64_t parent, int32_t birth,
                          int32_t colony, uint64_t id, Error *e)
{
    if (parent < -1 || parent >= tree->count) {
        error_set(e, ERROR_INTERNAL, "node %lld named parent %lld; a parent comes before its child",
                  (long long)tree->count, (long long)parent);
        return -1;
    }
    if (!out_tree_reserve(tree, tree->count + 1, e)) {
        return -1;
    }
    int64_t i = tree->count++;
    tree->position[i] = position;
    tree->parent[i] = (int32_t)parent;
    tree->birth[i] = birth;
    tree->colony[i] = colony;
    tree->radius[i] = 0.0f;
    tree->normal[i] = vec3(0, 1, 0);
    tree->id[i] = id;
    return i;
}

int64_t out_tree_copy_node(OutTree *tree, int64_t parent, const OutTree *from, int64_t i, Error *e)
{
    int64_t node = out_tree_add_node(tree, from->position[i], parent, from->birth[i],
                                     from->colony[i], from->id[i], e);
    if (node >= 0) {
        tree->radius[node] = from->radius[i];
        tree->normal[node] = from->normal[i];
    }
    return node;
}

uint64_t out_tree_child_id(uint64_t parent_id, int64_t place)
{
    return random_key(parent_id, (uint64_t)place);
}

static void move_node(OutTree *tree, int64_t from, int64_t to)
{
    tree->position[to] = tree->position[from];
    tree->parent[to] = tree->parent[from];
    tree->birth[to] = tree->birth[from];
    tree->colony[to] = tree->colony[from];
    tree->radius[to] = tree->radius[from];
    tree->normal[to] = tree->normal[from];
    tree->id[to] = tree->id[from];
}

bool out_tree_keep_nodes(OutTree *tree, const bool *keep, Error *e)
{
    // new index of each kept node, or -1
    int32_t *place = memory_alloc(tree->count, sizeof *place, e);
    if (!place) {
        return false;
    }
    int32_t kept = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool stays = keep[i] && (parent < 0 || place[parent] >= 0);
        place[i] = stays ? kept : -1;
        if (stays) {
            move_node(tree, i, kept);
            tree->parent[kept++] = parent < 0 ? -1 : place[parent];
        }
    }
    tree->count = kept;
    free(place);
    return true;
}

bool out_tree_append(OutTree *tree, const OutTree *other, Error *e)
{
    int32_t base = (int32_t)tree->count;
    if (!out_tree_reserve(tree, tree->count + other->count, e)) {
        return false;
    }
    for (int64_t i = 0; i < other->count; i++) {
        int64_t at = tree->count++;
        tree->position[at] = other->position[i];
        tree->parent[at] = other->parent[i] < 0 ? -1 : base + other->parent[i];
        tree->birth[at] = other->birth[i];
        tree->colony[at] = other->colony[i];
        tree->radius[at] = other->radius[i];
        tree->normal[at] = other->normal[i];
        tree->id[at] = other->id[i];
    }
    return true;
}

int32_t out_tree_last_birth(const OutTree *tree)
{
    int32_t last = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        last = tree->birth[i] > last ? tree->birth[i] : last;
    }
    return last;
}

int32_t *out_tree_count_children(const OutTree *tree, Error *e)
{
    int32_t *children = memory_alloc_zero(tree->count, sizeof *children, e);
    for (int64_t i = 0; children && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            children[tree->parent[i]]++;
        }
    }
    return children;
}

bool out_tree_keep_births(OutTree *tree, float share, Error *e)
{
    if (share >= 1.0f) {
        return true;
    }
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    if (!keep) {
        return false;
    }
    double limit = (double)share * out_tree_last_birth(tree);
    for (int64_t i = 0; i < tree->count; i++) {
        keep[i] = tree->birth[i] <= limit;
    }
    bool done = out_tree_keep_nodes(tree, keep, e);
    free(keep);
    return done;
}

bool out_tree_rejuvenate(OutTree *tree, float share, float tip_radius, Error *e)
{
    if (share >= 1.0f) {
        return true;
    }
    double last = out_tree_last_birth(tree), now = (double)share * last;
    if (!out_tree_keep_births(tree, share, e)) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        double lifetime = last - (double)tree->birth[i];
        float age = lifetime > 0.0 ? (float)((now - (double)tree->birth[i]) / lifetime) : 0.0f;
        float thin = fminf(tip_radius, tree->radius[i]);
        tree->radius[i] = lerpf(thin, tree->radius[i], age * (2.0f - age));
    }
    return true;
}

bool out_tree_check(const OutTree *tree, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] < -1 || tree->parent[i] >= i) {
            return error_set(e, ERROR_INTERNAL,
                             "node %lld has parent %d; it must be -1 or come before the node",
                             (long long)i, tree->parent[i]);
        }
        if (!vec3_finite(tree->position[i]) || !vec3_finite(tree->normal[i])) {
            return error_set(e, ERROR_INTERNAL, "node %lld has a position or normal not finite",
                             (long long)i);
        }
        if (!isfinite(tree->radius[i]) || tree->radius[i] < 0.0f) {
            return error_set(e, ERROR_INTERNAL, "node %lld has radius %g; it must be 0 or more",
                             (long long)i, (double)tree->radius[i]);
        }
    }
    return true;
}

Aabb out_tree_bounds(const OutTree *tree)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < tree->count; i++) {
        box = aabb_add(box, tree->position[i]);
    }
    return box;
}

static uint64_t float_bits(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

uint64_t out_tree_hash(const OutTree *tree)
{
    uint64_t hash = random_mix((uint64_t)tree->count);
    for (int64_t i = 0; i < tree->count; i++) {
        hash = random_key(hash, float_bits(tree->position[i].x));
        hash = random_key(hash, float_bits(tree->position[i].y));
        hash = random_key(hash, float_bits(tree->position[i].z));
        hash = random_key(hash, float_bits(tree->radius[i]));
        hash =
            random_key(hash, (uint64_t)(uint32_t)tree->parent[i] << 32 | (uint32_t)tree->birth[i]);
        hash = random_key(hash, (uint32_t)tree->colony[i]);
    }
    return hash;
}
