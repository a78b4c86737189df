// Objects: what kinds there are, and the small ones.
#include "scene/scene.h"
#include "scene/spec_check.h"

static const Key GROVE_KEYS[] = {
    {KEY_OF(GroveParams, count, "count", KEY_INT), .high = 1e6, .doc = "How many trees; 0 = none."},
    {KEY_OF(GroveParams, inner, "inner", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Least distance from the origin."},
    {KEY_OF(GroveParams, outer, "outer", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6, .unit = "m",
     .doc = "Largest distance from the origin."},
    {KEY_OF(GroveParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Height of the tallest trees."},
    {KEY_OF(GroveParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "0 = even, 1 = in woods with open land between."},
    {KEY_OF(GroveParams, variants, "variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "How many different trees are grown; all others are copies."},
    {KEY_OF(GroveParams, bare, "bare", KEY_BOOL), .doc = "Without leaves, as in winter."},
    {0},
};

static const Table GROVE_TABLE = {.name = "grove",
                                  .doc = "Woods in the distance: copies of a few trees.",
                                  .size = sizeof(GroveParams),
                                  .keys = GROVE_KEYS,
                                  .check = check_grove};

static const Key GROUND_KEYS[] = {
    {KEY_OF(GroundParams, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m", .doc = "How far the land goes, to the horizon."},
    {KEY_OF(GroundParams, relief, "relief", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Height of the hills."},
    {KEY_OF(GroundParams, wavelength, "wavelength", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m", .doc = "Distance from hill to hill."},
    {KEY_OF(GroundParams, flat_radius, "flat_radius", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Radius about the origin that stays flat, at height 0, where the subject stands."},
    {KEY_OF(GroundParams, grass_tufts, "grass_tufts", KEY_INT64), .high = 1e9,
     .doc = "Tufts of grass; 0 = none."},
    {KEY_OF(GroundParams, grass_radius, "grass_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5,
     .unit = "m",
     .doc = "Radius about grass_center that bears grass; it thins out toward the rim."},
    {KEY_OF(GroundParams, grass_center, "grass_center", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Middle of the grass."},
    {KEY_OF(GroundParams, grass_height, "grass_height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Height of the tallest blades."},
    {KEY_OF(GroundParams, grass_clumping, "grass_clumping", KEY_FLOAT), .high = 1,
     .doc = "0 = even, 1 = in patches."},
    {KEY_OF(GroundParams, grass_variants, "grass_variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "How many different tufts there are."},
    {KEY_OF(GroundParams, fallen_leaves, "fallen_leaves", KEY_INT64), .high = 1e9,
     .doc = "Leaves that lie about the origin; 0 = none."},
    {KEY_OF(GroundParams, fallen_radius, "fallen_radius", KEY_FLOAT), .flags = KEY_ABOVE,
     .high = 1e5, .unit = "m", .doc = "How far fallen leaves lie."},
    {KEY_OF(GroundParams, trees, "trees", KEY_GROUP), .table = &GROVE_TABLE,
     .doc = "Woods in the distance: copies of a few trees."},
    {0},
};

static void ground_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    (void)kind;
    *(GroundParams *)out = ground_params_default();
}

static const Table GROUND_TABLE = {
    .name = "ground",
    .doc =
        "Gently rolling land with grass on it, out to the horizon. Neither grass nor trees stand "
        "in "
        "water: a `medium` of water, or a shape or mesh of a material with the pattern `water` or "
        "of a dielectric with water's index. Materials: ground, grass, fallen.",
    .example =
        "objects:\n"
        "  - name: meadow\n"
        "    ground: {grass_tufts: 80000, grass_radius: 30, relief: 8, trees: {count: 300}}\n",
    .size = sizeof(GroundParams),
    .keys = GROUND_KEYS,
    .defaults = ground_defaults,
    .check = check_ground};

static const Key MESH_KEYS[] = {
    {KEY_OF(SceneMesh, file, "file", KEY_FILE), .flags = KEY_REQUIRED,
     .doc = "OBJ, PLY, STL, glTF or GLB file, relative to the scene's folder."},
    {KEY_OF(SceneMesh, smooth, "smooth", KEY_BOOL),
     .doc = "Make smooth normals when the file has none."},
    {KEY_OF(PlacedMesh, position, "position", KEY_VECTOR), .flags = KEY_VIRTUAL, .count = 3,
     .unit = "m", .doc = "Where the mesh's origin goes."},
    {KEY_OF(PlacedMesh, rotation, "rotation", KEY_VECTOR), .flags = KEY_VIRTUAL, .count = 3,
     .unit = "degrees", .doc = "Turns about x, then y, then z."},
    {KEY_OF(PlacedMesh, scale, "scale", KEY_VECTOR), .flags = KEY_VIRTUAL | KEY_SPLAT, .count = 3,
     .doc = "Factors along x, y and z, before the turns; negative ones mirror."},
    {KEY_OF(SceneMesh, transform, "transform", KEY_AFFINE), .flags = KEY_HIDDEN, .doc = ""},
    {0},
};

static void mesh_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    (void)kind;
    *(PlacedMesh *)out =
        (PlacedMesh){.mesh = {.transform = transform_identity()}, .scale = {1, 1, 1}};
}

static const Table MESH_TABLE = {
    .name = "mesh",
    .doc = "A mesh that another program made. Material: clay, if the object names no other.",
    .size = sizeof(SceneMesh),
    .defaults_size = sizeof(PlacedMesh),
    .keys = MESH_KEYS,
    .defaults = mesh_defaults,
    .check = check_mesh};

static const Key SOLID_KEYS[] = {
    {KEY_OF(SceneShape, shapes, "envelope", KEY_LIST),
     .count_offset = offsetof(SceneShape, shape_count), .flags = KEY_REQUIRED, .low = 1,
     .count = 1000, .table = &shape_table,
     .doc = "Shapes joined, cut and intersected in this order."},
    {KEY_OF(SceneShape, voxel, "voxel", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Voxel size where it is not one plain shape; 0 = 1/128 of the largest extent."},
    {0},
};

static void solid_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    (void)kind;
    *(SceneShape *)out = (SceneShape){0};
}

static const Table SOLID_TABLE = {
    .name = "solid",
    .doc = "Spheres, boxes, bodies and what they cut out of each other, drawn as they are. "
           "Material: clay, if the object names no other.",
    .example = "objects:\n"
               "  - name: bowl\n"
               "    shape:\n"
               "      envelope:\n"
               "        - {shape: sphere, size: 0.5}\n"
               "        - {shape: sphere, size: 0.45, op: difference}\n"
               "        - {shape: half_space, op: intersection}\n",
    .size = sizeof(SceneShape),
    .keys = SOLID_KEYS,
    .defaults = solid_defaults,
    .check = check_envelope};

static const Key OBJECT_KEYS[] = {
    {KEY_OF(SceneObject, name, "name", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "What messages, targets, --set and the object's random numbers go by; no two objects "
            "have the same."},
    {KEY_OF(SceneObject, seed, "seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of this object; 0 = from the scene's seed and the object's name."},
    {KEY_OF(SceneObject, tree, "tree", KEY_POINTER), .table = &tree_table,
     .doc = "A tree; left out keys make an oak."},
    {KEY_OF(SceneObject, coral, "coral", KEY_POINTER), .table = &coral_table,
     .doc = "Corals: an L-system's directions that fight for room."},
    {KEY_OF(SceneObject, lsystem, "lsystem", KEY_POINTER), .table = &lsystem_table,
     .doc = "A plant written as an L-system."},
    {KEY_OF(SceneObject, vessels, "vessels", KEY_POINTER), .table = &vessels_table,
     .doc = "Arteries and veins that fill an organ or a body."},
    {KEY_OF(SceneObject, forest, "forest", KEY_POINTER), .table = &forest_table,
     .doc = "Stands of trees over the land, with ferns."},
    {KEY_OF(SceneObject, ground, "ground", KEY_POINTER), .table = &GROUND_TABLE,
     .doc = "Ground to stand on, with grass."},
    {KEY_OF(SceneObject, frost, "frost", KEY_POINTER), .table = &frost_table,
     .doc = "Frost on a window pane or a soap bubble."},
    {KEY_OF(SceneObject, mesh, "mesh", KEY_POINTER), .table = &MESH_TABLE,
     .doc = "An imported mesh."},
    {KEY_OF(SceneObject, shape, "shape", KEY_POINTER), .table = &SOLID_TABLE,
     .doc = "Spheres, boxes, ... drawn as they are."},
    {KEY_OF(SceneObject, dla, "dla", KEY_POINTER), .table = &dla_table,
     .doc = "A dendrite of metal, by diffusion-limited aggregation."},
    {KEY_OF(SceneObject, lightning, "lightning", KEY_POINTER), .table = &lightning_table,
     .doc = "Bolts in the air, or discharges over a surface."},
    {KEY_OF(SceneObject, sculpture, "sculpture", KEY_POINTER), .table = &sculpture_table,
     .doc = "A hollow branch sculpture."},
    {KEY_OF(SceneObject, terrain, "terrain", KEY_POINTER), .table = &terrain_table,
     .doc = "Mountains, valleys and rivers."},
    {KEY_OF(SceneObject, water_material, "water_material", KEY_TEXT),
     .doc = "Material of a terrain's lakes and rivers; left out: lake."},
    {KEY_OF(SceneObject, venation, "venation", KEY_POINTER), .table = &venation_table,
     .doc = "A leaf and its veins."},
    {KEY_OF(SceneObject, fracture, "fracture", KEY_POINTER), .table = &fracture_table,
     .doc = "A thing broken along grown cracks."},
    {KEY_OF(SceneObject, skeleton, "skeleton", KEY_POINTER), .table = &skeleton_table,
     .doc = "A neuron or another out-tree from an SWC file."},
    {KEY_OF(SceneObject, material, "material", KEY_TEXT),
     .doc = "Material of the whole, or of a tree's bark; left out: what the kind usually has, as "
            "bark, ground, coral, ice; clay for a mesh or a shape."},
    {KEY_OF(SceneObject, twig_material, "twig_material", KEY_TEXT),
     .doc = "Material of a tree's twigs; left out: twig."},
    {KEY_OF(SceneObject, leaf_material, "leaf_material", KEY_TEXT),
     .doc = "Material of a tree's leaves, or of those that lie on the ground; left out: leaf, "
            "fallen."},
    {KEY_OF(SceneObject, rime_material, "rime_material", KEY_TEXT),
     .doc = "Material of frost that is white with enclosed air; left out: rime."},
    {KEY_OF(SceneObject, polyp_material, "polyp_material", KEY_TEXT),
     .doc = "Material of a coral's cups; left out: coral_polyp."},
    {KEY_OF(SceneObject, rock_material, "rock_material", KEY_TEXT),
     .doc = "Material of the rock that a coral grows on; left out: reef_rock."},
    {KEY_OF(SceneObject, grass_material, "grass_material", KEY_TEXT),
     .doc = "Material of the ground's grass; left out: grass."},
    {KEY_OF(SceneObject, inside_material, "inside_material", KEY_TEXT),
     .doc = "Material of the faces that broke; left out: broken."},
    {KEY_OF(SceneObject, vein_material, "vein_material", KEY_TEXT),
     .doc = "Material of veins; left out: vein."},
    {KEY_OF(SceneObject, axon_material, "axon_material", KEY_TEXT),
     .doc = "Material of a skeleton's axon; left out: that of the rest."},
    {0},
};

static void object_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    (void)kind;
    *(SceneObject *)out = (SceneObject){0};
}

const Table object_table = {
    .name = "object",
    .doc = "One thing of the scene: a name, exactly one of the kinds below (those that lead to a "
           "section), and the names of its materials if they are not the usual ones.",
    .example = "objects:\n"
               "  - name: land\n"
               "    ground: {relief: 10}\n"
               "  - name: birch\n"
               "    seed: 12\n"
               "    tree: {height: 9}\n"
               "    material: pale_bark\n"
               "materials:\n"
               "  - {name: pale_bark, kind: diffuse, color: 0.6}\n",
    .size = sizeof(SceneObject),
    .keys = OBJECT_KEYS,
    .defaults = object_defaults,
    .check = check_object};
