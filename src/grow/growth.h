// State of one run of space colonization, shared by the parts of the engine: choosing growers,
// summing pulls, making children. Pulls are summed as integers, so the result depends neither on
// the order of summation nor on the number of threads.
#ifndef RAMIFY_GROW_GROWTH_H
#define RAMIFY_GROW_GROWTH_H

#include "grow/attractor_grid.h"
#include "grow/colonize.h"

// Per-node state of growth.
typedef struct NodeState {
    int32_t children;    // so far
    int32_t order;       // of branching
    int32_t first_child; // index of the first child, -1 before
    bool stalled;        // its attractors did not change although it grew: they no longer pull it
} NodeState;

// A node that grows in this step.
typedef struct Grower {
    int32_t node;
    bool has_heading;
    Vec3 position;
    Vec3 heading; // unit: from its parent to it; some rules define one for roots too
    Vec3 normal;  // unit
    Vec3 side;    // normal x heading: completes the grower's frame
    Vec3 lean;    // w X_f + tropism + noise, for the rule that picks attractors by it
} Grower;

// Sum of the attractors' pulls on a grower (or on one bin of it: a sector, a direction). Fixed
// point, in units of 1 / PULL_ONE.
typedef struct Pull {
    int64_t toward[3]; // sum of unit vectors to the attractors (Tanaka eq. (7))
    int64_t count;
    int64_t normal[3]; // sum of the attractors' normals, on surfaces
    int64_t height;    // sum of the node's heights above the attractors' surface, divided by
                       // influence
    int64_t length;    // rule "string": sum of the attractors' growth distances, divided by the
                       // largest
    uint64_t pick;     // rule "snap": least (cost as float bits, attractor); UINT64_MAX = none
} Pull;

#define PULL_ONE 1073741824.0f // 2^30: multiplying by it only changes the exponent

typedef struct Child {
    Vec3 position, normal;
    int bin; // the bin it grew from
} Child;

// Cosines and sines of the angle limits; a cosine of 2 (minimum) or -2 (maximum) = off.
typedef struct AngleLimits {
    float min_cos, min_sin, max_cos, max_sin; // between a child and its parent's direction
    float cone_cos, cone_sin;                 // between a child and cone_axis
    Vec3 cone_axis;                           // unit
} AngleLimits;

typedef struct Growth {
    OutTree *tree;
    const PointSet *attractors;
    const ColonizeParams *params;
    const Run *run;
    int threads;
    int64_t initial_count; // initial nodes: the type-0 points
    AttractorGrid grid;
    AngleLimits limits;
    const struct Rule *rule;
    void *rule_state; // owned by the rule; freed by Rule.end
    int bins;         // pulls per grower; at most one child grows from each

    NodeState *state; // per node
    int64_t state_capacity;
    int32_t *slot; // per node: its index among the growers, or -1
    int64_t slot_capacity;
    NodeBits changed;

    Grower *grower;
    int64_t grower_count, grower_capacity;
    Pull *pull; // threads x growers x bins; the first thread's are the final sums
    int64_t pull_capacity;
    Child *child; // growers x bins
    int64_t child_capacity;
    int32_t *child_count; // per grower
    int64_t child_count_capacity;
    int32_t *grew; // nodes that made a child in the last step
    int64_t grew_count, grew_capacity;
} Growth;

// Pulls are summed in parts (at most as many as the grid has slabs): each part by one thread, then
// all parts of a grower into part 0, growth->pull[grower * bins + bin].
void growth_sum_part(const Growth *growth, int part, int parts);
void growth_merge_pulls(const Growth *growth, int64_t grower, int parts);

// Whether the sums read growers, which then must be prepared before.
bool growth_sums_need_frames(const Growth *growth);

// Fills in a grower whose node is set.
void growth_prepare(const Growth *growth, Grower *grower);

// Makes the children of a grower from its pulls, at most one per bin; returns how many.
int growth_make_children(const Growth *growth, const Grower *grower, const Pull *pull,
                         Child *child);

#endif
