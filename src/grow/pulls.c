#include "grow/rules/rule.h"

#include <stddef.h>

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

// On a surface: the normal there and the node's height above it. The chord between two points of a
// sphere is perpendicular to the sum of their normals, so curvature cancels.
static void add_surface(const Growth *growth, const Grower *grower, Vec3 offset, Vec3 normal,
                        Pull *pull)
{
    add_vector(pull->normal, normal);
    Vec3 between = vec3_normalize(vec3_add(grower->normal, normal));
    pull->height -= fixed(vec3_dot(offset, between) / growth->params->influence);
}

// nearness: 1 / distance
static void add_attractor(const Growth *growth, const AttractorBlock *a, int lane, float distance,
                          float nearness, Pull *pulls)
{
    int32_t node = a->nearest[lane];
    int64_t slot = growth->slot[node];
    if (slot < 0) {
        return;
    }
    const Grower *grower = &growth->grower[slot];
    Vec3 offset = vec3_sub(vec3(a->x[lane], a->y[lane], a->z[lane]), growth->tree->position[node]);
    Vec3 unit = vec3_scale(offset, nearness);
    int32_t attractor = a->source[lane];
    const Rule *rule = growth->rule;
    int bin = rule->bin ? rule->bin(growth, grower, unit) : 0;
    if (bin < 0) {
        return;
    }
    Pull *pull = pulls + slot * growth->bins + bin;
    add_vector(pull->toward, unit);
    pull->count++;
    if (growth->params->on_surface) {
        add_surface(growth, grower, offset, growth->attractors->normal[attractor], pull);
    }
    if (rule->pull) {
        rule->pull(growth, grower, unit, distance, attractor, pull);
    }
}

static void add_cell(const Growth *growth, int32_t cell, Pull *pulls)
{
    const AttractorGrid *grid = &growth->grid;
    const AttractorBlock *a = grid->block + grid->cells[cell].first_block;
    const AttractorBlock *end = a + (grid->cells[cell].count + LANES - 1) / LANES;
    for (; a < end; a++) {
        float distance[LANES], nearness[LANES];
#pragma omp simd
        for (int i = 0; i < LANES; i++) {
            distance[i] = sqrtf(a->best[i]);
            nearness[i] = 1.0f / distance[i];
        }
        for (int i = 0; i < LANES; i++) {
            if (a->nearest[i] >= 0) {
                add_attractor(growth, a, i, distance[i], nearness[i], pulls);
            }
        }
    }
}

static void add_slice(const Growth *growth, const ActiveCells *active, Pull *pulls)
{
    for (int32_t i = 0; i < active->count && run_goes_on(growth->run, i, NULL); i++) {
        if (i + ATTRACTOR_AHEAD < active->count) {
            attractor_grid_prefetch(&growth->grid, active->cell[i + ATTRACTOR_AHEAD]);
        }
        add_cell(growth, active->cell[i], pulls);
    }
}

bool growth_sums_need_frames(const Growth *growth)
{
    return growth->rule->bin || growth->rule->pull || growth->params->on_surface;
}

void growth_sum_part(const Growth *growth, int part, int parts)
{
    const AttractorGrid *grid = &growth->grid;
    int64_t count = growth->grower_count * growth->bins;
    Pull *pulls = growth->pull + part * count;
    for (int64_t i = 0; i < count; i++) {
        pulls[i] = (Pull){.pick = UINT64_MAX};
    }
    int slice = part > 0 ? grid->slab_end[part - 1] : 0;
    int end = part < parts - 1 ? grid->slab_end[part] : grid->size[grid->axis];
    for (; slice < end && !run_is_cancelled(growth->run); slice++) {
        add_slice(growth, &grid->active[slice], pulls);
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
    int64_t bins = growth->bins, pulls = growth->grower_count * bins;
    for (int64_t i = grower * bins; i < (grower + 1) * bins; i++) {
        for (int part = 1; part < parts; part++) {
            const Pull *from = &growth->pull[part * pulls + i];
            if (from->count > 0) {
                merge(&growth->pull[i], from);
            }
        }
    }
}
