#include "render/material/material_set.h"

#include "base/memory.h"
#include "render/material/material_ops.h"

#include <stdlib.h>

// A narrower lobe is a mirror, or this wide where it is mixed with other lobes.
static const float LEAST_ALPHA = 1e-3f;

static float alpha_of(const MaterialEntry *entry)
{
    float roughness = clampf(entry->material.roughness, 0.0f, 1.0f);
    return roughness * roughness;
}

bool material_entry_add_table(MaterialEntry *entry, Error *e)
{
    entry->alpha = fmaxf(alpha_of(entry), LEAST_ALPHA);
    entry->table = memory_alloc_zero(1, sizeof *entry->table, e);
    return entry->table;
}

bool material_entry_is_mirror(const MaterialEntry *entry)
{
    return alpha_of(entry) < LEAST_ALPHA;
}

static bool open_texture(MaterialSet *set, const Material *m, const char *key, const char *file,
                         Texture **texture, const Run *run, Error *e)
{
    if (!file || !file[0]) {
        return true;
    }
    if (!set->textures) {
        set->textures = texture_cache_new(e);
    }
    *texture = set->textures ? texture_open(set->textures, file, run, e) : NULL;
    if (!*texture) {
        error_prefix(e, "material '%s': ", m->name);
        error_key(e, "materials.%s.%s", m->name, key);
    }
    return *texture != NULL;
}

static bool prepare_entry(MaterialSet *set, MaterialEntry *entry, const Material *material,
                          bool used, const Run *run, Error *e)
{
    entry->material = *material;
    Material *m = &entry->material;
    m->ior = fmaxf(m->ior, 1e-3f);
    if (fabsf(m->ior - 1.0f) < 1e-3f) { // without refraction: avoids 0 / 0
        m->ior = 1.001f;
    }
    m->color = vec3_max(vec3_min(m->color, vec3_splat(1.0f)), vec3_splat(0.0f));
    entry->ops = material_ops(m->kind);
    entry->plain = !entry->ops->prepare && m->pattern == PATTERN_NONE && m->variation <= 0.0f &&
                   !(m->texture && m->texture[0]);
    return (!used || !entry->ops->tabulate || entry->ops->tabulate(entry, set, e)) &&
           open_texture(set, m, "texture", m->texture, &entry->color, run, e) &&
           open_texture(set, m, "alpha_texture", m->alpha_texture, &entry->opacity, run, e);
}

MaterialSet *material_set_new(const Material *materials, const bool *used, int count,
                              const Run *run, Error *e)
{
    MaterialSet *set = memory_alloc_zero(1, sizeof *set, e);
    if (!set) {
        return NULL;
    }
    set->entry = memory_alloc_zero(count, sizeof *set->entry, e);
    bool done = set->entry != NULL;
    set->count = done ? count : 0;
    for (int i = 0; done && i < count; i++) {
        done = prepare_entry(set, &set->entry[i], &materials[i], !used || used[i], run, e);
    }
    if (!done) {
        material_set_free(set);
        return NULL;
    }
    return set;
}

void material_set_free(MaterialSet *set)
{
    if (!set) {
        return;
    }
    for (int i = 0; i < set->count; i++) {
        free(set->entry[i].table);
    }
    free(set->entry);
    texture_cache_free(set->textures);
    thin_film_table_free(set->films);
    free(set);
}

float material_opacity(const MaterialSet *set, int material, Vec2 uv)
{
    const MaterialEntry *entry = &set->entry[material];
    return entry->opacity ? texture_opacity(entry->opacity, uv) : 1.0f;
}
