#include "scene/kind.h"

#include "scene/kinds.h"

#include <string.h>

#define KIND_POINTER(NAME) &kind_##NAME,
static const Kind *const ALL[] = {KINDS(KIND_POINTER)};

const Kind *kind_at(int index)
{
    return index < (int)(sizeof ALL / sizeof ALL[0]) ? ALL[index] : NULL;
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

int placing_material(const Placing *placing, int index)
{
    const SceneObject *object = placing->object;
    const char *name = object->material[index];
    int found = find_material(placing->world, name ? name : object->kind->materials[index]);
    return found >= 0 ? found : 0;
}

bool placing_add_mesh(const Placing *placing, Mesh *mesh, Error *e)
{
    Part part = {.kind = PART_MESH,
                 .mesh = mesh,
                 .material = placing_material(placing, 0),
                 .object = placing->index};
    return geometry_add(&placing->world->geometry, part, e);
}
