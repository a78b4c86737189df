// Growth rules: where a node's attractors pull it, and which children that makes. One file
// rule_*.c a rule; the engine knows them by these operations alone.
#ifndef RAMIFY_GROW_RULES_RULE_H
#define RAMIFY_GROW_RULES_RULE_H

#include "grow/growth.h"

typedef struct Rule {
    bool roots_head; // a root has a heading, too (see Grower)
    bool picks;      // needs Grower.lean and Pull.pick
    bool once;       // a node grows in one step of its life only

    // Checks the rule's parameters, makes its state, sets growth->bins; NULL = one bin, no state.
    bool (*begin)(Growth *growth, Error *e);
    void (*end)(Growth *growth); // frees the state, also after a begin that failed; NULL = none

    // Makes room for the state of nodes `from` to count - 1; NULL = none is kept.
    bool (*reserve)(Growth *growth, int64_t from, int64_t count, Error *e);

    // The bin in which an initial node stands among its siblings, which is taken from now on;
    // NULL = always 0.
    int (*seat)(Growth *growth, int64_t node);

    // Notes that the node grew from that bin of its parent; NULL = nothing to note.
    void (*note)(Growth *growth, int32_t parent, int64_t node, int bin);

    // Is a child of that bin a side branch, also when it is the first? NULL = the first never is.
    bool (*is_side)(int bin);

    // The bin of the grower that an attractor in that direction (unit) pulls, -1 = none;
    // NULL = always 0. pull: adds what the rule sums beyond direction and count; NULL = nothing.
    int (*bin)(const Growth *growth, const Grower *grower, Vec3 unit);
    void (*pull)(const Growth *growth, const Grower *grower, Vec3 unit, float distance,
                 int32_t attractor, Pull *pull);

    // Fills in the children that the pulls make, at most one a bin; returns how many.
    int (*make_children)(const Growth *growth, const Grower *grower, const Pull *pull,
                         Child *child);
} Rule;

extern const Rule rule_mean, rule_snap, rule_sectors, rule_string;

// ---- what the rules share (children.c) ----

// Id of the child that the grower makes next, `place` children after the ones it has.
uint64_t growth_child_id(const Growth *growth, const Grower *grower, int place);

// Mean of the unit pulls as a direction; zero where they cancel out (eq. 7).
Vec3 growth_mean_direction(const Pull *pull);

// One child a step (m) along `axis`, or along the mean pull where it is NULL, bent by field,
// tropism and noise, within the limits of angles. False where there is no direction.
bool growth_make_child(const Growth *growth, const Grower *grower, const Pull *pull,
                       const Vec3 *axis, float step, int place, Child *child);

// One child at most, made by `make` unless apical dominance or the order of branching forbids it.
typedef bool MakeChild(const Growth *growth, const Grower *grower, const Pull *pull, Child *child);
int growth_make_single(const Growth *growth, const Grower *grower, const Pull *pull, Child *child,
                       MakeChild *make);

// The additive form of the field (Tanaka eq. (13)), where it is in force: p moved by the scaled
// X_f.
Vec3 growth_add_field(const Growth *growth, const Grower *grower, Vec3 p);

// Does apical dominance keep a lateral child from growing? The same whenever it is asked.
bool growth_is_suppressed(const Growth *growth, uint64_t child_id);

// May this node not branch, because its sides would be of too high an order?
bool growth_is_last_order(const Growth *growth, int32_t node);

// v without its part along the unit vector n, as a unit vector; any such vector when none is left.
Vec3 growth_unit_across(Vec3 v, Vec3 n);

// Between the world and (heading, normal, side) components.
Vec3 growth_from_frame(const Grower *grower, Vec3 local);
Vec3 growth_to_frame(const Grower *grower, Vec3 v);

#endif
