// Broken things.
#include "objects/common/tables.h"
#include "objects/fracture/fracture.h"

static const Key FRACTURE_KEYS[] = {
    {KEY_OF(FractureParams, impacts, "impacts", KEY_INT), .low = 1, .high = 10000,
     .doc = "Number of points, spread over the surface, where cracks start."},
    {KEY_OF(FractureParams, attractors, "attractors", KEY_INT64), .low = 1, .high = 1e5,
     .doc = "Number of attractors of the cracks, if growth.levels is omitted; more give smaller "
            "pieces."},
    {KEY_OF(FractureParams, hollow, "hollow", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Thickness of the body's wall; 0 = solid."},
    {KEY_OF(FractureParams, gap, "gap", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Width of the cracks, which is removed from the pieces; 0 = the pieces fit together."},
    {KEY_OF(FractureParams, roughness, "roughness", KEY_FLOAT), .high = 0.2,
     .doc = "Height of the bumps on broken faces, relative to the largest extent."},
    {KEY_OF(FractureParams, weathering, "weathering", KEY_FLOAT), .high = 0.2,
     .doc = "Height of the bumps on the outside, relative to the largest extent."},
    {KEY_OF(FractureParams, explode, "explode", KEY_FLOAT), .high = 100,
     .doc = "How far pieces are moved apart, relative to their distance from the centre."},
    {KEY_OF(FractureParams, turn, "turn", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Maximum angle by which pieces are turned."},
    {KEY_OF(FractureParams, missing, "missing", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the pieces that are missing."},
    {KEY_OF(FractureParams, resolution, "resolution", KEY_INT), .low = 16, .high = 1000,
     .doc = "Voxels of the level sets along the largest extent; up to 480 are used where the body "
            "or its wall is thin."},
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
    .doc = "A body split into the cells of a network of cracks grown over it. The envelope is the "
           "body. Materials: the object's material outside, inside_material on broken faces.",
    .example =
        "objects:\n"
        "  - name: ball\n"
        "    fracture: {envelope: [{shape: sphere, size: 1}], attractors: 120, explode: 0.3}\n",
    .size = sizeof(FractureParams),
    .keys = FRACTURE_KEYS,
    .defaults = fracture_defaults,
    .check = check_fracture};
