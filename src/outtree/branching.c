#include "outtree/branching.h"

#include "base/memory.h"

#include <stdlib.h>

static void link_children(Branching *b, const OutTree *tree)
{
    for (int64_t i = 0; i < tree->count; i++) {
        b->first_child[i] = -1;
        b->children[i] = 0;
        b->terminals[i] = 0;
    }
    // In reverse order, every child is visited before its parent.
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        int32_t parent = tree->parent[i];
        b->terminals[i] = b->terminals[i] > 0 ? b->terminals[i] : 1;
        b->next_child[i] = -1;
        if (parent >= 0) {
            b->next_child[i] = b->first_child[parent];
            b->first_child[parent] = (int32_t)i;
            b->children[parent]++;
            b->terminals[parent] += b->terminals[i];
        }
    }
}

static void sum_paths(Branching *b, const OutTree *tree)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        b->root[i] = parent < 0 ? (int32_t)i : b->root[parent];
        b->path[i] = parent < 0 ? 0.0
                                : b->path[parent] + (double)vec3_distance(tree->position[i],
                                                                          tree->position[parent]);
    }
}

bool branching_init(Branching *b, const OutTree *tree, Error *e)
{
    int64_t n = tree->count;
    *b = (Branching){.first_child = memory_alloc(n, sizeof(int32_t), e),
                     .next_child = memory_alloc(n, sizeof(int32_t), e),
                     .children = memory_alloc(n, sizeof(int32_t), e),
                     .terminals = memory_alloc(n, sizeof(int32_t), e),
                     .root = memory_alloc(n, sizeof(int32_t), e),
                     .path = memory_alloc(n, sizeof(double), e)};
    if (!b->first_child || !b->next_child || !b->children || !b->terminals || !b->root ||
        !b->path) {
        branching_free(b);
        return false;
    }
    link_children(b, tree);
    sum_paths(b, tree);
    return true;
}

void branching_free(Branching *b)
{
    free(b->first_child);
    free(b->next_child);
    free(b->children);
    free(b->terminals);
    free(b->root);
    free(b->path);
    *b = (Branching){0};
}

int32_t branching_main_child(const Branching *b, const OutTree *tree, int32_t node)
{
    int32_t best = b->first_child[node];
    for (int32_t c = best; c >= 0; c = b->next_child[c]) {
        if (tree->radius[c] > tree->radius[best] ||
            (tree->radius[c] == tree->radius[best] && b->terminals[c] > b->terminals[best])) {
            best = c;
        }
    }
    return best;
}

Vec3 branching_direction_after(const Branching *b, const OutTree *tree, int32_t node, int32_t child,
                               int reach)
{
    int32_t end = child;
    for (int i = 1; i < reach && b->children[end] == 1; i++) {
        end = b->first_child[end];
    }
    return vec3_normalize(vec3_sub(tree->position[end], tree->position[node]));
}

Vec3 branching_direction_before(const Branching *b, const OutTree *tree, int32_t node, int reach)
{
    int32_t start = tree->parent[node];
    if (start < 0) {
        return vec3(0, 0, 0);
    }
    for (int i = 1; i < reach && b->children[start] == 1 && tree->parent[start] >= 0; i++) {
        start = tree->parent[start];
    }
    return vec3_normalize(vec3_sub(tree->position[node], tree->position[start]));
}
