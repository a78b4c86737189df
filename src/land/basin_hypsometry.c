#include "land/basin_hypsometry.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

typedef struct Basin {
    double sum; // m: of the heights
    int64_t samples;
    float low, high; // m
    bool cut;
} Basin;

enum { NO_BASIN = -1 };

// The basin of every sample. Returns how many basins there are.
static int32_t label_basins(const Drainage *drainage, const uint8_t *order, int rank,
                            int32_t *label)
{
    int32_t basins = 0;
    for (int64_t i = 0; i < drainage->samples; i++) {
        label[i] = NO_BASIN;
    }
    for (int64_t k = 0; k < drainage->count; k++) {
        int32_t i = drainage->order[k], to = drainage->receiver[i];
        if (to == i) {
            continue;
        }
        bool mouth = order[i] == rank && order[to] > rank;
        label[i] = mouth ? basins++ : label[to];
    }
    return basins;
}

// Whether water leaves the field at a neighbour of sample i.
static bool beside_outlet(const HeightField *field, const Drainage *drainage, int32_t i)
{
    int column = i % field->columns, row = i / field->columns;
    if (column < 1 || row < 1 || column > field->columns - 2 || row > field->rows - 2) {
        return true;
    }
    for (int near = 0; near < 9; near++) {
        int32_t j = i + (near / 3 - 1) * field->columns + near % 3 - 1;
        if (!isfinite(field->height[j]) || drainage->receiver[j] == j) {
            return true;
        }
    }
    return false;
}

static void basin_add(Basin *basin, float height)
{
    basin->low = basin->samples == 0 || height < basin->low ? height : basin->low;
    basin->high = basin->samples == 0 || height > basin->high ? height : basin->high;
    basin->sum += (double)height;
    basin->samples++;
}

static double mean_integral(const Basin *basin, int32_t basins)
{
    double sum = 0.0, whole = 0.0;
    for (int32_t b = 0; b < basins; b++) {
        double relief = (double)basin[b].high - (double)basin[b].low;
        if (!basin[b].cut && relief > 0.0) {
            sum += (basin[b].sum / (double)basin[b].samples - (double)basin[b].low) / relief;
            whole += 1.0;
        }
    }
    return whole > 0.0 ? sum / whole : (double)NAN;
}

bool basin_hypsometry(const HeightField *field, const Drainage *drainage, const uint8_t *order,
                      int rank, double *integral, Error *e)
{
    int32_t *label = memory_alloc(drainage->samples, sizeof *label, e);
    int32_t basins = label ? label_basins(drainage, order, rank, label) : 0;
    Basin *basin = label ? memory_alloc_zero((int64_t)basins + 1, sizeof *basin, e) : NULL;
    for (int64_t k = 0; basin && k < drainage->count; k++) {
        int32_t i = drainage->order[k];
        if (label[i] != NO_BASIN) {
            basin_add(&basin[label[i]], field->height[i]);
            basin[label[i]].cut |= beside_outlet(field, drainage, i);
        }
    }
    bool done = basin != NULL;
    if (done) {
        *integral = mean_integral(basin, basins);
    }
    free(basin);
    free(label);
    return done;
}
