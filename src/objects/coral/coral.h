// Corals (Horiuchi et al., growth rules and territorial battle): an L-system string gives the
// directions of branching, attractors stand for light and free space, and colonies that share them
// stop where another came first. Branching and table forms grow in space, fans in a plane,
// encrusting and massive ones over a rock, which they cover with a crust.
#ifndef RAMIFY_OBJECTS_CORAL_CORAL_H
#define RAMIFY_OBJECTS_CORAL_CORAL_H

#include "mesh/geometry.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"
#include "shape/envelope.h"

typedef enum CoralForm {
    CORAL_BRANCHING,  // staghorn: long rounded branches that fork in space
    CORAL_TABLE,      // corymbose: a plate of radiating branches with upright branchlets
    CORAL_FAN,        // in the plane z = 0, as in the paper, unless it is uneven
    CORAL_ENCRUSTING, // a crust that creeps over a rock
    CORAL_MASSIVE     // a boulder of coral
} CoralForm;

typedef enum CoralRule {
    CORAL_STRING, // the paper's method
    CORAL_MEAN    // plain space colonization, for comparison
} CoralRule;

typedef enum PolypShape {
    POLYP_TUBE, // straight and round
    POLYP_NOSE  // bent out of the tissue toward the tip, of unequal form
} PolypShape;

// Corallites: the cups that polyps sit in, as geometry.
typedef struct PolypParams {
    PolypShape shape;
    int64_t max_count; // 0 = none: shown by the material's pattern alone
    float diameter;    // m, of a cup's rim; 0 = 0.0044 of the colony's size
    float spacing;     // m, between the cups' centres; 0 = 1.6 diameters
    float height;      // m, of a cup's wall; 0 = 0.9 diameters
    float lean;        // degrees that cups lean toward the branch's tip
    float fill;        // 0..1: how many of the gaps between them small cups fill
    float tentacles;   // 0..1: share of the noses whose polyps are out
} PolypParams;

typedef struct CoralParams {
    CoralForm form;
    CoralRule rule;
    Vec3 position;            // m: middle of the colonies, on the sea floor
    float size;               // m: width of one colony
    float height;             // m; 0 = the form's own share of the size
    int colonies;             // that compete for the same space
    float spread;             // m: radius of the circle of colonies; 0 = 0.42 of the size
    int64_t attractors;       // per colony; 0 = the form's own
    char *axiom, *rules;      // the L-system; NULL = the form's own; borrowed
    int generations;          // of the string; 0 = the form's own
    float angle;              // degrees, of turns; 0 = the form's own
    float group;              // degrees, of a direction's group; 0 = the form's own
    float regularity;         // 0..1; -1 = the form's own. See ColonizeParams
    float noise;              // Gaussian, of each direction; -1 = the form's own
    float length, length_tip; // m: growth distance at the root, and farthest from it; 0 = auto
    float light;              // 0..1: how much denser attractors are above than below
    float tip_radius;         // m; 0 = the form's own share of the size
    float exponent;           // of the radii: 4 keeps branches nearly as thick as their tips
    float taper;              // m from a tip over which a branch thickens; 0 = one step
    float fuse;               // m over which tips fuse with branches near them; 0 = they do not
    float bridge;             // m along branches between bridges to others; 0 = tips alone fuse
    float branchlet;          // m: height of a table's branchlets; 0 = 0.05 of the size
    float plate;              // m: thickness of a table's plate; 0 = 0.044 of the size
    float eccentric;          // 0..1: how far a table's stalk stands off its middle, in half sizes
    float
        uneven; // 0..1: how far a table's plate is tilted, lobed and in tiers, a fan lobed and bent
    float pale; // m from a growing tip (or margin) where it is pale; 0 = 4 tip radii
    PolypParams polyps;
    Shape *base; // of encrusting and massive forms: the rock; empty = a boulder of the size
    int base_count;
    int levels; // subdivision of the skin, 0..4
} CoralParams;

enum { CORAL_SKIN, CORAL_POLYPS, CORAL_ROCK }; // roles of materials

// Streams of the object's seed; colony i uses i for its root's id, and VARIATIONS, COLONIES and
// STEMS + i, ASIDE + i, PLATE + i. POLYPS is also a stream of COLONIES + i.
enum {
    STREAM_CORAL_POINTS = 2,
    STREAM_CORAL_GROWTH = 3,
    STREAM_CORAL_STRING = 5,
    STREAM_CORAL_BRANCHLETS = 6,
    STREAM_CORAL_CRUST = 8,
    STREAM_CORAL_POLYPS = 9,
    STREAM_CORAL_ROCK = 12,
    STREAM_CORAL_BOULDER = 40,
    STREAM_CORAL_VARIATIONS = 50,
    STREAM_CORAL_COLONIES = 60,
    STREAM_CORAL_STEMS = 90,
    STREAM_CORAL_ASIDE = 160,
    STREAM_CORAL_PLATE = 230
};

CoralParams coral_params_default(void); // staghorn, half a metre wide

// Fills in every number that is left to the form. axiom and rules point to static text if they were
// NULL.
CoralParams coral_params_resolve(const CoralParams *params);

// The recipe (see recipe.h). Grows the colonies: one root (or its stem) and one OutTree.colony
// each. Births count the steps. ERROR_INPUT for an invalid L-system. The geometry is skin or
// crust, corallites, and the rock below a crust.
bool coral_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool coral_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                  Error *e);
bool coral_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

typedef struct CoralMeasures {
    double branch_thickness; // m, mean diameter over the nodes
    double branch_spacing;   // m, mean distance from a tip to the nearest other
    double seam; // m, least distance between nodes of different colonies; NAN = one colony
} CoralMeasures;

bool coral_measure(const OutTree *tree, CoralMeasures *measures, Error *e);

// Where colony number `colony` stands.
Vec3 coral_foot(const CoralParams *resolved, int colony);

// The rock that encrusting and massive forms grow on. Free with envelope_free.
Envelope *coral_base(const CoralParams *resolved, uint64_t seed, const Run *run, Error *e);

extern const struct Table coral_table; // of its parameters

#endif
