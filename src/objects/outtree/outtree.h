// A general out-tree (Tanaka et al., sections 3 and 4): any envelope, start points and attractors
// placed by the user or scattered, any growth rule, guide fields and levels, radii by one of
// several rules, jitter by fractional Brownian motion, and skin, leaves, lamps and the attractors
// themselves to be seen. The other kinds are recipes for particular things.
#ifndef RAMIFY_OBJECTS_OUTTREE_OUTTREE_H
#define RAMIFY_OBJECTS_OUTTREE_OUTTREE_H

#include "objects/common/blades.h"
#include "objects/common/branches.h"
#include "objects/common/element.h"
#include "objects/common/recipe.h"

// Type of a placed point (Tanaka et al., section 4.2).
enum { GROUP_NODE = 0, GROUP_ATTRACTOR = 1 };

typedef struct PlacedPoint {
    Vec3 position; // m; on a surface it is moved to the nearest point of the envelope
    int group;
    Vec3 normal; // zero = that of the surface, in space +Y
} PlacedPoint;

// Points that the user places. Attractors among them are a level of their own, the first.
typedef struct PlacedParams {
    PlacedPoint *points;
    int count;
    float step, kill, influence; // m; 0 = 0.5, 1 and 6 mean distances from a point to the nearest
} PlacedParams;

// Roots placed by the program, on the envelope's surface.
typedef struct StartsParams {
    int count;      // 0 = none if the user places some, else 1
    Vec3 direction; // the first is the farthest point this way
} StartsParams;

// The L-system of the growth rule "string"; see grow/rules/grow_string.h.
typedef struct StringParams {
    char *axiom, *rules; // NULL = the paper's; borrowed
    int generations;
    float angle;              // degrees, of turns
    float group;              // degrees, of a direction's group
    float regularity;         // 0..1
    float length, length_tip; // m: growth distance at the root, and farthest from it; 0 = the step
} StringParams;

typedef enum OuttreeRadii {
    OUTTREE_PIPE,   // r_parent^e = sum of r_child^e
    OUTTREE_MURRAY, // flow as measured in arteries: the exponent depends on the size
    OUTTREE_BIRTH,  // thicker with age
    OUTTREE_ORDER,  // each order of branching thinner by a factor
    OUTTREE_EVEN    // all the same
} OuttreeRadii;

typedef struct ThicknessParams {
    OuttreeRadii model;
    float exponent; // pipe
    float tip;      // m; 0 = 0.12 of the mean distance between nodes
    float root;     // m; 0 = as the rule gives; birth: 8 tips; order: 4 tips
    float ratio;    // order
} ThicknessParams;

typedef struct WanderParams {
    float
        amplitude; // share of the envelope's extent: standard deviation over that distance; 0 = off
    float hurst;
    float segment; // m between nodes from then on; 0 = as they grew
    bool pin_forks;
} WanderParams;

// Glowing balls at the branches' tips.
typedef struct LampsParams {
    int64_t max_count; // 0 = none
    float radius;      // m
    float drop;        // m: how far they hang below their tips
    float variation;   // share by which the smallest are smaller than radius
} LampsParams;

// Nodes that circles are drawn around.
typedef enum ShowAround { SHOW_TIPS, SHOW_STARTS, SHOW_NODES } ShowAround;

// What is shown of growth itself. 0 = not shown.
typedef struct ShowParams {
    float attractors, nodes, starts; // m, radius of balls; attractors: those left of the last group
    float edges;                     // m, radius of straight lines from nodes to their parents
    float pulls;                     // m, radius of lines from attractors to the nodes they pull
    float kill, influence;           // m, radius of lines: circles of these distances
    ShowAround around;
    float band;  // m, radius of balls at the voxels of the envelope's narrow band, in one slice
    Vec3 facing; // normal of the circles and the slice
} ShowParams;

