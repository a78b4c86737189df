// Hollow branch sculptures.
#include "objects/common/tables.h"
#include "objects/sculpture/sculpture.h"

static const Key SCULPTURE_KEYS[] = {
    {KEY_OF(SculptureParams, clusters, "clusters", KEY_INT), .low = 1, .high = 10000,
     .doc =
         "Number of roots, spread evenly over the surface; their clusters merge where they meet."},
    {KEY_OF(SculptureParams, attractors, "attractors", KEY_INT64), .low = 1, .high = 1e6,
     .doc = "Number of attractors of the shell, if growth.levels is omitted; more give a finer "
            "structure."},
    {KEY_OF(SculptureParams, thickness, "thickness", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "spacings", .doc = "Thickness of the thinnest bars."},
    {KEY_OF(SculptureParams, contrast, "contrast", KEY_FLOAT), .low = 1, .high = 100,
     .doc = "Ratio of the thickest bar's thickness to that of the thinnest."},
    {KEY_OF(SculptureParams, reach, "reach", KEY_FLOAT), .high = 100, .unit = "spacings",
     .doc = "Maximum distance over which a tip merges with another branch."},
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
    .doc = "A hollow sculpture of branches (Tanaka et al., section 2.4): clusters grow over the "
           "envelope's surface and merge into one shell of round bars. Material: clay.",
    .example =
        "objects:\n"
        "  - name: lampshade\n"
        "    sculpture: {envelope: [{shape: ellipsoid, size: [0.2, 0.3, 0.2]}], clusters: 7}\n",
    .size = sizeof(SculptureParams),
    .keys = SCULPTURE_KEYS,
    .defaults = sculpture_defaults,
    .check = check_sculpture};
