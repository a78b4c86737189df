// The plan of a skin: the out-tree cut into chains (from each fork along the thickest child), each
// with a smooth axis, and where each chain leaves its parent's surface.
#ifndef RAMIFY_SKIN_PLAN_H
#define RAMIFY_SKIN_PLAN_H

#include "skin/skin.h"

// A sample of an axis; about half a radius from the next.
typedef struct SkinPoint {
    Vec3 position, tangent;
    Vec3 side;    // unit, across the tangent, turning as little as possible along the axis
    float along;  // m from the start of the axis
    float radius; // m
    float birth;  // 0..1
} SkinPoint;

typedef struct SkinChain {
    int32_t base;          // out-tree node it grows from, -1 at a root
    int32_t parent;        // chain whose surface it leaves, -1 at a root
    float attach;          // m along the parent's axis where its own axis starts
    int64_t first, count;  // its nodes: plan->node[first] ...
    int64_t axis, samples; // its axis: plan->point[axis] ...
    bool visible;          // false: all of it lies inside the parent
    bool has_children;     // visible ones leave it
    // Where a visible child comes out of its parent's surface:
    float exit_on_parent; // m along the parent's axis
    float exit;           // m along its own axis
    float start;          // m along its own axis: clear of the parent, first ring
    Vec3 exit_side;       // unit, across the parent's axis, towards the child
    float exit_sine;      // of the angle between the two axes
    float offset;         // m from the root to the start of the axis, for textures
    // Used while planning.
    int32_t first_child, next_sibling;
} SkinChain;

// A node of the chain at hand before its axis is made.
typedef struct SkinNode {
    Vec3 position;
    float along, radius, birth;
} SkinNode;

typedef struct SkinPlan {
    SkinChain *chain;
    int64_t chain_count, chain_capacity;
    int32_t *node; // nodes of all chains, chain by chain
    int64_t node_count;
    int32_t *chain_of; // per out-tree node; -1 = thinner than min_radius (or grown from such)
    int32_t *place;    // per out-tree node: where it stands in `node`
    SkinPoint *point;
    int64_t point_count, point_capacity;
    SkinNode *raw; // of the chain at hand
    int64_t raw_capacity;
    float least_radius;       // m: thinner nodes count as this thick, so that nothing is degenerate
    float thickest, thinnest; // m, of the nodes to skin
    float birth_scale;        // turns steps into 0..1
    const OutTree *tree;      // not owned
    SkinParams params;
} SkinPlan;

bool skin_plan_init(SkinPlan *plan, const OutTree *tree, const SkinParams *params, const Run *run,
                    Error *e); // on failure, too, clear it
void skin_plan_clear(SkinPlan *plan);

// Cuts the out-tree into chains (skin_chains.c); the first part of skin_plan_init.
bool skin_plan_chains(SkinPlan *plan, Error *e);

// Makes the axis of a chain whose parent has one (skin_axis.c). Where the axis folds back on
// itself, the rest of the chain becomes a new chain, a child of this one.
bool skin_plan_axis(SkinPlan *plan, int32_t chain, Error *e);

// The axis at a distance from its start, straight on beyond its ends.
SkinPoint skin_axis_at(const SkinPlan *plan, int32_t chain, float along);

// The sample at or before that distance.
int64_t skin_axis_sample(const SkinPlan *plan, int32_t chain, float along);

// The place on a chain's axis nearest to p, found by walking from *sample (which it updates);
// returns the distance along the axis.
float skin_axis_nearest(const SkinPlan *plan, int32_t chain, Vec3 p, int64_t *sample);

#endif
