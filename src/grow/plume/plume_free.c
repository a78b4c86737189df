#include "grow/plume/plume_free.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

#define PULL_ONE 16777216.0f // sums of whole numbers do not depend on the attractors' order

bool free_places_init(FreePlaces *places, const PointSet *attractors, float influence, float kill,
                      const Room *room, const Run *run, Error *e)
{
    *places = (FreePlaces){.room = room};
    return attractor_grid_init(&places->grid, attractors, influence, kill, run, e);
}

void free_places_clear(FreePlaces *places)
{
    attractor_grid_free(&places->grid);
    free(places->changed.word);
    *places = (FreePlaces){0};
}

bool free_places_update(FreePlaces *places, const OutTree *tree, const Run *run, Error *e)
{
    const Room *room = places->room;
    NewNodes nodes = {.tree = tree, .first = places->seen};
    if (!memory_reserve(&places->changed.word, &places->changed.capacity, tree->count / 64 + 1,
                        sizeof *places->changed.word, e) ||
        (room && room->meet &&
         !room->meet(room->user, tree, places->seen, &nodes.rival, &nodes.rival_count, e))) {
        return false;
    }
    places->seen = tree->count;
    attractor_grid_update(&places->grid, &nodes, run, run->threads > 1 ? run->threads : 1,
                          &places->changed);
    return !run_is_cancelled(run) || run_cancel_error(e);
}

typedef struct Sector {
    Vec3 origin, heading;
    float least_cos;
    int32_t node;
    int64_t sum[3], count;
} Sector;

static void add_cell(const AttractorGrid *grid, int64_t cell, Sector *sector)
{
    const AttractorBlock *a = grid->block + grid->cells[cell].first_block;
    const AttractorBlock *end = a + (grid->cells[cell].count + LANES - 1) / LANES;
    for (; a < end; a++) {
        for (int i = 0; i < LANES; i++) {
            if (a->nearest[i] != sector->node) {
                continue;
            }
            Vec3 d = vec3_sub(vec3(a->x[i], a->y[i], a->z[i]), sector->origin);
            Vec3 unit = vec3_scale(d, 1.0f / sqrtf(a->best[i]));
            if (vec3_dot(unit, sector->heading) >= sector->least_cos) {
                sector->sum[0] += (int64_t)(unit.x * PULL_ONE);
                sector->sum[1] += (int64_t)(unit.y * PULL_ONE);
                sector->sum[2] += (int64_t)(unit.z * PULL_ONE);
                sector->count++;
            }
        }
    }
}

int64_t free_places_pull(const FreePlaces *places, const OutTree *tree, int32_t node, Vec3 heading,
                         float least_cos, Vec3 *pull)
{
    const AttractorGrid *grid = &places->grid;
    Sector sector = {tree->position[node], heading, least_cos, node, {0}, 0};
    Vec3 offset = vec3_sub(sector.origin, grid->low);
    const float along[3] = {offset.x, offset.y, offset.z};
    int from[3], to[3];
    for (int axis = 0; axis < 3; axis++) {
        from[axis] = attractor_grid_cell_along(grid, axis, along[axis] - grid->reach);
        to[axis] = attractor_grid_cell_along(grid, axis, along[axis] + grid->reach);
    }
    for (int x = from[0]; x <= to[0]; x++) {
        for (int y = from[1]; y <= to[1]; y++) {
            int64_t row = ((int64_t)x * grid->size[1] + y) * grid->size[2];
            for (int z = from[2]; z <= to[2]; z++) {
                add_cell(grid, row + z, &sector);
            }
        }
    }
    *pull = vec3((float)sector.sum[0] / PULL_ONE, (float)sector.sum[1] / PULL_ONE,
                 (float)sector.sum[2] / PULL_ONE);
    return sector.count;
}
