#include "render/material_set.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static bool check_supported(const Material *materials, int count, Error *e)
{
    for (int i = 0; i < count; i++) {
        const Material *m = &materials[i];
        bool ready =
            m->kind == MATERIAL_DIFFUSE || m->kind == MATERIAL_LEAF || m->kind == MATERIAL_EMISSION;
        if (!ready || m->texture || m->alpha_texture) {
            return error_set(e, ERROR_INPUT,
                             "material '%s': only untextured diffuse, leaf and emission exist yet",
                             m->name);
        }
    }
    return true;
}

MaterialSet *material_set_new(const Material *materials, int count, Error *e)
{
    if (!check_supported(materials, count, e)) {
        return NULL;
    }
    MaterialSet *set = memory_alloc_zero(1, sizeof *set, e);
    if (!set) {
        return NULL;
    }
    set->count = count;
    set->material = memory_alloc(count, sizeof *set->material, e);
    if (!set->material) {
        material_set_free(set);
        return NULL;
    }
    memcpy(set->material, materials, (size_t)count * sizeof *materials);
    return set;
}

void material_set_free(MaterialSet *set)
{
    if (!set) {
        return;
    }
    free(set->material);
    free(set);
}

float material_opacity(const MaterialSet *set, int material, Vec2 uv)
{
    (void)set;
    (void)material;
    (void)uv;
    return 1.0f;
}
