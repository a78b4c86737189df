// Where one leaf stands on its twig and how it is turned.
#ifndef RAMIFY_OBJECTS_COMMON_LEAF_PLACE_H
#define RAMIFY_OBJECTS_COMMON_LEAF_PLACE_H

#include "objects/common/leaves.h"

// Where leaves turn their upper sides to.
typedef struct LeafLight {
    Vec3 center; // m: up, and away from this point, the middle of a crown
    // Unit direction at p, for plants on a surface; NULL = center is used.
    Vec3 (*facing)(const void *user, Vec3 p);
    const void *user;
} LeafLight;

// A place on a twig that bears leaves.
typedef struct LeafNode {
    Vec3 position;  // m, on the twig's axis
    Vec3 along;     // unit, toward the twig's tip
    Vec3 reference; // unit, across it: where azimuths about the twig begin
    float radius;   // m, of the twig
    int64_t number; // counted from the twig's tip
    float size;     // of its leaves, relative to those far from the tip
    float young;    // 0..1: how young its leaves are
    uint64_t key;
} LeafNode;

// The direction that azimuths about a twig begin from: `reference` made perpendicular to it, or
// level for leaves in two rows.
Vec3 leaf_reference(const LeavesParams *leaves, Vec3 reference, Vec3 along);

// Size of the leaves of node `number`, counted from the twig's tip, relative to those far from it.
float leaf_size_at(const LeavesParams *leaves, int64_t number);

// Size of the leaves of a node `distance` (m) from the lower end of the twig's leafy part, relative
// to those far from it. spacing: m, of the twig's nodes.
float leaf_size_above_base(const LeavesParams *leaves, float distance, float spacing);

// Key of leaf number k of the node.
uint64_t leaf_key(const LeafNode *node, int k);

// Placement of leaf number k of the node.
Transform leaf_place(const LeavesParams *leaves, const LeafNode *node, int k,
                     const LeafLight *light);

// Placement of a piece of twig with needles from `start` to `end` (m), toward the tip. reach: m,
// length of the mesh.
Transform leaf_place_piece(const LeavesParams *leaves, Vec3 start, Vec3 end, float reach,
                           uint64_t key);

#endif
