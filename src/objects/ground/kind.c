// The ground as a kind of object.
#include "objects/kind.h"
#include "objects/ground/ground.h"
#include "render/material/material.h"

static float height(const void *params, uint64_t seed, float x, float z)
{
    return ground_height(params, seed, x, z);
}

static int64_t copies(const void *params)
{
    const GroundParams *ground = params;
    return ground->grass_tufts + ground->fallen_leaves + ground->trees.count;
}

static const char *further_material(const void *params, int index)
{
    const GroveParams *trees = &((const GroundParams *)params)->trees;
    return tree_mix_material(trees->species, trees->species_count, index);
}

static void needs(const void *params, Needs *needs)
{
    // A tuft has 66 faces close by and 16 in the distance.
    enum { TUFT_FACES = 40, LEAF_FACES = 25, TREE_BYTES = 40000000, PARTS = 10 };
    const GroundParams *ground = params;
    needs_add(needs, "grass_tufts", (double)ground->grass_tufts, // about half are rejected
              0.5 * (sizeof(Transform) + sizeof(float)));
    needs_add_copies(needs, "grass_tufts", 0.55 * (double)ground->grass_tufts, TUFT_FACES);
    needs_add_copies(needs, "fallen_leaves", (double)ground->fallen_leaves, LEAF_FACES);
    for (int i = 0; i < ground->pond_count; i++) {
        needs_add_skin(needs, "ponds", (double)pond_faces(&ground->ponds[i]));
    }
    if (ground->trees.count > 0) {
        needs_add(needs, "trees.variants", ground->trees.variants, TREE_BYTES);
        needs_add_groups(needs, "trees.count", (double)ground->trees.count, PARTS);
    }
}

static bool has_ponds(const void *params)
{
    return ((const GroundParams *)params)->pond_count > 0;
}

static bool cover(const void *params, uint64_t seed, Cover *cover, const Run *run, Error *e)
{
    (void)run;
    const GroundParams *ground = params;
    bool done = true;
    for (int i = 0; done && i < ground->pond_count; i++) {
        PondSite site = ground_pond(ground, seed, i);
        Mesh *mesh = pond_water_mesh(&site, e);
        done = mesh && cover_add(cover, mesh, e);
        mesh_free(mesh);
    }
    return done;
}

static const Material BUILTIN[] = {
    {.name = "ground",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.085f, 0.105f, 0.040f},
     .color2 = {0.110f, 0.082f, 0.052f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_GROUND,
     .pattern_depth = 0.03f},
    {.name = "fallen",
     .kind = MATERIAL_LEAF,
     .color = {0.230f, 0.130f, 0.055f},
     .color2 = {0.130f, 0.075f, 0.038f},
     .transmittance = {0.090f, 0.040f, 0.010f},
     .roughness = 0.6f,
     .specular = 0.35f,
     .ior = 1.5f,
     .pattern = PATTERN_LEAF,
     .veins = 7.0f,
     .variation = 0.7f},
    // Absorption of pure water with the dissolved matter of a clear pond, which takes blue most.
    {.name = "ground/water",
     .kind = MATERIAL_WATER,
     .color = {1.0f, 1.0f, 1.0f},
     .color2 = {0.6f, 0.6f, 0.6f},
     .absorption = {0.50f, 0.42f, 0.85f},
     .scattering = {0.05f, 0.05f, 0.04f},
     .anisotropy = 0.75f,
     .ior = 1.33f,
     .calm = 0.5f},
    {.name = "ground/bed",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.120f, 0.092f, 0.060f},
     .color2 = {0.042f, 0.036f, 0.024f},
     .roughness = 0.75f,
     .specular = 0.3f,
     .ior = 1.5f,
     .pattern = PATTERN_MUD,
     .pattern_depth = 0.012f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    LEAF_MATERIAL_ROW(1),
    GRASS_MATERIAL_ROW(2),
    SNOW_MATERIAL_ROW(GROUND_SNOW),
    WATER_MATERIAL_ROW(GROUND_WATER),
    MATERIAL_ROW(GROUND_BED, "bed_material",
                 "Material of the beds of the ground's ponds; default: "
                 "ground/bed."),
    {0},
};

const Kind kind_ground = {
    .variant = {KIND_ROW("ground", &ground_table, "Rolling ground with grass."), MATERIALS},
    .reads_water = true,
    .materials = {"ground", "fallen", "grass", "bark", "leaf", "snow", "ground/water",
                  "ground/bed"},
    .builtin = BUILTIN,
    .further_material = further_material,
    .needs = needs,
    .ground = height,
    .cover = cover,
    .is_water = has_ponds,
    .copies = copies,
    .geometry = ground_geometry};
