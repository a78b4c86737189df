// The table of settled snow.
#include "config/table.h"
#include "objects/common/snow.h"

static const Key SNOW_KEYS[] = {
    {KEY_OF(SnowParams, depth, "depth", KEY_FLOAT), .high = 10, .unit = "m",
     .doc =
         "Depth of the snow on a level place under the open sky; thin twigs bear less, and so do "
         "branches under others. 0 = no snow."},
    {KEY_OF(SnowParams, steepest, "steepest", KEY_FLOAT), .flags = KEY_ABOVE, .high = 85,
     .unit = "degrees",
     .doc = "Slope from which it slides off: 35 for powder, 65 for wet snow that clings."},
    {KEY_OF(SnowParams, gaps, "gaps", KEY_FLOAT), .high = 1,
     .doc = "Share of the branches that have lost theirs to wind and sun."},
    {KEY_OF(SnowParams, bridging, "bridging", KEY_FLOAT), .high = 1, .unit = "m",
     .doc = "Widest gap between twigs or needles that the snow spans: 0.15 after calm, moist snow, "
            "0.05 for powder. Pillows on boughs are as thick as half their width, up to depth."},
    {KEY_OF(SnowParams, crumbs, "crumbs", KEY_FLOAT), .high = 1, .unit = "m",
     .doc = "Size of the largest crumbs of snow that lie on needles and twigs beside the pillows "
            "and fray their rims, of plants with sprays: 0.02 to 0.04 where a tree is seen from "
            "near; 0 = none."},
    {KEY_OF(SnowParams, fray, "fray", KEY_FLOAT), .high = 1,
     .doc = "How uneven pillows on boughs are: 0 = smooth, for trees far away; 1 = their surface "
            "shows twigs and clods and their rims are ragged, in twice as fine a mesh, for trees "
            "that are seen from near."},
    {0},
};

SnowParams snow_params_default(void)
{
    return (SnowParams){.steepest = 58.0f, .gaps = 0.25f, .bridging = 0.12f};
}

static void snow_defaults(void *out)
{
    *(SnowParams *)out = snow_params_default();
}

const Table snow_table = {.name = "snow",
                          .doc = "Snow that has settled on the branches.",
                          .example = "objects:\n"
                                     "  - name: spruce\n"
                                     "    tree: {species: norway_spruce, height: 18, snow: {depth: "
                                     "0.08}}\n",
                          .size = sizeof(SnowParams),
                          .keys = SNOW_KEYS,
                          .defaults = snow_defaults};
