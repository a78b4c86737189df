// Broken things.
#include "objects/common/tables.h"
#include "objects/fracture/fracture.h"

static const Key FRACTURE_KEYS[] = {
    {KEY_OF(FractureParams, impacts, "impacts", KEY_INT), .low = 1, .high = 10000,
     .doc = "Number of places, spread over the surface, where cracks begin."},
    {KEY_OF(FractureParams, attractors, "attractors", KEY_INT64), .low = 1, .high = 1e5,
     .doc =
         "Attractors of the cracks, where growth.levels are left out: more make smaller pieces."},
    {KEY_OF(FractureParams, hollow, "hollow", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Thickness of the base's wall; 0 = solid."},
    {KEY_OF(FractureParams, gap, "gap", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Width of the cracks, which is taken off the pieces; 0 = the pieces fit together."},
    {KEY_OF(FractureParams, roughness, "roughness", KEY_FLOAT), .high = 0.2,
     .doc = "Height of the bumps of the broken faces, over the largest extent."},
    {KEY_OF(FractureParams, weathering, "weathering", KEY_FLOAT), .high = 0.2,
     .doc = "Height of the bumps of the outside, over the largest extent."},
    {KEY_OF(FractureParams, explode, "explode", KEY_FLOAT), .high = 100,
     .doc = "How far pieces are moved apart: 0.3 = by 0.3 of their way from the middle."},
    {KEY_OF(FractureParams, turn, "turn", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "By how much pieces are turned at most."},
    {KEY_OF(FractureParams, missing, "missing", KEY_FLOAT), .high = 1,
     .doc = "Share of the pieces that are gone."},
    {KEY_OF(FractureParams, resolution, "resolution", KEY_INT), .low = 16, .high = 1000,
     .doc = "Voxels of the level sets along the largest extent; thin parts of the thing and of a "
            "hollow one's wall get up to 480."},
    ELEMENT_ROWS(FractureParams),
    {0},
};

static void fracture_defaults(void *out)
{
    *(FractureParams *)out = fracture_params_default();
}

static bool check_fracture(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const FractureParams *)params)->element);
}

const Table fracture_table = {
    .name = "fracture",
    .doc = "A thing split into the cells of a network of cracks grown over it. The envelope is the "
           "thing. "
           "Materials: the object's material outside, inside_material where it broke.",
    .example =
        "objects:\n"
        "  - name: ball\n"
        "    fracture: {envelope: [{shape: sphere, size: 1}], attractors: 120, explode: 0.3}\n",
    .size = sizeof(FractureParams),
    .keys = FRACTURE_KEYS,
    .defaults = fracture_defaults,
    .check = check_fracture};
