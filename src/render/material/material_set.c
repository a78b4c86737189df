#include "render/material/material_set.h"

#include "base/memory.h"

#include <stdlib.h>

// Narrower lobes than this are mirrors, or, where a mirror cannot mix with other lobes, this wide.
static const float LEAST_ALPHA = 1e-3f;

static bool prepare_table(MaterialEntry *entry, Error *e)
{
    const Material *m = &entry->material;
    float roughness = clampf(m->roughness, 0.0f, 1.0f);
    float alpha = roughness * roughness;
    if (m->kind == MATERIAL_DIFFUSE || m->kind == MATERIAL_EMISSION ||
        m->kind == MATERIAL_THIN_FILM) {
        return true;
    }
    bool mirror =
        alpha < LEAST_ALPHA && (m->kind == MATERIAL_CONDUCTOR || m->kind == MATERIAL_DIELECTRIC);
    entry->alpha = mirror ? 0.0f : fmaxf(alpha, LEAST_ALPHA);
    entry->table = memory_alloc_zero(1, sizeof *entry->table, e);
    if (!entry->table) {
        return false;
    }
    if (m->kind == MATERIAL_DIELECTRIC) {
        ggx_table_dielectric(entry->table, fmaxf(alpha, LEAST_ALPHA), m->ior);
    } else {
        ggx_table_reflection(entry->table, fmaxf(alpha, LEAST_ALPHA));
    }
    return true;
}

static bool open_texture(MaterialSet *set, const Material *m, const char *key, const char *file,
                         Texture **texture, Error *e)
{
    if (!file || !file[0]) {
        return true;
    }
    if (!set->textures) {
        set->textures = texture_cache_new(e);
    }
    *texture = set->textures ? texture_open(set->textures, file, e) : NULL;
    if (!*texture) {
        error_prefix(e, "material '%s': ", m->name);
        error_key(e, "materials.%s.%s", m->name, key);
    }
    return *texture != NULL;
}

static bool prepare_film(MaterialSet *set, const Material *m, Error *e)
{
    if (m->kind == MATERIAL_THIN_FILM && !set->films) {
        set->films = thin_film_table_new(e);
        return set->films != NULL;
    }
    return true;
}

static bool prepare_entry(MaterialSet *set, MaterialEntry *entry, const Material *material,
                          bool used, Error *e)
{
    entry->material = *material;
    Material *m = &entry->material;
    m->ior = fmaxf(m->ior, 1e-3f);
    if (fabsf(m->ior - 1.0f) < 1e-3f) { // no facet bends light: keep away from 0 / 0
        m->ior = 1.001f;
    }
    m->color = vec3_max(vec3_min(m->color, vec3_splat(1.0f)), vec3_splat(0.0f));
    entry->plain = m->kind == MATERIAL_DIFFUSE && m->pattern == PATTERN_NONE &&
                   m->variation <= 0.0f && !(m->texture && m->texture[0]);
    return (!used || (prepare_table(entry, e) && prepare_film(set, m, e))) &&
           open_texture(set, m, "texture", m->texture, &entry->color, e) &&
           open_texture(set, m, "alpha_texture", m->alpha_texture, &entry->opacity, e);
}

MaterialSet *material_set_new(const Material *materials, const bool *used, int count, Error *e)
{
    MaterialSet *set = memory_alloc_zero(1, sizeof *set, e);
    if (!set) {
        return NULL;
    }
    set->entry = memory_alloc_zero(count, sizeof *set->entry, e);
    bool done = set->entry != NULL;
    set->count = done ? count : 0;
    for (int i = 0; done && i < count; i++) {
        done = prepare_entry(set, &set->entry[i], &materials[i], !used || used[i], e);
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
