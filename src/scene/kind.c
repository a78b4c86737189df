#include "scene/kind.h"

#include "scene/kinds.h"

#include <string.h>

// In the order in which people read of them.
static const Kind *const KINDS[] = {
    // clang-format off
    &kind_tree,
    &kind_ground,
    &kind_mesh,
    &kind_shape,
    &kind_dla,
    &kind_lightning,
    &kind_coral,
    &kind_lsystem,
    &kind_frost,
    &kind_sculpture,
    &kind_terrain,
    &kind_vessels,
    &kind_venation,
    &kind_fracture,
    &kind_skeleton,
    // clang-format on
    &kind_forest,
};

int kind_count(void)
{
    return (int)(sizeof KINDS / sizeof KINDS[0]);
}

const Kind *kind_at(int index)
{
    return KINDS[index];
}

const Kind *kind_of(const SceneObject *object)
{
    for (int i = 0; i < kind_count(); i++) {
        void *params;
        memcpy(&params, (const char *)object + KINDS[i]->offset, sizeof params);
        if (params) {
            return KINDS[i];
        }
    }
    return NULL;
}

static int find_material(const World *world, const char *name)
{
    for (int i = 0; i < world->material_count; i++) {
        if (strcmp(world->material[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

int placing_material(const Placing *placing, const char *name, const char *fallback)
{
    int index = find_material(placing->world, name ? name : fallback);
    return index >= 0 ? index : 0;
}

bool placing_add_mesh(const Placing *placing, Mesh *mesh, const char *fallback, Error *e)
{
    Part part = {.kind = PART_MESH,
                 .mesh = mesh,
                 .material = placing_material(placing, placing->object->material, fallback),
                 .object = placing->index};
    return geometry_add(&placing->world->geometry, part, e);
}
