// Drainage areas: the area of land that drains through each river node.
#include "objects/terrain/internal.h"

#include "base/memory.h"
#include "objects/terrain/cells.h"

#include <stdlib.h>
#include <string.h>

// Nodes sorted into cells.
typedef struct NodeGrid {
    TerrainCells cells;
    int64_t *start; // of each cell's nodes in `node`, and the end
    int32_t *node;
} NodeGrid;

static bool grid_fill(NodeGrid *grid, const OutTree *tree, float size, Error *e)
{
    grid->cells = terrain_cells(size, tree->count / 2, 1024);
    int64_t cells = (int64_t)grid->cells.side * grid->cells.side;
    grid->start = memory_alloc_zero(cells + 2, sizeof *grid->start, e);
    grid->node = memory_alloc(tree->count, sizeof *grid->node, e);
    if (!grid->start || !grid->node) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        grid->start[terrain_cell_index(&grid->cells, tree->position[i]) + 2]++;
    }
    for (int64_t c = 0; c < cells; c++) {
        grid->start[c + 2] += grid->start[c + 1];
    }
    for (int64_t i = 0; i < tree->count; i++) {
        grid->node[grid->start[terrain_cell_index(&grid->cells, tree->position[i]) + 1]++] =
            (int32_t)i;
    }
    return true;
}

static void grid_clear(NodeGrid *grid)
{
    free(grid->start);
    free(grid->node);
}

// The node nearest to (x, z); ties: the lowest index.
static int32_t nearest_node(const NodeGrid *grid, const OutTree *tree, float x, float z)
{
    const TerrainCells *cells = &grid->cells;
    int column = terrain_cell(cells, x), row = terrain_cell(cells, z);
    float best = 3e38f;
    int32_t found = 0;
    for (int ring = 0; ring < cells->side; ring++) {
        float clear = (float)(ring - 1) / cells->scale;
        if (ring > 1 && clear * clear > best) {
            break;
        }
        for (int r = row - ring; r <= row + ring; r++) {
            bool edge = r == row - ring || r == row + ring;
            for (int c = column - ring; c <= column + ring; c += edge || ring == 0 ? 1 : 2 * ring) {
                if (r < 0 || c < 0 || r >= cells->side || c >= cells->side) {
                    continue;
                }
                int64_t cell = (int64_t)r * cells->side + c;
                for (int64_t k = grid->start[cell]; k < grid->start[cell + 1]; k++) {
                    int32_t i = grid->node[k];
                    float dx = tree->position[i].x - x, dz = tree->position[i].z - z;
                    float d2 = dx * dx + dz * dz;
                    if (d2 < best || (d2 == best && i < found)) {
                        best = d2;
                        found = i;
                    }
                }
            }
        }
    }
    return found;
}

// Land drains to its nearest node, counted on a grid that depends on the number of rivers, not on
// the resolution.
bool terrain_areas(Terrain *terrain, const Run *run, Error *e)
{
    const OutTree *tree = terrain->tree;
    float size = terrain->params->size;
    int side = 256;
    while (side < 2048 && (int64_t)side * side < 12 * tree->count) {
        side *= 2;
    }
    NodeGrid grid = {0};
    int32_t *owner = memory_alloc((int64_t)side * side, sizeof *owner, e);
    bool done = owner && grid_fill(&grid, tree, size, e);
    if (done) {
#pragma omp parallel for schedule(static) num_threads(run->threads)
        for (int row = 0; row < side; row++) {
            for (int column = 0; column < side; column++) {
                float x = ((float)column + 0.5f) / (float)side - 0.5f;
                float z = ((float)row + 0.5f) / (float)side - 0.5f;
                owner[(int64_t)row * side + column] = nearest_node(&grid, tree, x * size, z * size);
            }
        }
        float cell = size / (float)side * (size / (float)side);
        memset(terrain->area, 0, sizeof *terrain->area * (size_t)tree->count);
        for (int64_t i = 0; i < (int64_t)side * side; i++) {
            terrain->area[owner[i]] += cell;
        }
        for (int64_t i = tree->count - 1; i >= 0; i--) {
            float least = 0.25f * cell; // least area, for nodes nearest to no sample
            terrain->area[i] = terrain->area[i] > least ? terrain->area[i] : least;
            if (tree->parent[i] >= 0) {
                terrain->area[tree->parent[i]] += terrain->area[i];
            }
        }
    }
    free(owner);
    grid_clear(&grid);
    return done;
}
