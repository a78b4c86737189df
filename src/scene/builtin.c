#include "scene/builtin.h"

#include "objects/kinds.h"

#include <string.h>

// Materials shared by several kinds. Oak bark and twig: reflectances of dry bark (0.1 to 0.2,
// reddish); leaves: PROSPECT-5, as in material_default; grass: the same, yellower.
static const Material SHARED[] = {
    {.name = "bark",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.175f, 0.135f, 0.098f},
     .color2 = {0.045f, 0.032f, 0.024f},
     .roughness = 0.85f,
     .specular = 0.25f,
     .ior = 1.5f,
     .pattern = PATTERN_BARK,
     .pattern_depth = 0.012f},
    {.name = "twig",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.130f, 0.098f, 0.068f},
     .color2 = {0.070f, 0.052f, 0.038f},
     .roughness = 0.7f,
     .specular = 0.3f,
     .ior = 1.5f},
    {.name = "leaf",
     .kind = MATERIAL_LEAF,
     .color = {0.087f, 0.149f, 0.046f},
     .color2 = {0.110f, 0.175f, 0.060f},
     .transmittance = {0.060f, 0.110f, 0.012f},
     .autumn_color = {0.330f, 0.175f, 0.035f},
     .roughness = 0.58f,
     .specular = 0.28f,
     .ior = 1.5f,
     .pattern = PATTERN_LEAF,
     .veins = 7.0f,
     .variation = 0.35f},
    {.name = "grass",
     .kind = MATERIAL_LEAF,
     .color = {0.115f, 0.165f, 0.048f},
     .color2 = {0.165f, 0.155f, 0.070f},
     .transmittance = {0.080f, 0.120f, 0.018f},
     .roughness = 0.65f,
     .specular = 0.15f,
     .ior = 1.5f,
     .variation = 0.5f},
    {.name = "clay",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.45f, 0.42f, 0.39f},
     .color2 = {0.1f, 0.1f, 0.1f},
     .roughness = 0.5f,
     .ior = 1.5f},
    {.name = ""},
};

// Entry *index of a list; if the list is shorter, returns NULL and subtracts its length from
// *index.
static const Material *entry(const Material *list, int *index)
{
    for (; list && list->name[0]; list++) {
        if ((*index)-- == 0) {
            return list;
        }
    }
    return NULL;
}

const Material *builtin_material_at(int index)
{
    const Material *found = entry(SHARED, &index);
    for (int i = 0; !found && kind_at(i); i++) {
        found = entry(kind_at(i)->builtin, &index);
    }
    return found;
}

const Material *builtin_material(const char *name)
{
    int i = 0;
    const Material *material = builtin_material_at(i);
    while (material && strcmp(material->name, name) != 0) {
        material = builtin_material_at(++i);
    }
    return material;
}
