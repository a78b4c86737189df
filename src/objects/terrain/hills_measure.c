// Measures of rounded hills: how far apart their valleys are, and how sharply their tops bend.
#include "base/memory.h"
#include "objects/terrain/internal.h"

#include <math.h>
#include <stdlib.h>

static double surface(const Landscape *land, int64_t i)
{
    return land->rock[i] + land->loose[i];
}

// Valleys that a line of samples crosses: low places with land higher by `rise` m on both sides.
static int64_t valleys_across(const Landscape *land, int64_t first, int64_t step, double rise)
{
    double low = surface(land, first), high = low;
    bool falls = false;
    int64_t valleys = 0;
    for (int k = 1; k < land->side; k++) {
        double h = surface(land, first + step * k);
        if (falls && h > low + rise) {
            valleys++;
            falls = false;
            high = h;
        } else if (!falls && h < high - rise) {
            falls = true;
            low = h;
        }
        low = h < low ? h : low;
        high = h > high ? h : high;
    }
    return valleys;
}

// m: mean distance of valleys along all rows and columns.
static double valley_spacing(const Landscape *land, double rise)
{
    int64_t valleys = 0;
    for (int k = 0; k < land->side; k++) {
        valleys += valleys_across(land, (int64_t)k * land->side, 1, rise);
        valleys += valleys_across(land, k, land->side, rise);
    }
    double metres = 2.0 * (double)land->side * (double)(land->side - 1) * land->cell;
    return valleys > 0 ? metres / (double)valleys : (double)NAN;
}

static double curvature(const Landscape *land, int64_t i)
{
    double around = surface(land, i - 1) + surface(land, i + 1) + surface(land, i - land->side) +
                    surface(land, i + land->side);
    return (around - 4.0 * surface(land, i)) / (land->cell * land->cell);
}

static bool is_top(const Landscape *land, int64_t i)
{
    double h = surface(land, i);
    for (int row = -2; row <= 2; row++) {
        for (int column = -2; column <= 2; column++) {
            if (surface(land, i + (int64_t)row * land->side + column) > h) {
                return false;
            }
        }
    }
    return true;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// 1/m: median over the tops of hills, negative; NaN without any.
static bool top_curvature(const Landscape *land, double *median, Error *e)
{
    double *bend = memory_alloc(landscape_count(land), sizeof *bend, e);
    int64_t tops = 0;
    for (int row = 2; bend && row < land->side - 2; row++) {
        for (int column = 2; column < land->side - 2; column++) {
            int64_t i = (int64_t)row * land->side + column;
            if (is_top(land, i)) {
                bend[tops++] = curvature(land, i);
            }
        }
    }
    *median = (double)NAN;
    if (tops > 0) {
        qsort(bend, (size_t)tops, sizeof *bend, by_value);
        *median = bend[tops / 2];
    }
    bool done = bend;
    free(bend);
    return done;
}

bool terrain_measure_hills(const Terrain *terrain, MeasureList *list, Error *e)
{
    double bend, nan = (double)NAN;
    TerrainParams params = terrain_params_resolve(terrain->params);
    double spacing = valley_spacing(terrain->evolved, 0.02 * (double)params.relief);
    return top_curvature(terrain->evolved, &bend, e) &&
           measures_add(list, "valley_spacing", spacing, "m", nan, nan, e) &&
           measures_add(list, "hilltop_curvature", bend, "1/m", nan, nan, e);
}
