#include "objects/common/boughs.h"

#include "base/memory.h"
#include "outtree/chains.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_CELLS_ACROSS = 128 };

#define CELL_LEAST 0.12f // m

void boughs_free(Boughs *boughs)
{
    free(boughs->bough);
    free(boughs->first);
    free(boughs->node);
}

static int64_t cell_of(const PlantCells *cells, Vec3 p)
{
    int64_t x = plant_cells_along(cells, p, 0), y = plant_cells_along(cells, p, 1);
    return (plant_cells_along(cells, p, 2) * (int64_t)cells->count[1] + y) * cells->count[0] + x;
}

// A chain of the first order begins a bough; its first node is the fork on the main axis.
static bool name_boughs(Boughs *boughs, Error *e)
{
    const OutTree *tree = boughs->tree;
    ChainSet *chains = out_tree_chains(tree, e);
    if (!chains) {
        return false;
    }
    for (int64_t c = 0; c < chains->count; c++) {
        int64_t begin = chains->first[c] + (chains->order[c] > 0);
        int32_t fork = chains->order[c] > 0 ? tree->parent[chains->node[begin]] : -1;
        int32_t own = chains->node[begin];
        int32_t name = chains->order[c] > 1 ? boughs->bough[fork] : own;
        for (int64_t i = begin; i < chains->first[c + 1]; i++) {
            boughs->bough[chains->node[i]] = name;
        }
    }
    chains_free(chains);
    return true;
}

// Sorts the nodes by their cells.
static bool sort_nodes(Boughs *boughs, Error *e)
{
    const OutTree *tree = boughs->tree;
    int64_t cells = plant_cells_count(&boughs->cells);
    boughs->first = memory_alloc_zero(cells + 2, sizeof *boughs->first, e);
    boughs->node = memory_alloc(tree->count, sizeof *boughs->node, e);
    if (!boughs->first || !boughs->node) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        boughs->first[cell_of(&boughs->cells, tree->position[i]) + 2]++;
    }
    for (int64_t c = 0; c < cells; c++) {
        boughs->first[c + 2] += boughs->first[c + 1];
    }
    for (int64_t i = 0; i < tree->count; i++) {
        boughs->node[boughs->first[cell_of(&boughs->cells, tree->position[i]) + 1]++] = (int32_t)i;
    }
    return true;
}

bool boughs_init(Boughs *boughs, const OutTree *tree, Error *e)
{
    Aabb bounds = out_tree_bounds(tree);
    if (aabb_is_empty(bounds)) {
        bounds = (Aabb){{0, 0, 0}, {0, 0, 0}};
    }
    *boughs = (Boughs){.tree = tree, .cells = plant_cells(bounds, CELL_LEAST, MOST_CELLS_ACROSS)};
    boughs->bough = memory_alloc(tree->count, sizeof *boughs->bough, e);
    return boughs->bough && name_boughs(boughs, e) && sort_nodes(boughs, e);
}

int32_t boughs_nearest(const Boughs *boughs, Vec3 p)
{
    const PlantCells *cells = &boughs->cells;
    Vec3 aside = vec3(cells->size, cells->size, cells->size);
    int low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = plant_cells_along(cells, vec3_sub(p, aside), k);
        high[k] = plant_cells_along(cells, vec3_add(p, aside), k);
    }
    float least = 3e38f;
    int32_t nearest = -1;
    for (int z = low[2]; z <= high[2]; z++) {
        for (int y = low[1]; y <= high[1]; y++) {
            int64_t row = ((int64_t)z * cells->count[1] + y) * cells->count[0];
            for (int64_t i = boughs->first[row + low[0]]; i < boughs->first[row + high[0] + 1];
                 i++) {
                int32_t node = boughs->node[i];
                float far = vec3_distance(p, boughs->tree->position[node]);
                if (far < least) {
                    least = far;
                    nearest = boughs->bough[node];
                }
            }
        }
    }
    return nearest;
}
