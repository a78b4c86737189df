// A stone as a kind of object.
#include "objects/kind.h"
#include "objects/stone/stone.h"
#include "render/material/material.h"

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    StoneParams *stone = params;
    own_space_stand(own, stone->position, stone->rotation);
    stone->position = stone->rotation = vec3(0, 0, 0);
    return true;
}

static bool geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    Mesh *mesh = stone_mesh(given, placing->recipe->seed, e);
    return placing_add(placing, (Part){.mesh = mesh}, 0, e);
}

static const Material BUILTIN[] = {
    {.name = "fieldstone",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.235f, 0.225f, 0.205f},
     .color2 = {0.125f, 0.120f, 0.105f},
     .roughness = 0.85f,
     .specular = 0.25f,
     .ior = 1.5f,
     .pattern = PATTERN_STONE,
     .pattern_scale = 0.5f,
     .pattern_depth = 0.03f,
     .variation = 0.2f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_stone = {
    .variant = {KIND_ROW("stone", &stone_table, "A stone or boulder."), MATERIALS},
    .carried = true,
    .materials = {"fieldstone"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .geometry = geometry};
