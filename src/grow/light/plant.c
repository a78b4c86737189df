#include "grow/light/plant.h"

#include "base/memory.h"

#include <stdlib.h>

void plant_clear(Plant *plant)
{
    free(plant->metamer);
    free(plant->living);
    *plant = (Plant){0};
}

static void link_lateral(Plant *plant, int32_t parent, int32_t child)
{
    int32_t *last = &plant->metamer[parent].lateral;
    while (*last >= 0) {
        last = &plant->metamer[*last].sibling;
    }
    *last = child;
}

int64_t plant_add(Plant *plant, int32_t parent, int side, Vec3 position, Vec3 direction, Error *e)
{
    if (!memory_reserve(&plant->metamer, &plant->capacity, plant->count + 1, sizeof *plant->metamer,
                        e) ||
        !memory_reserve(&plant->living, &plant->living_capacity, plant->living_count + 1,
                        sizeof *plant->living, e)) {
        return -1;
    }
    Metamer *base = &plant->metamer[parent];
    int32_t made = (int32_t)plant->count++;
    plant->living[plant->living_count++] = made;
    plant->metamer[made] = (Metamer){.position = position,
                                     .direction = direction,
                                     .side = base->side,
                                     .id = out_tree_child_id(base->id, side + 1),
                                     .parent = parent,
                                     .next = -1,
                                     .lateral = -1,
                                     .sibling = -1,
                                     .died = PLANT_ALIVE,
                                     .vigor = 1.0f,
                                     .claim = 1.0f,
                                     .order = base->order + (side >= 0)};
    if (side < 0) {
        base->next = made;
        base->terminal = false;
    } else {
        base->buds &= ~(1u << (unsigned)side);
        link_lateral(plant, parent, made);
    }
    return made;
}

// The child with most nodes continues an axis; ties go to the first.
static bool find_axes(Plant *plant, const OutTree *start, Error *e)
{
    int32_t *above = memory_alloc_zero(start->count, sizeof *above, e);
    if (!above) {
        return false;
    }
    for (int64_t i = start->count - 1; i >= 0; i--) {
        int32_t parent = start->parent[i];
        if (parent < 0) {
            continue;
        }
        above[parent] += 1 + above[i];
        int32_t *next = &plant->metamer[parent].next;
        *next = *next >= 0 && above[*next] > above[i] ? *next : (int32_t)i;
    }
    for (int64_t i = 0; i < start->count; i++) {
        int32_t parent = start->parent[i];
        Metamer *m = &plant->metamer[i];
        if (parent >= 0 && plant->metamer[parent].next != i) {
            m->order = plant->metamer[parent].order + 1;
            link_lateral(plant, parent, (int32_t)i);
        } else if (parent >= 0) {
            m->order = plant->metamer[parent].order;
        }
    }
    free(above);
    return true;
}

bool plant_init(Plant *plant, const OutTree *start, const LightParams *params,
                const LightSite *site, Error *e)
{
    *plant = (Plant){0};
    if (!memory_reserve(&plant->metamer, &plant->capacity, start->count, sizeof *plant->metamer,
                        e) ||
        !memory_reserve(&plant->living, &plant->living_capacity, start->count,
                        sizeof *plant->living, e)) {
        plant_clear(plant);
        return false;
    }
    plant->count = plant->living_count = start->count;
    for (int64_t i = 0; i < start->count; i++) {
        int32_t parent = start->parent[i];
        plant->living[i] = (int32_t)i;
        Vec3 at = vec3_scale(vec3_sub(start->position[i], site->foot), 1.0f / site->internode);
        Vec3 from = parent >= 0 ? plant->metamer[parent].position : at;
        Vec3 d = vec3_normalize(vec3_sub(at, from));
        d = vec3_dot(d, d) > 0.5f ? d : vec3(0, 1, 0);
        plant->metamer[i] = (Metamer){.position = at,
                                      .direction = d,
                                      .side = vec3_perpendicular(d),
                                      .id = start->id[i],
                                      .parent = parent,
                                      .next = -1,
                                      .lateral = -1,
                                      .sibling = -1,
                                      .birth = start->birth[i],
                                      .vigor = 1.0f,
                                      .claim = 1.0f,
                                      .died = PLANT_ALIVE};
    }
    if (!find_axes(plant, start, e)) {
        plant_clear(plant);
        return false;
    }
    for (int64_t i = 0; i < plant->count; i++) {
        Metamer *m = &plant->metamer[i];
        bool inner = m->parent >= 0 && plant->metamer[m->parent].parent >= 0; // above the foot
        m->terminal = m->next < 0;
        m->buds = inner ? (1u << (unsigned)params->buds) - 1u : 0u;
    }
    return true;
}

void plant_bury(Plant *plant)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < plant->living_count; i++) {
        if (plant->metamer[plant->living[i]].died == PLANT_ALIVE) {
            plant->living[kept++] = plant->living[i];
        }
    }
    plant->living_count = kept;
}

Aabb plant_bounds(const Plant *plant)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < plant->living_count; i++) {
        box = aabb_add(box, plant->metamer[plant->living[i]].position);
    }
    return box;
}