typedef enum OuttreeForm {
    OUTTREE_TUBES,
    OUTTREE_BLADES,
    OUTTREE_NONE // only what ShowParams tells
} OuttreeForm;

// A growth that follows in the same envelope, on all nodes so far.
typedef struct FurtherParams {
    ElementParams element; // its shapes and points are not used
    float segment;         // m between the nodes that it starts from; 0 = as they grew
} FurtherParams;

typedef struct OuttreeParams {
    ElementParams element; // envelope and first growth; without shapes: the unit sphere, or a box
                           // about the placed attractors
    FurtherParams *further;
    int further_count;
    PlacedParams placed;
    StartsParams starts;
    StringParams string;
    ThicknessParams radii;
    WanderParams jitter;
    bool crossings; // on a surface: false = a branch ends where it would cross an older one
    float lift;     // m above the surface
    OuttreeForm form;
    SkinningParams skin; // tubes
    BladeParams blades;
    LeavesParams leaves; // tubes
    LampsParams lamps;
    ShowParams show;
} OuttreeParams;

// Roles of materials.
enum {
    OUTTREE_SKIN,
    OUTTREE_TWIG,
    OUTTREE_LEAF,
    OUTTREE_LAMP,
    OUTTREE_ATTRACTOR,
    OUTTREE_NODE,
    OUTTREE_WHITE
};

// Streams of the object's seed. Further growth i has FURTHER + i.
enum {
    STREAM_OUTTREE_PLACED = 1,
    STREAM_OUTTREE_STARTS = 2,
    STREAM_OUTTREE_CANDIDATES = 3,
    STREAM_OUTTREE_STRING = 4,
    STREAM_OUTTREE_GROWTH = 5,
    STREAM_OUTTREE_JITTER = 6,
    STREAM_OUTTREE_LEAVES = 7,
    STREAM_OUTTREE_LAMPS = 8, // the size of each, by its tip
    STREAM_OUTTREE_FURTHER = 100
};

OuttreeParams outtree_params_default(void); // in a ball of 1 m radius, from its lowest point

// Name of the object whose surface is the envelope; NULL = none. See Kind.over.
const char *outtree_over(const void *params);

// The envelope of the parameters' shapes, or the object's own, or recipe->surface, which it then
// borrows. Free with envelope_free.
Envelope *outtree_envelope(const OuttreeParams *params, const Recipe *recipe, Error *e);

// Does the object scatter attractors, besides those placed?
bool outtree_scatters(const OuttreeParams *params);

// The levels used if the parameters list none; *count = how many.
const GrowLevel *outtree_own_levels(int *count);

// The start points: placed nodes, then those placed by the program. Colony: the number of the
// start.
bool outtree_plant(OutTree *tree, const OuttreeParams *params, const Envelope *envelope,
                   const Recipe *recipe, Error *e);

// The placed attractors.
PointSet *outtree_placed_attractors(const OuttreeParams *params, const Envelope *envelope,
                                    uint64_t seed, Error *e);

// Fills in the tips' radius from the tree's nodes.
ThicknessParams outtree_resolve_radii(const OutTree *tree, const ThicknessParams *given);

// Radii by the rule of the resolved parameters.
bool outtree_radii(OutTree *tree, const ThicknessParams *params, Error *e);

// Adds what is shown of growth. log: the attractors left; NULL = not known.
bool outtree_show(const OuttreeParams *params, const OutTree *tree, const AttractorLog *log,
                  const Placing *placing, Error *e);

// The recipe (see recipe.h). Grows the out-tree with radii and jitter; whole->state and
// grown->state are the attractors (AttractorLog), of the whole growth and at its cut.
bool outtree_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
float outtree_tip_radius(const void *params, const OutTree *whole); // m
void outtree_free_attractors(void *log); // whole->state or grown->state; NULL is fine
bool outtree_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e);
bool outtree_points(const Grown *grown, PointSet *points, Error *e); // see Kind.points
bool outtree_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table outtree_table; // of its parameters

#endif
