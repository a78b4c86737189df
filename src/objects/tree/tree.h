// The tree (Tanaka et al., section 5.1): trunk, crown and roots grown as elements with their own
// envelopes and fields, branches placed on the trunk by height and oriented by its normals, radii
// by the pipe model or by birth, root flare, leaves placed on twigs by phyllotaxis.
#ifndef RAMIFY_OBJECTS_TREE_TREE_H
#define RAMIFY_OBJECTS_TREE_TREE_H

#include "base/run.h"
#include "grow/light/light.h"
#include "mesh/geometry.h"
#include "objects/common/branches.h"
#include "objects/common/element.h"
#include "objects/common/hoar.h"
#include "objects/common/organs.h"
#include "objects/common/phenology.h"
#include "objects/common/recipe.h"
#include "objects/common/snow.h"
#include "outtree/out_tree.h"

typedef struct TrunkParams {
    ElementParams element;
    float height;      // m, from the ground to the trunk's last node; 0 = 0.32 of the tree's height
    float radius;      // m, above the root flare; 0 = from the tree's height and slenderness
    float slenderness; // height / diameter of a grown-up tree, h; a tree of height H has
                       // h sqrt(mature height / H) (elastic similarity). 0 = default
    float lean;        // degrees from the vertical, toward `lean_azimuth`
    float lean_azimuth; // degrees from +Z toward +X
    int stems;          // stems that start on a circle about the base; 1 = a plain trunk
    float stem_circle;  // m, radius of that circle; 0 = the trunk's radius
    float stem_scatter; // 0..1: from on the circle to all over its inside
    float splay;        // degrees that stems on the circle lean outward, grown by light
    int ribs;           // along trunk and arms, as of a cactus; 0 = round
    float rib_depth;    // of the grooves between them, in radii
} TrunkParams;

typedef struct CrownParams {
    ElementParams element;
    float width;         // m; 0 = 1.05 of the tree's height
    float base;          // m above the ground where the crown begins; 0 = 0.18 of the height
    int branches;        // placed on the trunk by sorted height
    float branch_from;   // height of the lowest branch, as a share of the trunk's
    float branch_angle;  // degrees between a branch's start and the trunk
    float branch_length; // m, of the starting piece; 0 = 0.08 of the tree's height
    int lobes; // of the default envelope: bulges about an ellipsoid; 0 = the plain ellipsoid
} CrownParams;

typedef struct RootParams {
    ElementParams element;
    int count;    // main roots; 0 = none
    float spread; // m; 0 = 0.2 of the tree's height
    float depth;  // m below the ground; 0 = 0.25 of the spread
    float radius; // of a main root at the trunk, as a share of the trunk's radius
} RootParams;

// What trunk and crown grow by.
typedef enum GrownBy {
    GROWN_BY_AUTO, // attractors if the crown has levels of its own, otherwise light
    GROWN_BY_LIGHT,
    GROWN_BY_ATTRACTORS,
    GROWN_BY_BOTH // attractors lay trunk and limbs, which light fills
} GrownBy;

typedef struct ReachParams { // attractors that the buds of growth by light reach for
    ElementParams element;   // its envelope and points alone; no shapes = the crown's
    int64_t count;           // 0 = none
    float weight, pull;      // see LightAttractors
    float reach, occupied;   // internodes
} ReachParams;

typedef struct TreeLight {
    LightParams growth;
    ReachParams attractors;
    float mature_height; // m, of a grown-up tree
    float mature_age;    // years
    int healing;         // see LightSite
} TreeLight;

typedef struct VeteranParams {
    float dead_limbs; // 0..1: share of the limbs' wood, of a tree of twice its mature age
    int mistletoe;    // balls on a grown-up tree
    int moss;         // tufts at the foot
} VeteranParams;

typedef struct HazardParams { // chances and means over all trees with these parameters
    float width;              // standard deviation of the natural logarithm of the crowns' width
    float angle;              // degrees: deviation by which limbs hang or rise
    float loosening;          // 0..1: how far limbs leave their whorls
    float crowding;           // 0..1: how far neighbours hold limbs back on their sides
    float bare_below;         // 0..1: most height, share, below which limbs are dead
    float lost_limbs;         // 0..1: mean share of limbs that broke off
    float forked_top;         // 0..1: chance
    float dead_top;           // 0..1: chance
    float dead;               // 0..1: chance
} HazardParams;

typedef struct TreeParams {
    char *species; // NULL: what it names is applied before the file is loaded (scene/species.h)
    uint64_t seed; // 0 = the object's
    Vec3 position; // m, of the trunk's base
    float height;  // m; 0 = from the age
    float age;     // years; 0 = from the height
    GrownBy grown_by;
    TreeLight light;
    TrunkParams trunk;
    CrownParams crown;
    RootParams roots;
    float elbows; // trunk radii, see outtree/elbows.h; 0 = none
    RadiiParams radii;
    LeavesParams leaves;
    OrganGroup *organs;
    int organ_count;
    SkinningParams skin;
    float season;   // month and its fraction, 1..13; 0 = as leaves has it
    float latitude; // degrees
    Phenology phenology;
    SnowParams snow;
    HoarParams hoar;
    VeteranParams veteran;
    HazardParams hazards;
} TreeParams;

// Nodes of a main root's start, from inside the trunk's flare to where growth begins.
enum { TREE_ROOT_PIECES = 6 };

// Colonies of the out-trees that tree_grow makes. The last three bear no leaves: roots, dead wood
// and the places of overgrown limbs (one node inside the wood).
enum { TREE_TRUNK, TREE_CROWN, TREE_ROOTS, TREE_SNAGS, TREE_KNOTS, TREE_COLONIES };

// Roles of materials.
enum {
    TREE_BARK,
    TREE_TWIG,
    TREE_LEAF,
    TREE_BLOSSOM,
    TREE_FRUIT,
    TREE_CONE,
    TREE_STALK,
    TREE_SNOW,
    TREE_DEADWOOD,
    TREE_MISTLETOE,
    TREE_MOSS,
    TREE_RIME,
    TREE_ANTHER,
    TREE_ROLES
};

// Streams of the object's seed. The lobes of the default crown share the trunk's number.
enum {
    STREAM_TREE_LOBES = 1,
    STREAM_TREE_TRUNK = 1,
    STREAM_TREE_CROWN = 2,
    STREAM_TREE_ROOTS = 3,
    STREAM_TREE_LEAVES = 4,
    STREAM_TREE_ORGANS = 5
};

// The documented defaults: an oak of 14 m.
TreeParams tree_params_default(void);

// The recipe (see recipe.h). Grows the out-tree: all elements joined, radii computed. Colonies as
// above. The geometry is meshes, curves and leaf instances.
bool tree_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool tree_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                 Error *e);
float tree_tip_radius(const void *params, const OutTree *whole); // m
bool tree_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Sets the radii of a grown tree above the roots. params: resolved (defaults.h); by_light: growth
// by light has set those of the pipe model.
void tree_compute_radii(OutTree *tree, const TreeParams *params, bool by_light);

extern const struct Table tree_table; // of its parameters

#endif
