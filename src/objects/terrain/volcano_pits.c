// Pits of a volcano's land: shallow ones are accidents of sampling and are filled, deep ones are
// craters, calderas and hollows behind flows, and stay.
#include "base/memory.h"
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"

#include <math.h>
#include <stdlib.h>

// Is no neighbour lower?
static bool is_lowest(const HeightField *field, int64_t i)
{
    int column = (int)(i % field->columns), row = (int)(i / field->columns);
    for (int k = 0; k < 9; k++) {
        int c = column + k % 3 - 1, r = row + k / 3 - 1;
        if (c >= 0 && r >= 0 && c < field->columns && r < field->rows &&
            field->height[(int64_t)r * field->columns + c] < field->height[i]) {
            return false;
        }
    }
    return true;
}

bool terrain_fill_shallow_pits(HeightField *field, float depth, Error *e)
{
    int64_t count = height_field_count(field);
    float *height = memory_alloc(count, sizeof *height, e);
    Drainage *flooded = height ? drainage_flood(field, NULL, e) : NULL;
    bool done = flooded;
    for (int64_t i = 0; done && i < count; i++) { // the lowest points of deep pits are outlets
        bool deep = flooded->filled[i] - field->height[i] > depth && is_lowest(field, i);
        height[i] = deep ? field->height[i] : NAN;
    }
    for (int64_t i = 0; done && i < count; i++) {
        field->height[i] = isfinite(height[i]) ? NAN : field->height[i];
    }
    done = done && height_field_fill(field, 1e-4f, e);
    for (int64_t i = 0; done && i < count; i++) {
        field->height[i] = isfinite(height[i]) ? height[i] : field->height[i];
    }
    drainage_free(flooded);
    free(height);
    return done;
}
