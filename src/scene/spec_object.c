// Keys of objects: name, seed and the kinds.
#include "scene/scene.h"
#include "scene/spec.h"

static const Key CLEAR_OF_KEYS[] = {
    {KEY_OF(ClearOf, object, "object", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc =
         "Name of the object whose surface is kept clear. Leaves and other copies do not count."},
    {KEY_OF(ClearOf, distance, "distance", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Distance between that surface and the axes of this object's branches."},
    {KEY_OF(ClearOf, within, "within", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc =
         "Grow only this near to that surface, as ivy does on a trunk and lichen on a terrain; 0 = "
         "anywhere."},
    {0},
};

static void clear_of_defaults(void *out)
{
    *(ClearOf *)out = (ClearOf){.distance = 0.02f};
}

static const Table CLEAR_OF_TABLE = {
    .name = "clear_of",
    .doc = "An obstacle: another object, whose surface this object grows around. It grows first.",
    .example = "objects:\n"
               "  - name: rock\n"
               "    shape: {envelope: [{shape: sphere, size: [1, 1, 1], position: [1, 1, 0]}]}\n"
               "  - name: tree\n"
               "    tree: {height: 5}\n"
               "    clear_of: [{object: rock, distance: 0.1}]\n",
    .size = sizeof(ClearOf),
    .keys = CLEAR_OF_KEYS,
    .defaults = clear_of_defaults};

static const Key CONTEST_KEYS[] = {
    {KEY_OF(Contest, group, "group", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the contest: all objects that give it share their space."},
    {KEY_OF(Contest, gap, "gap", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000, .unit = "m",
     .doc = "Distance from this object's branches to those of its rivals, between their axes."},
    {0},
};

static void contest_defaults(void *out)
{
    *(Contest *)out = (Contest){.gap = 0.1f};
}

static const Table CONTEST_TABLE = {
    .name = "contest",
    .doc = "A contest for space: its objects grow at the same time, one step each in turn, in the "
           "scene's order. An attractor pulls only the nearest of all their nodes, and whoever "
           "reaches it first takes it.",
    .example = "objects:\n"
               "  - name: left\n"
               "    tree: {position: [-1.5, 0, 0]}\n"
               "    contest: {group: grove, gap: 0.2}\n"
               "  - name: right\n"
               "    tree: {position: [1.5, 0, 0]}\n"
               "    contest: {group: grove, gap: 0.2}\n",
    .size = sizeof(Contest),
    .keys = CONTEST_KEYS,
    .defaults = contest_defaults};

static const Key OBJECT_KEYS[] = {
    {KEY_OF(SceneObject, name, "name", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Unique name, used in messages, targets and paths of keys. The object's random numbers "
            "depend on it."},
    {KEY_OF(SceneObject, seed, "seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of this object; 0 = derived from the scene's seed and the object's name."},
    {KEY_OF(SceneObject, species_targets, "species_targets", KEY_BOOL),
     .doc =
         "Do the targets of its species hold for it? false for a fallen, felled or broken plant, "
         "which no longer has its species' measures; targets of the scene itself stay."},
    {KEY_OF(SceneObject, clear_of, "clear_of", KEY_LIST),
     .count_offset = offsetof(SceneObject, clear_of_count), .count = 16, .table = &CLEAR_OF_TABLE,
     .doc = "Obstacles: objects that grow first and that this one keeps clear of (outtree, tree, "
            "coral, frost, sculpture, vessels)."},
    {KEY_OF(SceneObject, deform, "deform", KEY_LIST),
     .count_offset = offsetof(SceneObject, deform_count), .count = 16, .table = &deform_table,
     .doc = "Deformations that carry the object from the form in which it grew, in this order "
            "(outtree, tree, lightning, lsystem, sculpture, skeleton, dla, mesh, shape). Growth "
            "does not depend on them, so an animation of them keeps every branch."},
    {KEY_OF(SceneObject, contest, "contest", KEY_POINTER), .table = &CONTEST_TABLE,
     .doc = "Contest for space with other objects (outtree, tree, coral, frost, sculpture)."},
    {0},
};

static void object_defaults(void *out)
{
    *(SceneObject *)out = (SceneObject){.species_targets = true};
}

static const Variant *object_variant(int index)
{
    const Kind *kind = kind_at(index);
    return kind ? &kind->variant : NULL;
}

const Table object_table = {
    .name = "object",
    .doc = "An object of the scene: a name, exactly one of the kinds below (the keys that link to "
           "a section), and the names of materials that replace the default ones.",
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
    .variant = object_variant,
    .variant_offset = offsetof(SceneObject, kind),
    .defaults = object_defaults};
