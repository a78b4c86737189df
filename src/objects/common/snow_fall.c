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
    Vec3 size = vec3_sub(bounds.high, bounds.low);
    *fall = (SnowFall){.bounds = bounds};
    fall->cell = fmaxf(CELL_LEAST, vec3_largest(size) / MOST_CELLS_ACROSS);
    fall->count[0] = 1 + (int)(size.x / fall->cell);
    fall->count[1] = 1 + (int)(size.y / fall->cell);
    fall->count[2] = 1 + (int)(size.z / fall->cell);
    int64_t cells = (int64_t)fall->count[0] * fall->count[1] * fall->count[2];
    fall->caught = memory_alloc_zero(cells, sizeof *fall->caught, e);
    return fall->caught;
}

void snow_fall_free(SnowFall *fall)
{
    free(fall->caught);
}

static int clamped(float offset, float cell, int count)
{
    int index = (int)fmaxf(0.0f, offset / cell);
    return index < count ? index : count - 1;
}

// Cells of a column follow each other from below.
static int64_t cell_of(const SnowFall *fall, Vec3 p)
{
    Vec3 place = vec3_sub(p, fall->bounds.low);
    int64_t x = clamped(place.x, fall->cell, fall->count[0]);
    int64_t z = clamped(place.z, fall->cell, fall->count[2]);
    return (z * fall->count[0] + x) * fall->count[1] + clamped(place.y, fall->cell, fall->count[1]);
}

void snow_fall_add(SnowFall *fall, Vec3 p, float area)
{
    fall->caught[cell_of(fall, p)] += area;
}

void snow_fall_finish(SnowFall *fall)
{
    int64_t columns = (int64_t)fall->count[0] * fall->count[2];
    for (int64_t i = 0; i < columns; i++) {
        float *column = fall->caught + i * fall->count[1], above = 0.0f;
        for (int y = fall->count[1] - 1; y >= 0; y--) {
            float here = column[y];
            column[y] = above + 0.5f * here;
            above += here;
        }
    }
}

float snow_fall_share(const SnowFall *fall, Vec3 p)
{
    double layers = (double)(fall->caught[cell_of(fall, p)] / (fall->cell * fall->cell));
    return SLIDES + (1.0f - SLIDES) * (float)exact_exp(-CATCHES * layers);
}
