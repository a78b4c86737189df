// Space colonization (Runions 2007; Tanaka eq. (1)-(8)): one engine, several rules. The cost of a
// step is that of the new nodes' neighbourhoods, not attractors x nodes.
#ifndef RAMIFY_GROW_COLONIZE_H
#define RAMIFY_GROW_COLONIZE_H

#include "base/run.h"
#include "field/guide_field.h"
#include "grow/attractor_log.h"
#include "grow/room.h"
#include "grow/rules/grow_string.h"
#include "grow/rules/rules.h"
#include "outtree/jitter.h"
#include "outtree/out_tree.h"
#include "shape/points.h"

typedef enum FieldMode {
    FIELD_STEER,   // direction normalize(n + w X_f); the step length stays exact
    FIELD_ADDITIVE // Tanaka eq. (13) as printed, X_f scaled by the step
} FieldMode;

// Lengths in metres; colonize_auto sets those that are 0 to multiples of the attractors' spacing.
typedef struct ColonizeParams {
    GrowRule rule;
    float step, kill, influence;
    int max_children; // per node; 0 = no limit
    float min_angle;  // degrees between a lateral child (second and later) and its parent's
                      // direction; 0 = off
    // degrees between any child and its parent's direction; 0 or 180 = off. Mean and sector
    // children are rotated back to it; sectors beyond it do not grow
    float max_angle;
    // degrees, half angle of a cone about cone_axis that limits all directions. 0 or 180 = off.
    // GROW_MEAN and GROW_SECTORS in space; children are rotated back
    float cone_angle;
    Vec3 cone_axis; // any length
    float noise;    // Gaussian, per component, added to the unit direction before normalising
    // takes the noise from a smooth field fixed in space instead of by node, so that growth through
    // the same place, as in the next frame of an animation, gets the same noise
    bool noise_in_space;
    Vec3 anchor;             // origin of that field
    Vec3 tropism;            // added to the unit direction; any length
    const GuideField *field; // may be NULL
    float field_weight;
    FieldMode field_mode;
    bool on_surface; // growth on a surface: directions stay in the tangent plane of the nearest
                     // attractors' normals
    // with on_surface: moves every new node onto the surface; directions then stay in the tangent
    // plane at the node, however far the attractors are. Called from several threads; NULL = not
    // moved
    SurfaceProject *project;
    const void *surface; // passed to project
    float sector_angle;  // degrees per sector (GROW_SECTORS) or group (GROW_STRING), 60 in Horiuchi
    bool sector_axis;    // GROW_SECTORS: grow along the sector's axis instead of its mean
    // highest branching order; 0 = no limit. The continuation (first child; GROW_SECTORS: forward
    // sector) keeps its parent's order, other children have one more; a root's children all have
    // order 0
    int max_order;
    bool new_orders;          // orders count from the initial nodes, all of which have order 0
    const GrowString *string; // GROW_STRING: a node without children is at its start
    float regularity; // GROW_STRING: weight of the string's own direction in a child's; 0 = mean
                      // direction of the attractors owned, as in Horiuchi
    float length_near, length_far; // GROW_STRING, m: growth distance of the attractors nearest to
                                   // their root and of the farthest; 0 = step
    float apical;     // apical dominance 0..1: probability that a lateral child is suppressed
    const Room *room; // obstacles and rivals; NULL = the growth is alone
    uint64_t seed;
    int32_t first_step; // birth of the first new nodes is first_step + 1
    int64_t max_steps;  // 0 = no limit
    int64_t max_nodes;  // of the whole tree including initial nodes; 0 = no limit
    AttractorLog *log;  // gets the attractors and when they were removed; NULL = not recorded
} ColonizeParams;

ColonizeParams colonize_params_default(void); // mean rule, lengths 0, everything else off, seed 1

typedef enum GrowStop {
    STOP_NO_PULL, // no attractor pulls any node: finished
    STOP_MAX_STEPS,
    STOP_MAX_NODES,
    STOP_OUT_OF_REACH // nothing grew: no attractor is within influence of any initial node
} GrowStop;

typedef struct GrowReport {
    GrowStop stop;
    int64_t steps, new_nodes, attractors_left;
    int64_t unreached; // remaining attractors that have no node within influence
    // m: distance from the tree to the nearest attractor for STOP_OUT_OF_REACH, or to the nearest
    // unreached one if at least a tenth of all attractors are unreached
    float nearest;
    float furthest;  // m: distance to the farthest unreached attractor in that case
    int32_t root;    // the root from which `nearest` was measured for STOP_OUT_OF_REACH
    float influence; // m: the influence radius used
} GrowReport;

// Sets step, kill and influence, where 0, to these multiples of the points' mean spacing.
void colonize_auto(ColonizeParams *params, double spacing, float step, float kill, float influence);

// Grows tree in place; its existing nodes are the type-0 points. In each step every attractor
// within influence pulls its nearest node (ties: the lowest index), every pulled node makes its
// child or children, in index order, and attractors closer than kill to a node are removed. A node
// that made a child without gaining or losing an attractor would repeat that child for ever, so its
// attractors no longer pull it. The result does not depend on run->threads; noise is keyed by node
// id. On error the tree is still valid. ERROR_INPUT for lengths that are not positive and finite,
// kill not below influence, or non-finite positions; ERROR_CANCELLED. report may be NULL.
bool colonize(OutTree *tree, const PointSet *attractors, const ColonizeParams *params,
              const Run *run, GrowReport *report, Error *e);

// Formats a stop reason for people: "no attractor in reach of root 0: influence 0.12 m, nearest
// attractor 0.31 m; raise growth.influence".
void grow_report_format(const GrowReport *report, const ColonizeParams *params, char *text,
                        int size);

// One level of coarse-to-fine growth. Multiples are of the level's own mean spacing.
typedef struct GrowLevel {
    int64_t attractors;
    float step, kill, influence; // multiples of the level's spacing
    float scale;                 // of the envelope, about its box's centre
    float noise;
    float tropism; // factor on ColonizeParams.tropism
    float relax;   // after the level, each new node moves this fraction of the way to its parent;
                   // typically 0.5
} GrowLevel;

// Scatters attractors and grows, level by level, starting from all existing nodes of tree. Coarse
// levels first give long limbs instead of a broom. reports: one per level, may be NULL.
bool colonize_levels(OutTree *tree, const Envelope *envelope, const ScatterParams *scatter,
                     const GrowLevel *levels, int level_count, const ColonizeParams *params,
                     const Run *run, GrowReport *reports, Error *e);

// The attractors that colonize_levels scatters for its first level, owned by the caller, and that
// level's influence radius, m.
PointSet *colonize_first_attractors(const Envelope *envelope, const ScatterParams *scatter,
                                    const GrowLevel *level, float *influence, const Run *run,
                                    Error *e);

#endif
