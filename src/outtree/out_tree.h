// The out-tree: what growth makes and everything after it reads. Structure of arrays, one entry a
// node. Invariants (out_tree_check): parent[i] < i, parent[i] == -1 exactly at roots, all numbers
// finite, radius >= 0.
#ifndef RAMIFY_OUTTREE_OUT_TREE_H
#define RAMIFY_OUTTREE_OUT_TREE_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct OutTree {
    int64_t count, capacity; // nodes, at most 2^31 - 1
    Vec3 *position;          // m
    int32_t *parent;         // index, -1 at a root
    int32_t *birth;          // growth step at which the node appeared; 0 for initial nodes
    int32_t *colony; // which root's colony (or which element of a tree: trunk, branches, roots) it
                     // belongs to
    float *radius;   // m; 0 until radii are computed
    Vec3
        *normal; // unit: across the node's direction, or the surface normal for growth on a surface
    uint64_t *id; // stable name: hash of the parent's id and its place among its siblings
    bool typed;   // colonies are types as SWC has them (SwcType), which writing one keeps
} OutTree;

OutTree *out_tree_new(Error *e);
void out_tree_free(OutTree *tree); // NULL is fine
OutTree *out_tree_copy(const OutTree *tree, Error *e);

bool out_tree_reserve(OutTree *tree, int64_t count, Error *e);

// Appends a node and returns its index, or -1 and e. Radius 0, normal (0, 1, 0). The id names the
// node for ever: out_tree_child_id for a child, anything stable (a hash of the seed and the root's
// number) for a root.
int64_t out_tree_add_node(OutTree *tree, Vec3 position, int64_t parent, int32_t birth,
                          int32_t colony, uint64_t id, Error *e);

// The id of a parent's child number place (0 for the first).
uint64_t out_tree_child_id(uint64_t parent_id, int64_t place);

// Drops the nodes for which keep is false, with all that grew from them. Keeps the order.
bool out_tree_keep_nodes(OutTree *tree, const bool *keep, Error *e);

// Drops the nodes born after `share` (0..1) of the last birth: the tree as it was at that time of
// its growth. Keeps the order; 1 or more changes nothing.
bool out_tree_keep_births(OutTree *tree, float share, Error *e);

// Adds all nodes of another out-tree after those of `tree`; its roots stay roots.
bool out_tree_append(OutTree *tree, const OutTree *other, Error *e);

// The last birth; 0 when there are no nodes.
int32_t out_tree_last_birth(const OutTree *tree);

// The tree with radii as it was at `share` (0..1) of its growth: drops the younger nodes as
// out_tree_keep_births does, and thins the others by their youth, from tip_radius (m) where a node
// has just appeared to its own radius at the end: fast at first, so that nothing pops into being or
// stays a bare rod for long. Radii keep their order along the branches. 1 or more changes nothing.
bool out_tree_rejuvenate(OutTree *tree, float share, float tip_radius, Error *e);

// Checks every invariant; the error names the first node that breaks one.
bool out_tree_check(const OutTree *tree, Error *e);

Aabb out_tree_bounds(const OutTree *tree);

// A 64-bit hash over positions, parents, births, colonies and radii: equal trees, equal hashes.
uint64_t out_tree_hash(const OutTree *tree);

#endif
