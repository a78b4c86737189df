// Kinds of objects. Each kind is a folder and a line in kinds.h. No code outside depends on the
// number of kinds, and kinds do not depend on scenes.
#ifndef RAMIFY_OBJECTS_KIND_H
#define RAMIFY_OBJECTS_KIND_H

#include "config/table.h"
#include "land/tiles.h"
#include "mesh/cover.h"
#include "objects/common/needs.h"
#include "objects/common/own_space.h"
#include "objects/common/recipe.h"
#include "outtree/flow.h"

enum { OBJECT_MOST_MATERIALS = 13 };

// Another object, whose surface a growth keeps clear of.
typedef struct ClearOf {
    char *object;   // its name
    float distance; // m
    float within;   // m: the growth also stays as near to it as this; 0 = anywhere
} ClearOf;

// Objects of one group grow at the same time, in turns of one step, and take attractors and space
// from each other.
typedef struct Contest {
    char *group;
    float gap; // m: between their nodes' axes
} Contest;

typedef struct SceneObject {
    char *name;
    uint64_t seed;        // 0 = from the scene's seed and the name
    bool species_targets; // the targets of its species hold for it
    ClearOf *clear_of;
    int clear_of_count;
    Contest *contest;            // NULL = none
    struct DeformParams *deform; // carry the object from its rest, in order
    int deform_count;
    const struct Kind *kind;
    void *params; // of the kind
    // Names of materials by the kind's roles; NULL = the kind's own choice (Kind.materials).
    char *material[OBJECT_MOST_MATERIALS];
} SceneObject;

// How far the heights of a terrain reach, m: the side of its square, and from the lowest to the
// highest, about.
typedef struct LandExtent {
    float side, relief;
} LandExtent;

typedef struct Kind {
    // The key of an object's mapping in the scene file (also the kind's name), the table of its
    // parameters, and the keys beside it, which all name materials.
    Variant variant;

    // Built-in materials by role, for NULL entries of SceneObject.material; NULL = the first
    // role's.
    const char *materials[OBJECT_MOST_MATERIALS];

    // Name of the built-in material of a role that these parameters ask for in place of
    // materials[role]; NULL = materials[role]. NULL = never.
    const char *(*material_for)(const void *params, int role);

    // Built-in materials that only this kind defaults to, ended by one without a name; NULL = none.
    const struct Material *builtin;

    // Name of material number index that its parameters name beside SceneObject.material; NULL past
    // the last one. NULL = there are none.
    const char *(*further_material)(const void *params, int index);

    bool reads_scene; // its geometry depends on materials' values or on other objects
    bool reads_water; // it avoids the scene's water
    bool keeps_clear; // its growth keeps out of the obstacles of Recipe.room
    bool contends;    // its growth takes turns with its rivals by Recipe.room
    bool sprays;      // its parts may throw up spray (Part.spray)
    bool carried;     // it can be deformed: it is its out-tree, or plain meshes, and nothing else

    // Sets the object's own space and transforms its parameters (a copy) into it; NULL = scene
    // space. The recipe works in the object's own space; its results are transformed into the
    // scene.
    bool (*own_space)(OwnSpace *own, void *params, Error *e);

    // Seed that its parameters give, in place of one derived from the name; 0 = none. NULL = never.
    uint64_t (*seed)(const void *params);

    // Name of the object whose surface it grows over; NULL = none. It grows in scene space then.
    // Recipe.surface is that surface. over_key: the key that names it.
    const char *(*over)(const void *params);
    const char *over_key;

    // The recipe: see objects/common/recipe.h. NULL = the kind has no such step. tip_radius: m, the
    // initial radius of nodes that thicken as they age; NULL = nodes appear at their final radius.
    bool (*grow)(const void *params, const Recipe *recipe, Grown *whole, Error *e);
    float (*tip_radius)(const void *params, const OutTree *whole);
    bool (*finish)(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                   Error *e);
    bool (*geometry)(const void *params, const Grown *grown, const Placing *placing, Error *e);
    bool (*measure)(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e);

    // Heights of a terrain, in the object's own space; NULL = the kind is no terrain.
    HeightField *(*heights)(const void *params, const Grown *grown, const Run *run, Error *e);

    // Lists where its surface is seen again beyond it, ring by ring, and returns how many these
    // are; either all or none are in its mesh. copy: NULL = count them. NULL = it has no copies.
    int (*surface_copies)(const void *params, struct SurfaceCopy *copy);

    // Fills in how the land is cut into tiles, but for the seed; false = it is not. NULL = never.
    bool (*tiles)(const void *params, TileGrid *grid);

    // Number of samples of these heights, and how far they reach; NULL likewise.
    int64_t (*samples)(const void *params);
    void (*extent)(const void *params, LandExtent *extent);

    // Height (m) of the ground that other objects stand on; NULL = the kind is no ground. seed: the
    // object's.
    float (*ground)(const void *params, uint64_t seed, float x, float z);

    // Adds the object's surface to the surfaces that may cover the ground, such as water; NULL =
    // none. seed: the object's.
    bool (*cover)(const void *params, uint64_t seed, Cover *cover, const Run *run, Error *e);

    // Is that surface water whatever the object's material is? NULL = its material tells.
    bool (*is_water)(const void *params);

    // Draws the object as a picture of one value per pixel, 0..1, row by row from the top left
    // (pixel: width * height floats); NULL = no picture.
    bool (*paint)(const void *params, const OutTree *tree, int width, int height, float *pixel,
                  Error *e);

    // Adds the attractors that are left at the cut to the points, in the object's own space; NULL =
    // they are not kept.
    bool (*points)(const Grown *grown, PointSet *points, Error *e);

    // For `ramify info`: prints ", 14 m, ..." after the name of the kind; NULL = nothing to add.
    void (*describe)(const void *params, char *text, size_t size);

    // Fills a copy of the parameters (the table's struct) with derived numbers in place of 0, as
    // the recipe uses them, for display. Its lists are not valid. NULL = nothing is derived.
    void (*settle)(const void *params, void *settled);

    // Adds the memory that the object will need; NULL = negligible.
    void (*needs)(const void *params, Needs *needs);

    // What flows through the out-tree, for network files; NULL = flow_params_default.
    void (*flow)(const void *params, FlowParams *flow);

    // Number of attractors, and largest number of copies (leaves, tufts); NULL = none.
    int64_t (*attractors)(const void *params);
    int64_t (*copies)(const void *params);
} Kind;

