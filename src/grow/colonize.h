// Space colonization (Runions et al. 2007; Tanaka et al., eq. (1)-(8)): one engine, several rules.
// Cost per step is that of the new nodes' neighbourhoods, not attractors x nodes.
#ifndef RAMIFY_GROW_COLONIZE_H
#define RAMIFY_GROW_COLONIZE_H

#include "base/run.h"
#include "field/guide_field.h"
#include "grow/rules/grow_string.h"
#include "outtree/out_tree.h"
#include "shape/points.h"

typedef enum GrowRule {
    GROW_MEAN,    // one child a step along the mean pull (Tanaka eq. (6)-(7))
    GROW_SNAP,    // the nearest reached attractor itself becomes the node (Tanaka fig. 5-6); what
                  // bends the other rules' directions makes attractors that way count as nearer
    GROW_SECTORS, // pulls binned by angle about the heading; at most one child a sector, ever
    GROW_STRING // directions that an L-system string picks; each owns the attractors nearest to it
                // in angle, within half a group (Horiuchi, steps a to f)
} GrowRule;

typedef enum FieldMode {
    FIELD_STEER,   // direction normalize(n + w X_f); step stays exact
    FIELD_ADDITIVE // Tanaka eq. (13) as printed, X_f scaled by the step
} FieldMode;

// Lengths in metres; colonize_auto fills them in from multiples of the attractors' spacing.
typedef struct ColonizeParams {
    GrowRule rule;
    float step, kill, influence;
    int max_children; // per node; 0 = no limit
    float min_angle;  // degrees between a branching child (second and later) and its parent's
                      // direction; 0 = off
    float max_angle;  // degrees between any child and its parent's direction; 0 or 180 = off. Mean
                      // and sector children turn back to it; sectors beyond it do not grow
    float cone_angle; // degrees between any child and cone_axis: none heads further away from it.
                      // 0 or 180 = off. GROW_MEAN and GROW_SECTORS in space; children turn back
    Vec3 cone_axis;   // any length
    float noise;      // Gaussian, per component, added to the unit direction before normalising
    bool noise_in_space; // draw the noise from a smooth field fixed in space, not by node: where
                         // growth comes by again, as in the next frame of a film, it is the same
    Vec3 anchor;         // of that field
    Vec3 tropism;        // added to the unit direction: uniform pull, any length
    const GuideField *field; // may be NULL
    float field_weight;
    FieldMode field_mode;
    bool on_surface; // growth on a surface: directions are kept in the tangent plane of the nearest
                     // attractors' normals
    float sector_angle; // degrees a sector (GROW_SECTORS) or group (GROW_STRING), 60 in Horiuchi
    bool sector_axis;   // GROW_SECTORS: grow along the sector's axis instead of its mean
    int max_order;      // orders of branching: sides of sides ...; 0 = no limit. What continues its
                        // parent (first child; GROW_SECTORS: forward sector) keeps its order; a
                        // root's children all have order 0
    bool new_orders;    // orders count from the nodes there are at first, all of which have order 0
    const GrowString *string; // GROW_STRING: a node without children stands at its start
    float regularity; // GROW_STRING: share of the string's own direction in a child's; 0 = the mean
                      // of what the direction owns, as in Horiuchi
    float length_near, length_far; // GROW_STRING, m: growth distance of the attractors next to
                                   // their root and of the farthest; 0 = step
    float apical; // apical dominance 0..1: probability that a lateral child is suppressed
    uint64_t seed;
    int32_t first_step; // birth of the first new nodes is first_step + 1
    int64_t max_steps;  // 0 = no limit
    int64_t max_nodes;  // of the whole tree, initial nodes too; 0 = no limit
} ColonizeParams;

ColonizeParams colonize_params_default(void); // mean rule, lengths 0, everything else off, seed 1

typedef enum GrowStop {
    STOP_NO_PULL, // no attractor pulls any node: done
    STOP_MAX_STEPS,
    STOP_MAX_NODES,
    STOP_OUT_OF_REACH // nothing grew: no attractor within influence of any initial node
} GrowStop;

typedef struct GrowReport {
    GrowStop stop;
    int64_t steps, new_nodes, attractors_left;
    int64_t unreached; // of those left: no node is within influence of them
    float nearest;  // m: distance from the tree to the nearest attractor when STOP_OUT_OF_REACH, or
                    // to the nearest unreached one when a tenth of all attractors or more are
    float furthest; // m: to the furthest unreached one then
    int32_t root;   // the root that `nearest` was measured from when STOP_OUT_OF_REACH
    float influence; // m: the influence radius that was in force
} GrowReport;

// Sets step, kill and influence that are 0 to these multiples of the points' mean spacing s.
void colonize_auto(ColonizeParams *params, double spacing, float step, float kill, float influence);

// Grows tree in place: its nodes so far are the type-0 points. In a step every attractor within
// influence pulls its nearest node (ties: the lowest index), every pulled node makes its child or
// children, in order of index, and attractors closer than kill to a node are removed. A node that
// made a child without gaining or losing an attractor by it would make the same child for ever: its
// attractors pull it no more. The same bits for any run->threads; noise is keyed by node id. On
// error the tree is still valid. ERROR_INPUT for lengths that are not positive and finite, kill not
// below influence, positions that are not finite; ERROR_CANCELLED. report may be NULL.
bool colonize(OutTree *tree, const PointSet *attractors, const ColonizeParams *params,
              const Run *run, GrowReport *report, Error *e);

// Formats a stop reason for people: "no attractor in reach of root 0: influence 0.12 m, nearest
// attractor 0.31 m; raise growth.influence".
void grow_report_format(const GrowReport *report, const ColonizeParams *params, char *text,
                        int size);

// One level of coarse-to-fine growth. Multiples are of that level's own mean spacing.
typedef struct GrowLevel {
    int64_t attractors;
    float step, kill, influence; // multiples of the level's spacing
    float scale;                 // of the envelope, about its box's centre
    float noise;
    float tropism; // factor on ColonizeParams.tropism
    float relax;   // after the level, each new node moves this share of the way to its parent; 0.5
                   // usual
} GrowLevel;

// Scatters and grows level after level into tree, starting from all nodes so far (docs: recipes;
// the difference between a broom and an oak). reports: one a level, may be NULL.
bool colonize_levels(OutTree *tree, const Envelope *envelope, const ScatterParams *scatter,
                     const GrowLevel *levels, int level_count, const ColonizeParams *params,
                     const Run *run, GrowReport *reports, Error *e);

// The attractors that colonize_levels scatters for its first level, owned by the caller, and that
// level's influence, m.
PointSet *colonize_first_attractors(const Envelope *envelope, const ScatterParams *scatter,
                                    const GrowLevel *level, float *influence, const Run *run,
                                    Error *e);

#endif
