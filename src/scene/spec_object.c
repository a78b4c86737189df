// Keys of objects: name, seed and the kinds.
#include "scene/scene.h"
#include "scene/spec.h"

static const Key OBJECT_KEYS[] = {
    {KEY_OF(SceneObject, name, "name", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Unique name, used in messages, targets and paths of keys. The object's random numbers "
            "depend on it."},
    {KEY_OF(SceneObject, seed, "seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of this object; 0 = derived from the scene's seed and the object's name."},
    {0},
};

static void object_defaults(void *out)
{
    *(SceneObject *)out = (SceneObject){0};
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