// The start of a kind's variant: its key, table and documentation.
#define KIND_ROW(KEY, TABLE, DOC)                                                     \
    {                                                                                 \
        KEY_OF(SceneObject, params, KEY, KEY_POINTER), .table = (TABLE), .doc = (DOC) \
    }

// The row of a key that names the kind's material number INDEX.
#define MATERIAL_ROW(INDEX, KEY, DOC)                                     \
    {                                                                     \
        KEY_OF(SceneObject, material[INDEX], KEY, KEY_TEXT), .doc = (DOC) \
    }

// Rows shared by several kinds.
#define OWN_MATERIAL_ROW(INDEX)                                                                  \
    MATERIAL_ROW(INDEX, "material",                                                              \
                 "Material of the object, or of a tree's bark; default: that of the kind, such " \
                 "as bark, ground, coral or ice; clay for a mesh or a shape.")
#define TWIG_MATERIAL_ROW(INDEX)         \
    MATERIAL_ROW(INDEX, "twig_material", \
                 "Material of twigs drawn as curves; default: twig, of an outtree its material.")
#define LEAF_MATERIAL_ROW(INDEX)                                                          \
    MATERIAL_ROW(INDEX, "leaf_material",                                                  \
                 "Material of leaves, or of fallen leaves on the ground; default: leaf, " \
                 "fallen.")
#define GRASS_MATERIAL_ROW(INDEX) \
    MATERIAL_ROW(INDEX, "grass_material", "Material of the ground's grass; default: grass.")

#define ORGAN_MATERIAL_ROWS(BLOSSOM, FRUIT, CONE, STALK)                                           \
    MATERIAL_ROW(BLOSSOM, "blossom_material", "Material of petals; default: blossom."),            \
        MATERIAL_ROW(FRUIT, "fruit_material",                                                      \
                     "Material of fruit, nuts and husks; default: fruit."),                        \
        MATERIAL_ROW(CONE, "cone_material",                                                        \
                     "Material of cones, catkins, acorns' cups, buds and spines; default: cone."), \
        MATERIAL_ROW(STALK, "stalk_material",                                                      \
                     "Material of stalks, sepals and plain stamens; default: stalk.")

#define ANTHER_MATERIAL_ROW(INDEX)         \
    MATERIAL_ROW(INDEX, "anther_material", \
                 "Material of a blossom's anthers, at an organ's detail 2; default: tree/anther.")

#define SNOW_MATERIAL_ROW(INDEX) \
    MATERIAL_ROW(INDEX, "snow_material", "Material of settled snow; default: snow.")

#define VETERAN_MATERIAL_ROWS(DEADWOOD, MISTLETOE, MOSS)                                   \
    MATERIAL_ROW(DEADWOOD, "deadwood_material",                                            \
                 "Material of dead limbs and of knots, without bark; default: deadwood."), \
        MATERIAL_ROW(MISTLETOE, "mistletoe_material",                                      \
                     "Material of mistletoe; default: mistletoe."),                        \
        MATERIAL_ROW(MOSS, "moss_material", "Material of tufts of moss; default: moss.")

#define WATER_MATERIAL_ROW(INDEX)                                                              \
    MATERIAL_ROW(INDEX, "water_material",                                                      \
                 "Material of a terrain's lakes and rivers, or of a ground's ponds; default: " \
                 "lake, of ponds ground/water.")

#define RIME_MATERIAL_ROW(INDEX)         \
    MATERIAL_ROW(INDEX, "rime_material", \
                 "Material of frost that is white with enclosed air; default: rime.")

// The built-in material of a role; NULL = the first role's.
static inline const char *kind_material(const Kind *kind, const void *params, int role)
{
    const char *asked = kind->material_for ? kind->material_for(params, role) : NULL;
    return asked ? asked : kind->materials[role];
}

// NULL if index is not below the number of kinds.
const Kind *kind_at(int index);

static inline const char *kind_name(const Kind *kind)
{
    return kind->variant.row.key;
}

// Grows the object and cuts it at grow_to (0..1) of the growth; empty for a kind that does not
// grow. memory, if not NULL, keeps the whole growth ({0} at first) for later calls with another
// grow_to. Clear both with grown_clear, also on failure.
bool kind_grow(const Kind *kind, const void *params, const Recipe *recipe, float grow_to,
               Grown *memory, Grown *grown, Error *e);

#endif
