// The plan of a skin: the out-tree decomposed into chains (from each fork along the thickest
// child), each with a smooth axis, and where each chain leaves its parent's surface.
#ifndef RAMIFY_SKIN_PLAN_H
#define RAMIFY_SKIN_PLAN_H

#include "skin/skin.h"

// A sample of an axis; samples are about half a radius apart.
typedef struct SkinPoint {
    Vec3 position, tangent;
    Vec3 side;    // unit, perpendicular to the tangent; rotation-minimising along the axis
    float along;  // m from the start of the axis
    float radius; // m
    float birth;  // 0..1
} SkinPoint;

typedef struct SkinChain {
    int32_t base;          // out-tree node it grows from, -1 at a root
    int32_t parent;        // chain whose surface it leaves, -1 at a root
    float attach;          // m along the parent's axis where its own axis starts
    int64_t first, count;  // range of its nodes in plan->node
    int64_t axis, samples; // range of its axis in plan->point
    bool visible;          // false: entirely inside the parent
    bool has_children;     // visible children leave it
    // Where a visible child leaves its parent's surface:
    float exit_on_parent; // m along the parent's axis
    float exit;           // m along its own axis
    float start;          // m along its own axis to the first ring, clear of the parent
    Vec3 exit_side;       // unit, perpendicular to the parent's axis, toward the child
    float exit_sine;      // of the angle between the two axes
    float offset;         // m from the root to the start of the axis, for textures
    // Used while planning.
    int32_t first_child, next_sibling;
} SkinChain;

// A node of the current chain before its axis is computed.
typedef struct SkinNode {
    Vec3 position;
    float along, radius, birth;
} SkinNode;

// A section that is not round: orders 1 to 8 of its distance from the axis over the radius, by the
// angle about the tangent from the axis' side. `round`, what is the same all around, is already in
// the radius.
enum { SKIN_GIRTH_ORDERS = 8 };
typedef struct SkinGirth {
    float round;
    float cosine[SKIN_GIRTH_ORDERS], sine[SKIN_GIRTH_ORDERS];
} SkinGirth;

typedef struct SkinPlan {
    SkinChain *chain;
    int64_t chain_count, chain_capacity;
    int32_t *node; // nodes of all chains, chain by chain
    int64_t node_count;
    int32_t *chain_of; // per out-tree node; -1 = thinner than min_radius (or descended from such a
                       // node)
    int32_t *place;    // per out-tree node: its index in `node`
    SkinPoint *point;
    int64_t point_count, point_capacity;
    SkinGirth *girth; // of each point; NULL = all are round
    int64_t girth_capacity;
    SkinNode *raw; // of the current chain
    int64_t raw_capacity;
    float least_radius;       // m: lower bound of all radii, against degenerate faces
    float thickest, thinnest; // m, of the nodes to skin
    float birth_scale;        // scales growth steps to 0..1
    const OutTree *tree;      // borrowed
    SkinParams params;
} SkinPlan;

bool skin_plan_init(SkinPlan *plan, const OutTree *tree, const SkinParams *params, const Run *run,
                    Error *e); // clear it after a failure, too
void skin_plan_clear(SkinPlan *plan);

// Decomposes the out-tree into chains (skin_chains.c); the first part of skin_plan_init.
bool skin_plan_chains(SkinPlan *plan, Error *e);

// Computes the axis of a chain whose parent has one (skin_axis.c). If the axis folds back on
// itself, the rest of the chain becomes a new child chain.
bool skin_plan_axis(SkinPlan *plan, int32_t chain, Error *e);

// The axis at an arc length from its start; extended straight beyond its ends.
SkinPoint skin_axis_at(const SkinPlan *plan, int32_t chain, float along);

// Index of the sample at or before that arc length.
int64_t skin_axis_sample(const SkinPlan *plan, int32_t chain, float along);

// Arc length of the point on a chain's axis nearest to p, searched from *sample (which it updates).
float skin_axis_nearest(const SkinPlan *plan, int32_t chain, Vec3 p, int64_t *sample);

#endif
