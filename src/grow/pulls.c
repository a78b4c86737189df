#include "grow/growth.h"

#include <string.h>

static int64_t fixed(float x)
{
    return (int64_t)(x * PULL_ONE);
}

static void add_vector(int64_t sum[3], Vec3 v)
{
    sum[0] += fixed(v.x);
    sum[1] += fixed(v.y);
    sum[2] += fixed(v.z);
}

// On a surface: the normal there, and how high the node stands above it. The chord between two
// points of a sphere is perpendicular to the sum of their normals, so curvature does not count.
static void add_surface(const Growth *growth, const Grower *grower, Vec3 offset, Vec3 normal,
                        Pull *pull)
{
    add_vector(pull->normal, normal);
    Vec3 between = vec3_normalize(vec3_add(grower->normal, normal));
    pull->height -= fixed(vec3_dot(offset, between) / growth->params->influence);
}

// The angle limits as a yes or no, for the rule that cannot turn a direction.
static bool is_angle_allowed(const Growth *growth, const Grower *grower, Vec3 unit)
{
    if (!grower->has_heading) {
        return true;
    }
    float cosine = vec3_dot(unit, grower->heading);
    bool lateral = growth->state[grower->node].children > 0;
    return cosine >= growth->max_cos && (!lateral || cosine <= growth->min_cos);
}

// Least cost wins: the distance, lengthened where it does not agree with the grower's lean.
static void add_pick(const Growth *growth, const Grower *grower, Vec3 unit, float distance,
                     int32_t attractor, Pull *pull)
{
    if (!is_angle_allowed(growth, grower, unit)) {
        return;
    }
    Vec3 lean = grower->lean;
    float cost = distance * (1.0f + vec3_length(lean) - vec3_dot(lean, unit));
    cost = cost > 0.0f ? cost : 0.0f;
    uint32_t bits;
    memcpy(&bits, &cost, sizeof bits);
    uint64_t key = (uint64_t)bits << 32 | (uint32_t)attractor;
    pull->pick = key < pull->pick ? key : pull->pick;
}

// The direction of the string that owns an attractor: the nearest in angle, within half a group; -1
// = none.
static int find_direction(const Growth *growth, const Grower *grower, Vec3 unit)
{
    const GrowString *string = growth->params->string;
    const GrowDirection *at = &string->direction[growth->place[grower->node]];
    Vec3 local = vec3(vec3_dot(unit, grower->heading), vec3_dot(unit, grower->normal),
                      vec3_dot(unit, grower->side));
    float best = growth->group_cos;
    int found = -1;
    for (int i = 0; i < at->followers; i++) {
        float cosine = vec3_dot(local, string->direction[at->first + i].heading);
        if (cosine > best) {
            best = cosine;
            found = i;
        }
    }
    return found;
}

static void add_attractor(const Growth *growth, const AttractorBlock *a, int lane,
                          int32_t attractor, Pull *pulls)
{
    int64_t slot = growth->slot[a->nearest[lane]];
    if (slot < 0) {
        return;
    }
    const Grower *grower = &growth->grower[slot];
    Vec3 offset = vec3_sub(vec3(a->x[lane], a->y[lane], a->z[lane]), grower->position);
    float distance = sqrtf(a->best[lane]);
    Vec3 unit = vec3_scale(offset, 1.0f / distance);
    Pull *pull = pulls + slot * growth->sectors.count;
    if (growth->params->rule == GROW_SECTORS && grower->has_heading) {
        Vec3 local = vec3(vec3_dot(unit, grower->heading), vec3_dot(unit, grower->normal),
                          vec3_dot(unit, grower->side));
        pull += sectors_find(&growth->sectors, local);
    }
    if (growth->params->rule == GROW_STRING) {
        int direction = find_direction(growth, grower, unit);
        if (direction < 0) {
            return;
        }
        pull += direction;
        pull->length += fixed(growth->length[attractor] / growth->longest);
    }
    add_vector(pull->toward, unit);
    pull->count++;
    if (growth->params->on_surface) {
        add_surface(growth, grower, offset, growth->attractors->normal[attractor], pull);
    }
    if (growth->params->rule == GROW_SNAP) {
        add_pick(growth, grower, unit, distance, attractor, pull);
    }
}

static void add_cell(const Growth *growth, int32_t cell, Pull *pulls)
{
    const AttractorGrid *grid = &growth->grid;
    int64_t first = grid->cells[cell].first_block * BLOCK_LANES;
    for (int64_t i = first; i < first + grid->cells[cell].count; i++) {
        const AttractorBlock *a = &grid->block[i / BLOCK_LANES];
        if (a->nearest[i % BLOCK_LANES] >= 0) {
            add_attractor(growth, a, (int)(i % BLOCK_LANES), grid->source[i], pulls);
        }
    }
}

void growth_sum_part(const Growth *growth, int part, int parts)
{
    const AttractorGrid *grid = &growth->grid;
    int64_t count = growth->grower_count * growth->sectors.count;
    Pull *pulls = growth->pull + part * count;
    for (int64_t i = 0; i < count; i++) {
        pulls[i] = (Pull){.pick = UINT64_MAX};
    }
    int begin = part > 0 ? grid->slab_end[part - 1] : 0;
    int end = part < parts - 1 ? grid->slab_end[part] : INT32_MAX;
    for (int64_t i = 0; i < grid->active_count; i++) {
        if (grid->active[i].slice >= begin && grid->active[i].slice < end) {
            add_cell(growth, grid->active[i].cell, pulls);
        }
    }
}

static void merge(Pull *sum, const Pull *part)
{
    for (int c = 0; c < 3; c++) {
        sum->toward[c] += part->toward[c];
        sum->normal[c] += part->normal[c];
    }
    sum->count += part->count;
    sum->height += part->height;
    sum->length += part->length;
    sum->pick = part->pick < sum->pick ? part->pick : sum->pick;
}

void growth_merge_pulls(const Growth *growth, int64_t grower, int parts)
{
    int64_t sectors = growth->sectors.count, pulls = growth->grower_count * sectors;
    for (int64_t i = grower * sectors; i < (grower + 1) * sectors; i++) {
        for (int part = 1; part < parts; part++) {
            merge(&growth->pull[i], &growth->pull[part * pulls + i]);
        }
    }
}
