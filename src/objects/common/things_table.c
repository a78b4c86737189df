// The keys of things.
#include "config/load.h"
#include "objects/common/things.h"
#include "objects/kinds.h"

// What stands alone can be copied: not land, nor what depends on other objects.
static bool can_be_copied(const Kind *kind)
{
    return !kind->ground && !kind->heights && !kind->over && !kind->further_material &&
           !kind->reads_scene;
}

static const Variant *thing_variant(int index)
{
    for (int i = 0; kind_at(i); i++) {
        if (can_be_copied(kind_at(i)) && index-- == 0) {
            return &kind_at(i)->variant;
        }
    }
    return NULL;
}

static const Key THING_KEYS[] = {
    {KEY_OF(Thing, share, "share", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .doc = "Share of the copies, relative to the other things'."},
    {0},
};

static void thing_defaults(void *out)
{
    *(Thing *)out = (Thing){.share = 1.0f};
}

const Table thing_table = {
    .name = "thing",
    .doc = "What is copied: exactly one of the kinds below, as an object of the scene but "
           "without a name, and the names of its materials. It stands on each place as it would "
           "stand on the origin.",
    .example = "objects:\n"
               "  - name: stones\n"
               "    scatter:\n"
               "      count: 300\n"
               "      things:\n"
               "        - {share: 3, stone: {size: 0.12}}\n"
               "        - {share: 1, tree: {species: hazel, height: 2}}\n",
    .size = sizeof(Thing),
    .keys = THING_KEYS,
    .variant = thing_variant,
    .variant_offset = offsetof(SceneObject, kind),
    .defaults = thing_defaults};
