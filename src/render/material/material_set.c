#include "render/material/material_set.h"

#include "base/memory.h"
#include "render/material/maps.h"
#include "render/material/mask.h"
#include "render/material/material_ops.h"
#include "render/material/pattern.h"

#include <stdlib.h>
#include <string.h>

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

static bool open_textures(MaterialSet *set, MaterialEntry *entry, const Run *run, Error *e)
{
    const Material *m = &entry->material;
    return open_texture(set, m, "texture", m->texture, &entry->color, run, e) &&
           open_texture(set, m, "alpha_texture", m->alpha_texture, &entry->opacity, run, e) &&
           open_texture(set, m, "normal_texture", m->normal_texture, &entry->normal, run, e) &&
           open_texture(set, m, "roughness_texture", m->roughness_texture, &entry->roughness, run,
                        e) &&
           open_texture(set, m, "transmittance_texture", m->transmittance_texture,
                        &entry->transmittance, run, e) &&
           open_texture(set, m, "displacement_texture", m->displacement_texture,
                        &entry->displacement, run, e);
}

// The tables of a surface whose roughness differs from place to place.
static bool tabulate_roughness(MaterialEntry *entry, bool mixed, Error *e)
{
    bool varied = entry->roughness || pattern_varies_roughness(&entry->material);
    if (!mixed && (!varied || !entry->table)) {
        return true;
    }
    entry->rough_tables = memory_alloc_zero(ROUGH_TABLES, sizeof *entry->rough_tables, e);
    for (int i = 0; entry->rough_tables && i < ROUGH_TABLES; i++) {
        float roughness = (float)i / (float)(ROUGH_TABLES - 1);
        ggx_table_reflection(&entry->rough_tables[i], fmaxf(roughness * roughness, LEAST_ALPHA));
    }
    return entry->rough_tables;
}

static int find_material(const Material *materials, int count, const char *name)
{
    int found = 0;
    while (found < count && strcmp(materials[found].name, name) != 0) {
        found++;
    }
    return found;
}

// Finds the materials of the layers. *coated: does the surface have a coat anywhere?
static bool find_layers(MaterialEntry *entry, const Material *materials, int count, bool *coated,
                        Error *e)
{
    const Material *m = &entry->material;
    *coated = m->layer_count > 0 && m->kind == MATERIAL_PRINCIPLED;
    if (m->layer_count == 0) {
        return true;
    }
    entry->layer = memory_alloc(m->layer_count, sizeof *entry->layer, e);
    for (int i = 0; entry->layer && i < m->layer_count; i++) {
        int found = find_material(materials, count, m->layers[i].material);
        if (found == count) {
            return error_set(e, ERROR_INPUT, "material '%s' has a layer of '%s', which is none",
                             m->name, m->layers[i].material);
        }
        entry->layer[i] = found;
        *coated = *coated || materials[found].kind == MATERIAL_PRINCIPLED;
    }
    return entry->layer;
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
    entry->mapped = maps_are_given(m);
    entry->plain = !entry->ops->prepare && m->pattern == PATTERN_NONE && m->variation <= 0.0f &&
                   !entry->mapped && m->layer_count == 0;
    return (!used || !entry->ops->tabulate || entry->ops->tabulate(entry, set, e)) &&
           open_textures(set, entry, run, e);
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
        MaterialEntry *entry = &set->entry[i];
        bool shown = !used || used[i], coated = false;
        done = prepare_entry(set, entry, &materials[i], shown, run, e) &&
               find_layers(entry, materials, count, &coated, e) &&
               tabulate_roughness(entry, shown && coated, e);
    }
    if (!done) {
        material_set_free(set);
        return NULL;
    }
    return set;
}

void material_set_use_masks(MaterialSet *set, const MaskSet *masks)
{
    set->masks = masks;
}

void material_set_free(MaterialSet *set)
{
    if (!set) {
        return;
    }
    for (int i = 0; i < set->count; i++) {
        free(set->entry[i].table);
        free(set->entry[i].rough_tables);
        free(set->entry[i].ripples);
        free(set->entry[i].layer);
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
