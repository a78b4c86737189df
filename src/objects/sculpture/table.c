// Hollow branch sculptures.
#include "objects/common/tables.h"
#include "objects/sculpture/sculpture.h"

static const Key SCULPTURE_KEYS[] = {
    {KEY_OF(SculptureParams, clusters, "clusters", KEY_INT), .low = 1, .high = 10000,
     .doc = "Roots, spread evenly over the surface; their clusters merge where they meet."},
    {KEY_OF(SculptureParams, attractors, "attractors", KEY_INT64), .low = 1, .high = 1e6,
     .doc = "Attractors of the shell, where growth.levels are left out: more make it finer."},
    {KEY_OF(SculptureParams, thickness, "thickness", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "spacings", .doc = "Thickness of the thinnest bars."},
    {KEY_OF(SculptureParams, contrast, "contrast", KEY_FLOAT), .low = 1, .high = 100,
     .doc = "Thickness of the thickest bar over that of the thinnest."},
    {KEY_OF(SculptureParams, reach, "reach", KEY_FLOAT), .high = 100, .unit = "spacings",
     .doc = "How far tips reach to merge with another branch."},
    ELEMENT_ROWS(SculptureParams),
    {0},
};

static void sculpture_defaults(void *out)
{
    *(SculptureParams *)out = sculpture_params_default();
}

static bool check_sculpture(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const SculptureParams *)params)->element);
}

const Table sculpture_table = {
    .name = "sculpture",
    .doc = "A hollow sculpture of branches (Tanaka et al., section 2.4): clusters grown over the "
           "envelope's surface, merged into one shell of round bars. Material: clay.",
    .example =
        "objects:\n"
        "  - name: lampshade\n"
        "    sculpture: {envelope: [{shape: ellipsoid, size: [0.2, 0.3, 0.2]}], clusters: 7}\n",
    .size = sizeof(SculptureParams),
    .keys = SCULPTURE_KEYS,
    .defaults = sculpture_defaults,
    .check = check_sculpture};
