// The out-tree: the result of growth, read by everything after it. Structure of arrays, one entry
// per node. Invariants (out_tree_check): parent[i] < i, parent[i] == -1 exactly at roots, all
// numbers finite, radius >= 0.
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
    int32_t *colony; // colony (of a root), or element of a tree (trunk, branches, roots), that the
                     // node belongs to
    float *radius;   // m; 0 until radii are computed
    // unit: perpendicular to the node's direction, or the surface normal for growth on a surface
    Vec3 *normal;
    uint64_t *id; // stable: hash of the parent's id and the index among its siblings
    bool typed;   // colonies are SWC types (SwcType), which writers keep
    bool scanned; // the wood of a tree that was scanned, standing on the ground at height 0
} OutTree;

OutTree *out_tree_new(Error *e);
void out_tree_free(OutTree *tree); // NULL is fine
OutTree *out_tree_copy(const OutTree *tree, Error *e);

bool out_tree_reserve(OutTree *tree, int64_t count, Error *e);

// Appends a node and returns its index, or -1 and e. Radius 0, normal (0, 1, 0). The id is the
// node's permanent name: out_tree_child_id for a child, any stable hash (of the seed and the root's
// number) for a root.
int64_t out_tree_add_node(OutTree *tree, Vec3 position, int64_t parent, int32_t birth,
                          int32_t colony, uint64_t id, Error *e);

// Appends a copy of node i of another tree under this parent; returns its index, or -1 and e.
int64_t out_tree_copy_node(OutTree *tree, int64_t parent, const OutTree *from, int64_t i, Error *e);

// Id of a parent's child number place (0 for the first).
uint64_t out_tree_child_id(uint64_t parent_id, int64_t place);

// Removes the nodes for which keep is false, with all their descendants. Keeps the order.
bool out_tree_keep_nodes(OutTree *tree, const bool *keep, Error *e);

// Removes the nodes born after `share` (0..1) of the last birth, giving the tree at that stage of
// its growth. Keeps the order; 1 or more changes nothing.
bool out_tree_keep_births(OutTree *tree, float share, Error *e);

// Appends all nodes of another out-tree; its roots stay roots.
bool out_tree_append(OutTree *tree, const OutTree *other, Error *e);

// The latest birth; 0 when there are no nodes.
int32_t out_tree_last_birth(const OutTree *tree);

// Number of children of each node: tree->count numbers, which the caller frees.
int32_t *out_tree_count_children(const OutTree *tree, Error *e);

// Reduces a tree with radii to `share` (0..1) of its growth: removes the younger nodes as
// out_tree_keep_births does and thins the others by age, from tip_radius (m) at birth to the final
// radius, fast at first, so that branches neither pop up nor stay thin for long. Radii keep their
// order along the branches. 1 or more changes nothing.
bool out_tree_rejuvenate(OutTree *tree, float share, float tip_radius, Error *e);

// Checks every invariant; the error names the first node that violates one.
bool out_tree_check(const OutTree *tree, Error *e);

Aabb out_tree_bounds(const OutTree *tree);

// 64-bit hash of positions, parents, births, colonies and radii.
uint64_t out_tree_hash(const OutTree *tree);

#endif
