// What elements (trunk, crown, roots) are made of: shapes, points, growth levels, guide fields.
#include "objects/common/tables.h"

#define BIT(kind) (1u << (kind))
#define ALL_BUT_OBJECT (BIT(SHAPE_OBJECT) - 1u) // which is the last

static const EnumName SHAPES[] = {{"sphere", SHAPE_SPHERE},
                                  {"ellipsoid", SHAPE_ELLIPSOID},
                                  {"box", SHAPE_BOX},
                                  {"cone", SHAPE_CONE},
                                  {"capsule", SHAPE_CAPSULE},
                                  {"mesh", SHAPE_MESH},
                                  {"half_space", SHAPE_HALF_SPACE},
                                  {"body", SHAPE_BODY},
                                  {"object", SHAPE_OBJECT},
                                  {0}};
static const EnumName SHAPE_OPS[] = {{"union", SHAPE_UNION},
                                     {"difference", SHAPE_DIFFERENCE},
                                     {"intersection", SHAPE_INTERSECTION},
                                     {0}};

static const Key SHAPE_KEYS[] = {
    {KEY_OF(Shape, kind, "shape", KEY_ENUM), .flags = KEY_REQUIRED, .names = SHAPES,
     .doc =
         "sphere: centred at the origin; ellipsoid: centred at the origin, with three half-axes; "
         "box: centred at the origin; cone: base at the origin, optionally truncated; capsule: rod "
         "with round ends, from the origin up; mesh: from a file; half_space: everything below y = "
         "0, for cutting; body: a standing human, feet at the origin, facing +Z; object: the "
         "surface of another object of the scene, such as a terrain, where that lies. An outtree "
         "grows over it with points: {place: surface}; it must be the only shape."},
    {KEY_OF(Shape, op, "op", KEY_ENUM), .names = SHAPE_OPS, .kinds = ALL_BUT_OBJECT,
     .doc = "union: add the shape; difference: subtract it; intersection: keep only what also lies "
            "in it. The first shape of a list must be a union."},
    {KEY_OF(Shape, blend, "blend", KEY_FLOAT), .kinds = ALL_BUT_OBJECT & ~BIT(SHAPE_MESH),
     .high = 1e6, .unit = "m",
     .doc = "How far the shape flows into those before it, as limbs into a body: edges between "
            "them are rounded over about this length; 0 = they are sharp. None of the shapes "
            "before it may be a mesh."},
    {KEY_OF(Shape, size, "size", KEY_VECTOR), .flags = KEY_SPLAT, .count = 3, .high = 1e6,
     .kinds = BIT(SHAPE_SPHERE) | BIT(SHAPE_ELLIPSOID) | BIT(SHAPE_BOX) | BIT(SHAPE_CONE) |
              BIT(SHAPE_CAPSULE) | BIT(SHAPE_BODY),
     .unit = "m",
     .doc = "sphere: radius; ellipsoid: three half-axes; box: three half-extents; cone: base "
            "radius, height, top radius; capsule: radius, distance between the centres of its "
            "ends, unused; body: height, unused, unused."},
    {KEY_OF(Shape, file, "file", KEY_FILE), .flags = KEY_REQUIRED, .kinds = BIT(SHAPE_MESH),
     .doc = "OBJ, PLY, STL, glTF, GLB or VDB file, relative to the scene's folder."},
    {KEY_OF(Shape, object, "object", KEY_TEXT), .flags = KEY_REQUIRED, .kinds = BIT(SHAPE_OBJECT),
     .doc = "Name of the object. It is built first. Its curves, leaves and other copies do not "
            "count."},
    {KEY_OF(Shape, position, "position", KEY_VECTOR), .kinds = ALL_BUT_OBJECT, .count = 3,
     .unit = "m", .doc = "Position of the shape's origin."},
    {KEY_OF(Shape, rotation, "rotation", KEY_VECTOR), .kinds = ALL_BUT_OBJECT, .count = 3,
     .unit = "degrees", .doc = "Rotation about x, then y, then z."},
    {KEY_OF(Shape, scale, "scale", KEY_VECTOR), .flags = KEY_SPLAT, .kinds = ALL_BUT_OBJECT,
     .count = 3,
     .doc = "Scale along x, y and z, applied before the rotation; negative values mirror."},
    {0},
};

