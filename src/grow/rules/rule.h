// Growth rules: how attractors pull a node, and which children result. One file rule_*.c per rule;
// the engine uses only these operations.
#ifndef RAMIFY_GROW_RULES_RULE_H
#define RAMIFY_GROW_RULES_RULE_H

#include "grow/growth.h"

typedef struct Rule {
    bool roots_head; // roots have a heading too (see Grower)
    bool picks;      // needs Grower.lean and Pull.pick
    bool once;       // a node grows in one step only

    // Checks the rule's parameters, creates its state, sets growth->bins; NULL = one bin, no state.
    bool (*begin)(Growth *growth, Error *e);
    void (*end)(Growth *growth); // frees the state, also after a failed begin; NULL = none

    // Reserves state for nodes `from` to count - 1; NULL = no per-node state.
    bool (*reserve)(Growth *growth, int64_t from, int64_t count, Error *e);

    // Bin of an initial node among its siblings, marked as taken; NULL = always 0.
    int (*seat)(Growth *growth, int64_t node);

    // Records that the node grew from that bin of its parent; NULL = nothing to record.
    void (*note)(Growth *growth, int32_t parent, int64_t node, int bin);

    // Whether a child of that bin is lateral, even if it is the first; NULL = the first never is.
    bool (*is_side)(int bin);

    // Bin of the grower that an attractor in that direction (unit) pulls, -1 = none; NULL = always
    // 0. pull: accumulates what the rule needs beyond direction and count; NULL = nothing.
    int (*bin)(const Growth *growth, const Grower *grower, Vec3 unit);
    void (*pull)(const Growth *growth, const Grower *grower, Vec3 unit, float distance,
                 int32_t attractor, Pull *pull);

    // Fills in the children that result from the pulls, at most one per bin; returns how many.
    int (*make_children)(const Growth *growth, const Grower *grower, const Pull *pull,
                         Child *child);
} Rule;

#define DECLARE_RULE(NAME, VALUE, DOC) extern const Rule rule_##NAME;
GROWTH_RULES(DECLARE_RULE)
#undef DECLARE_RULE

// ---- shared by the rules (children.c) ----

// Id of the child that the grower makes next, `place` children after the existing ones.
uint64_t growth_child_id(const Growth *growth, const Grower *grower, int place);

// Direction of the mean of the unit pulls; zero if they cancel (Tanaka eq. (7)).
Vec3 growth_mean_direction(const Pull *pull);

// Makes one child at distance step (m) along `axis`, or along the mean pull if NULL, bent by field,
// tropism and noise, within the angle limits. False if there is no direction.
bool growth_make_child(const Growth *growth, const Grower *grower, const Pull *pull,
                       const Vec3 *axis, float step, int place, Child *child);

// Makes at most one child, by `make`, unless apical dominance or the branching order forbids it.
typedef bool MakeChild(const Growth *growth, const Grower *grower, const Pull *pull, Child *child);
int growth_make_single(const Growth *growth, const Grower *grower, const Pull *pull, Child *child,
                       MakeChild *make);

// The additive form of the field (Tanaka eq. (13)), if selected: p displaced by the scaled X_f.
Vec3 growth_add_field(const Growth *growth, const Grower *grower, Vec3 p);

// Whether apical dominance suppresses a lateral child; a function of its id.
bool growth_is_suppressed(const Growth *growth, uint64_t child_id);

// Whether the node's branching order forbids lateral children.
bool growth_is_last_order(const Growth *growth, int32_t node);

// Unit vector along the component of v perpendicular to the unit vector n; any perpendicular vector
// if that is zero.
Vec3 growth_unit_across(Vec3 v, Vec3 n);

// Convert between world and (heading, normal, side) components.
Vec3 growth_from_frame(const Grower *grower, Vec3 local);
Vec3 growth_to_frame(const Grower *grower, Vec3 v);

#endif
