#include "render/material/relief.h"

#include "base/hash.h"
#include "render/material/maps.h"
#include "render/material/pattern.h"
#include "render/material/pattern_stem.h"

#include <string.h>

// Patterns of land whose steep places are rock.
static bool shows_faces(const Material *m)
{
    return m->pattern == PATTERN_MOUNTAIN || m->pattern == PATTERN_ALPS ||
           m->pattern == PATTERN_COAST || m->pattern == PATTERN_KARST;
}

static bool displaces_pattern(const Material *m)
{
    return m->pattern == PATTERN_BARK || m->pattern == PATTERN_STONE ||
           m->pattern == PATTERN_MASONRY || m->pattern == PATTERN_DRESSED ||
           m->pattern == PATTERN_RUBBLE ||
           ((m->pattern == PATTERN_NOISE || m->pattern == PATTERN_STRATA ||
             m->pattern == PATTERN_BADLANDS || m->pattern == PATTERN_SNOW || shows_faces(m)) &&
            m->displacement == DISPLACEMENT_ON);
}

static bool has_map(const Material *m)
{
    return m->displacement_texture && m->displacement_texture[0];
}

// Cut-outs, films and bodies know the faces of the mesh itself only.
static bool can_be_displaced(const Material *m)
{
    return m->displacement != DISPLACEMENT_OFF && material_has(m, TRAIT_OPAQUE) &&
           !material_has(m, TRAIT_EMISSIVE) && !(m->alpha_texture && m->alpha_texture[0]);
}

float relief_size(const Material *m, float radius)
{
    if (!can_be_displaced(m)) {
        return 0.0f;
    }
    float map = has_map(m) ? m->displacement_depth : 0.0f;
    float form = m->pattern == PATTERN_BARK ? bark_form_size(m, radius) : 0.0f;
    return map + (displaces_pattern(m) ? pattern_height_size(m) + form : 0.0f);
}

bool relief_spares(const Material *m, Vec3 a, Vec3 b)
{
    const float level = 0.92f; // pattern_height is 0 there
    return shows_faces(m) && !has_map(m) && fminf(fabsf(a.y), fabsf(b.y)) > level;
}

float relief_height(const MaterialSet *set, const SurfacePoint *point)
{
    const MaterialEntry *entry = &set->entry[point->material];
    const Material *m = &entry->material;
    return maps_height(entry, point) + (displaces_pattern(m) ? pattern_height(m, point) : 0.0f);
}

uint64_t relief_key(const Material *m)
{
    if (relief_size(m, 1.0f) <= 0.0f) {
        return 0;
    }
    const float values[] = {m->pattern_scale,
                            m->pattern_depth,
                            m->moss,
                            m->lichen,
                            m->scars,
                            m->ribs,
                            m->hollows,
                            m->cracks,
                            m->twist,
                            m->bark_height,
                            m->displacement_depth,
                            m->texture_scale,
                            (float)m->displacement,
                            (float)m->pattern,
                            (float)m->bark,
                            (float)m->texture_mapping};
    uint64_t key = HASH_START;
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        for (int shift = 0; shift < 32; shift += 8) {
            key = hash_byte(key, (unsigned char)(bits >> shift));
        }
    }
    return has_map(m) ? hash_bytes(key, m->displacement_texture, strlen(m->displacement_texture))
                      : key;
}