static void shape_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    *(Shape *)out = (Shape){
        .kind = kind < 0 ? SHAPE_SPHERE : (ShapeKind)kind, .size = {1, 1, 1}, .scale = {1, 1, 1}};
}

const Table shape_table = {
    .name = "shape",
    .doc = "One shape of an envelope, the region that something grows in. The shapes of a list are "
           "combined in order. Each is scaled, then rotated, then moved.",
    .example = "objects:\n"
               "  - name: umbrella\n"
               "    tree:\n"
               "      crown:\n"
               "        envelope:\n"
               "          - {shape: ellipsoid, size: [5, 1, 5], position: [0, 9, 0]}\n"
               "          - {shape: sphere, size: 2, position: [3, 8, 0], op: difference}\n",
    .size = sizeof(Shape),
    .keys = SHAPE_KEYS,
    .kind_key = "shape",
    .kind_defaults = shape_defaults,
    .check = check_shape};

static const EnumName PLACES[] = {{"volume", SCATTER_VOLUME}, {"surface", SCATTER_SURFACE}, {0}};
static const EnumName SCATTERS[] = {{"random", SCATTER_RANDOM}, {"poisson", SCATTER_POISSON}, {0}};

static const Key DENSITY_KEYS[] = {
    {KEY_OF(DensityParams, file, "file", KEY_FILE), .flags = KEY_REQUIRED,
     .doc = "VDB file with a scalar grid (a fog volume's values, or the inside of a level set), or "
            "any picture, whose white places are the densest."},
    {KEY_OF(DensityParams, grid, "grid", KEY_TEXT),
     .doc = "Name of the grid in the VDB file; default: the first of floats."},
    {KEY_OF(DensityParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the grid's origin, or of the picture's middle."},
    {KEY_OF(DensityParams, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Rotation about x, then y, then z. A picture lies level, its top toward -z, and counts "
            "at every height."},
    {KEY_OF(DensityParams, scale, "scale", KEY_VECTOR), .flags = KEY_SPLAT, .count = 3,
     .doc = "Scale along x, y and z; a picture is x wide and z deep, in metres."},
    {KEY_OF(DensityParams, invert, "invert", KEY_BOOL), .doc = "Use 1 - density."},
    {0},
};

static void density_defaults(void *out)
{
    *(DensityParams *)out = (DensityParams){.scale = {1, 1, 1}};
}

static bool check_density(const Mapping *mapping, void *params)
{
    DensityParams *density = params;
    density->transform = transform_compose(density->position, density->rotation, density->scale);
    return check_scale(mapping, density->scale);
}

static const Table density_table = {
    .name = "density",
    .doc = "How densely attractors lie, from a file: growth reaches where it is dense.",
    .example = "objects:\n"
               "  - name: lawn\n"
               "    outtree:\n"
               "      envelope: [{shape: box, size: [2, 0.02, 2]}]\n"
               "      points: {density: {file: meadow.png, scale: 4}}\n",
    .size = sizeof(DensityParams),
    .keys = DENSITY_KEYS,
    .defaults = density_defaults,
    .check = check_density};

static const Key POINTS_KEYS[] = {
    {KEY_OF(ElementParams, points.place, "place", KEY_ENUM), .names = PLACES,
     .doc = "volume: fill the envelope; surface: cover its surface."},
    {KEY_OF(ElementParams, points.pattern, "pattern", KEY_ENUM), .names = SCATTERS,
     .doc = "random: independent points; poisson: evenly spaced points."},
    {KEY_OF(ElementParams, points.shell, "shell", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the points that are pushed out toward the surface, where light lets "
            "leaves and twigs grow."},
    {KEY_OF(ElementParams, points.gradient, "gradient", KEY_FLOAT), .low = -1, .high = 1,
     .doc = "Density by height: -1 = only at the bottom, 0 = uniform, 1 = only at the top."},
    {KEY_OF(ElementParams, points.depth_gradient, "depth_gradient", KEY_FLOAT), .low = -1,
     .high = 1,
     .doc = "Density by depth: -1 = only in the middle, 0 = uniform, 1 = only near the surface."},
    {KEY_OF(ElementParams, points.facing, "facing", KEY_VECTOR), .count = 3,
     .doc = "On a surface: attractors lie only where it faces this direction, give or take 60 "
            "degrees: on one side of a sheet; [0, 0, 0] = everywhere."},
    {KEY_OF(ElementParams, points.anchored, "anchored", KEY_BOOL),
     .doc = "Keep attractors in place when the envelope moves or changes, so that growth elsewhere "
            "hardly changes; for animation and editing. Counts are then approximate."},
    {KEY_OF(ElementParams, density, "density", KEY_POINTER), .table = &density_table,
     .doc = "Density of the attractors from an OpenVDB grid or a picture."},
    {0},
};

const Table points_table = {
    .name = "points",
    .doc = "How attractors, the points that growth reaches for, are scattered in the envelope. The "
           "levels of growth set their number.",
    .example = "objects:\n"
               "  - name: hollow\n"
               "    tree: {crown: {points: {pattern: poisson, depth_gradient: 0.6}}}\n",
    .size = sizeof(ElementParams),
    .keys = POINTS_KEYS};

static const Key LEVEL_KEYS[] = {
    {KEY_OF(GrowLevel, attractors, "attractors", KEY_INT64), .flags = KEY_REQUIRED, .low = 1,
     .high = 2147483647, .doc = "Number of attractors."},
    {KEY_OF(GrowLevel, step, "step", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "spacings",
     .doc = "Distance between nodes, in mean spacings of this level's attractors."},
    {KEY_OF(GrowLevel, kill, "kill", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "spacings",
     .doc = "Kill distance: an attractor this near to a node is removed. A larger distance gives "
            "sparser branches."},
    {KEY_OF(GrowLevel, influence, "influence", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "spacings",
     .doc = "Influence distance: an attractor pulls the node nearest to it within this distance."},
    {KEY_OF(GrowLevel, scale, "scale", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .doc = "Scale of the envelope in this level, about the centre of its bounding box."},
    {KEY_OF(GrowLevel, relax, "relax", KEY_FLOAT), .high = 1,
     .doc =
         "Smoothing after the level: each new node moves this fraction of the way to its parent."},
    {KEY_OF(GrowLevel, noise, "noise", KEY_FLOAT), .flags = KEY_NO_DEFAULT, .high = 100,
     .doc = "Gaussian noise added to each component of the direction; default: growth.noise."},
    {KEY_OF(GrowLevel, tropism, "tropism", KEY_FLOAT), .flags = KEY_NO_DEFAULT, .low = -1000,
     .high = 1000,
     .doc = "Multiplier of growth.tropism; default: 1 if the file sets growth.tropism, else 0."},
    {0},
};

// The papers' plain case: one level, tried in between the coarsest and the finest of the oak.
static void level_defaults(void *out)
{
    *(GrowLevel *)out =
        (GrowLevel){.step = 0.3f, .kill = 0.9f, .influence = 2.2f, .scale = 1.0f, .relax = 0.5f};
}

static const Table LEVEL_TABLE = {
    .name = "level",
    .doc = "One level of coarse-to-fine growth. It scatters its own attractors: few for limbs, "
           "many for twigs. Its lengths are in mean spacings of these attractors.",
    .example = "objects:\n"
               "  - name: two_levels\n"
               "    tree:\n"
               "      crown:\n"
               "        growth:\n"
               "          levels:\n"
               "            - {attractors: 300, step: 0.3, kill: 0.9}\n"
               "            - {attractors: 8000, step: 0.4, kill: 0.8, influence: 2}\n",
    .size = sizeof(GrowLevel),
    .keys = LEVEL_KEYS,
    .defaults = level_defaults,
    .check = check_level};

#define RULE_NAME(NAME, VALUE, DOC) {#NAME, VALUE},
static const EnumName RULES[] = {GROWTH_RULES(RULE_NAME){0}};
#define RULE_DOC(NAME, VALUE, DOC) " " #NAME ": " DOC "."
static const EnumName FIELD_MODES[] = {{"steer", FIELD_STEER}, {"additive", FIELD_ADDITIVE}, {0}};

static const Key GROWTH_KEYS[] = {
    {KEY_OF(ElementParams, growth.rule, "rule", KEY_ENUM), .names = RULES,
     .doc = "Growth rule." GROWTH_RULES(RULE_DOC)},
    {KEY_OF(ElementParams, levels, "levels", KEY_LIST),
     .count_offset = offsetof(ElementParams, level_count), .count = 100, .table = &LEVEL_TABLE,
     .doc = "Levels, coarse to fine: each scatters new attractors and grows from all existing "
            "nodes. Default: the kind's own levels."},
    {KEY_OF(ElementParams, growth.max_children, "max_children", KEY_INT), .high = 1000,
     .doc = "Maximum number of children of a node; 0 = no limit."},
    {KEY_OF(ElementParams, growth.max_order, "max_order", KEY_INT), .high = 1000,
     .doc = "Maximum order of branching, counted from the nodes that a level begins with, which "
            "have order 0; 0 = no limit."},
    {KEY_OF(ElementParams, growth.min_angle, "min_angle", KEY_FLOAT), .high = 180,
     .unit = "degrees",
     .doc = "Minimum angle between a branching child and its parent's direction; 0 = off."},
    {KEY_OF(ElementParams, growth.max_angle, "max_angle", KEY_FLOAT), .high = 180,
     .unit = "degrees",
     .doc = "Maximum angle between a child and its parent's direction; 0 = off."},
    {KEY_OF(ElementParams, growth.cone_angle, "cone_angle", KEY_FLOAT), .high = 180,
     .unit = "degrees", .doc = "Maximum angle between a child and cone_axis; 0 = off."},
    {KEY_OF(ElementParams, growth.cone_axis, "cone_axis", KEY_VECTOR), .count = 3,
     .doc = "Axis that cone_angle is measured from; any length."},
    {KEY_OF(ElementParams, growth.noise, "noise", KEY_FLOAT), .high = 100,
     .doc = "Gaussian noise added to each component of the direction, for levels that set none."},
    {KEY_OF(ElementParams, growth.tropism, "tropism", KEY_VECTOR), .count = 3, .low = -1000,
     .high = 1000, .doc = "Constant pull, added to the unit direction: [0, 1, 0] is up."},
    {KEY_OF(ElementParams, growth.apical, "apical", KEY_FLOAT), .high = 1,
     .doc = "Apical dominance: probability that a side branch is suppressed."},
    {KEY_OF(ElementParams, growth.sector_angle, "sector_angle", KEY_FLOAT), .high = 180,
     .unit = "degrees", .doc = "Width of a sector, for the rule sectors; 0 = 60."},
    {KEY_OF(ElementParams, growth.sector_axis, "sector_axis", KEY_BOOL),
     .doc = "Grow along a sector's axis instead of the mean of its pulls."},
    {KEY_OF(ElementParams, growth.field_weight, "field_weight", KEY_FLOAT), .low = -1000,
     .high = 1000,
     .doc = "Weight of the guide fields relative to the attractors' pull; 0 = no effect."},
    {KEY_OF(ElementParams, growth.field_mode, "field_mode", KEY_ENUM), .names = FIELD_MODES,
     .doc = "steer: the field turns the direction, and steps keep their length; additive: the "
            "field's vector is added to the new position."},
    {KEY_OF(ElementParams, growth.max_steps, "max_steps", KEY_INT64), .high = 1e9,
     .doc = "Maximum number of steps per level; 0 = no limit."},
    {KEY_OF(ElementParams, growth.max_nodes, "max_nodes", KEY_INT64), .high = 2147483647,
     .doc = "Maximum number of nodes; 0 = no limit."},
    {0},
};

const Table growth_table = {
    .name = "growth",
    .doc = "How an element grows toward its attractors (space colonization): in each step every "
           "attractor pulls the node nearest to it, and each pulled node adds a child.",
    .example = "objects:\n"
               "  - name: windswept\n"
               "    tree: {crown: {growth: {tropism: [0.8, 0.2, 0], noise: 0.3, max_angle: 70}}}\n",
    .size = sizeof(ElementParams),
    .keys = GROWTH_KEYS,
    .check = check_growth};
