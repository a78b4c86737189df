#include "grow/light/stand.h"

#include "base/memory.h"
#include "grow/light/shade_grid.h"

#include <math.h>
#include <stdlib.h>

#define BORDER 2.5f // cells about the leaves
enum { MOST_CELLS = 1000000 };

typedef struct Leaves {
    Vec3 *place;
    int64_t count, capacity;
    float area, cell;
} Leaves;

struct LightStand {
    Leaves *plant;
    int plants;
    const Vec3 *offset; // of copies of all leaves; borrowed
    int offsets;
    bool anchored;
    Vec3 anchor;     // a corner of cells of every season's grid
    ShadeGrid *grid; // NULL = not solved yet
};

LightStand *light_stand_new(int plants, Error *e)
{
    LightStand *stand = memory_alloc_zero(1, sizeof *stand, e);
    if (!stand || !(stand->plant = memory_alloc_zero(plants, sizeof *stand->plant, e))) {
        free(stand);
        return NULL;
    }
    stand->plants = plants;
    return stand;
}

void light_stand_free(LightStand *stand)
{
    if (stand) {
        for (int i = 0; i < stand->plants; i++) {
            free(stand->plant[i].place);
        }
        free(stand->plant);
        shade_grid_free(stand->grid);
        free(stand);
    }
}

bool light_stand_give(LightStand *stand, int plant, const Vec3 *leaf, int64_t count, float area,
                      float cell, Error *e)
{
    Leaves *own = &stand->plant[plant];
    if (!memory_reserve(&own->place, &own->capacity, count, sizeof *own->place, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        own->place[i] = leaf[i];
    }
    own->count = count;
    own->area = area;
    own->cell = cell;
    return true;
}

void light_stand_repeat(LightStand *stand, const Vec3 *offset, int count)
{
    stand->offset = offset;
    stand->offsets = count;
}

void light_stand_leaf(const LightStand *stand, int plant, float *area, float *cell)
{
    *area = stand->plant[plant].area;
    *cell = stand->plant[plant].cell;
}

// The box of all leaves and the finest voxel that a plant needs.
static Aabb find_extent(const LightStand *stand, float *cell)
{
    Aabb box = aabb_empty();
    *cell = INFINITY;
    for (int i = 0; i < stand->plants; i++) {
        const Leaves *own = &stand->plant[i];
        for (int64_t k = 0; k < own->count; k++) {
            box = aabb_add(box, own->place[k]);
        }
        if (own->count > 0) {
            *cell = fminf(*cell, own->cell);
        }
    }
    if (!(*cell < INFINITY)) { // nobody has leaves: one cell without shade
        *cell = 1.0f;
        return aabb_add(box, vec3(0, 0, 0));
    }
    Aabb all = box;
    for (int i = 0; i < stand->offsets; i++) {
        all = aabb_add(all, vec3_add(box.low, stand->offset[i]));
        all = aabb_add(all, vec3_add(box.high, stand->offset[i]));
    }
    return all;
}

static float snapped(float x, float anchor, float cell)
{
    return anchor + cell * floorf((x - anchor) / cell);
}

// Low corners lie on a lattice, so that growth shifts no cell borders.
static ShadeGrid *make_grid(LightStand *stand, Error *e)
{
    float cell;
    Aabb box = find_extent(stand, &cell);
    if (!stand->anchored) {
        stand->anchor = box.low;
        stand->anchored = true;
    }
    Vec3 border = vec3_splat(BORDER * cell), low = vec3_sub(box.low, border);
    box.low = vec3(snapped(low.x, stand->anchor.x, cell), snapped(low.y, stand->anchor.y, cell),
                   snapped(low.z, stand->anchor.z, cell));
    box.high = vec3_add(box.high, border);
    return shade_grid_new(box, cell, MOST_CELLS, e);
}

// Leaves are summed as integers, which do not depend on the order.
static bool place_leaves(const LightStand *stand, ShadeGrid *grid, int threads, Error *e)
{
    int64_t *sum = memory_alloc_zero(grid->count, sizeof *sum, e);
    for (int i = 0; sum && i < stand->plants; i++) {
        const Leaves *own = &stand->plant[i];
#pragma omp parallel for num_threads(threads) schedule(static)
        for (int64_t k = 0; k < own->count; k++) {
            shade_grid_count_leaves(grid, own->place[k], own->area, sum);
            for (int j = 0; j < stand->offsets; j++) {
                Vec3 p = vec3_add(own->place[k], stand->offset[j]);
                shade_grid_count_leaves(grid, p, own->area, sum);
            }
        }
    }
    if (sum) {
        shade_grid_set_leaves(grid, sum);
    }
    free(sum);
    return sum;
}

bool light_stand_solve(LightStand *stand, int threads, Error *e)
{
    shade_grid_free(stand->grid);
    stand->grid = make_grid(stand, e);
    return stand->grid && place_leaves(stand, stand->grid, threads, e) &&
           shade_grid_solve(stand->grid, threads, e);
}

float light_stand_light(const LightStand *stand, Vec3 p)
{
    return shade_grid_light(stand->grid, p);
}

Vec3 light_stand_brightest(const LightStand *stand, Vec3 p)
{
    return shade_grid_brightest(stand->grid, p);
}
