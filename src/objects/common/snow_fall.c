#include "objects/common/snow_fall.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_CELLS_ACROSS = 160 };

#define CELL_LEAST 0.25f // m
#define CATCHES 0.5      // of the snow on its area: the rest slides through
#define SLIDES 0.2f      // share that comes to every place from above

bool snow_fall_init(SnowFall *fall, Aabb bounds, Error *e)
{
    *fall = (SnowFall){.cells = plant_cells(bounds, CELL_LEAST, MOST_CELLS_ACROSS)};
    fall->caught = memory_alloc_zero(plant_cells_count(&fall->cells), sizeof *fall->caught, e);
    return fall->caught;
}

void snow_fall_free(SnowFall *fall)
{
    free(fall->caught);
}

// Cells of a column follow each other from below.
static int64_t cell_of(const SnowFall *fall, Vec3 p)
{
    const PlantCells *cells = &fall->cells;
    int64_t x = plant_cells_along(cells, p, 0), z = plant_cells_along(cells, p, 2);
    return (z * cells->count[0] + x) * cells->count[1] + plant_cells_along(cells, p, 1);
}

void snow_fall_add(SnowFall *fall, Vec3 p, float area)
{
    fall->caught[cell_of(fall, p)] += area;
}

void snow_fall_finish(SnowFall *fall)
{
    int64_t columns = (int64_t)fall->cells.count[0] * fall->cells.count[2];
    for (int64_t i = 0; i < columns; i++) {
        float *column = fall->caught + i * fall->cells.count[1], above = 0.0f;
        for (int y = fall->cells.count[1] - 1; y >= 0; y--) {
            float here = column[y];
            column[y] = above + 0.5f * here;
            above += here;
        }
    }
}

float snow_fall_share(const SnowFall *fall, Vec3 p)
{
    double layers =
        (double)(fall->caught[cell_of(fall, p)] / (fall->cells.size * fall->cells.size));
    return SLIDES + (1.0f - SLIDES) * (float)exact_exp(-CATCHES * layers);
}
