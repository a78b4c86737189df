// Measures of karst: towers, their shape and how they stand, the flanks, the plain.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/terrain/karst.h"

#include <math.h>
#include <stdlib.h>

typedef struct Tower {
    double height, ratio; // m; diameter of its foot's area over the height
    double x, z;          // of the middle of its foot
    bool whole;           // the border does not cut it
} Tower;

typedef struct Towers {
    Tower *tower;
    int64_t count;
} Towers;

// What is connected above a level.
typedef struct Region {
    int64_t area, summit; // samples; the highest one's number
    double x, z;          // m: its middle
    bool whole;           // it does not touch the border
} Region;

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int64_t count)
{
    qsort(values, (size_t)count, sizeof *values, by_value);
    return count > 0 ? values[count / 2] : (double)NAN;
}

// The region above `level` that holds sample i. seen, stack: of all samples.
static Region region(const Landscape *land, double level, int64_t i, uint8_t *seen, int64_t *stack)
{
    int64_t count = 0;
    double columns = 0.0, rows = 0.0;
    Region all = {.summit = i, .whole = true};
    stack[count++] = i;
    seen[i] = 1;
    while (count > 0) {
        int64_t at = stack[--count], side = land->side;
        int64_t column = at % side, row = at / side;
        all.area++;
        columns += (double)column;
        rows += (double)row;
        all.summit = land->rock[at] > land->rock[all.summit] ? at : all.summit;
        const bool inside[] = {column != 0, column != side - 1, row != 0, row != side - 1};
        const int64_t next[] = {at - 1, at + 1, at - side, at + side};
        for (int k = 0; k < 4; k++) {
            all.whole = all.whole && inside[k];
            if (inside[k] && !seen[next[k]] && land->rock[next[k]] > level) {
                seen[next[k]] = 1;
                stack[count++] = next[k];
            }
        }
    }
    all.x = land->corner + columns / (double)all.area * land->cell;
    all.z = land->corner + rows / (double)all.area * land->cell;
    return all;
}

static bool find_towers(const Landscape *land, double relief, double least_area, Towers *towers,
                        Error *e)
{
    int64_t count = landscape_count(land);
    uint8_t *seen = memory_alloc_zero(count, 1, e);
    int64_t *stack = memory_alloc(count, sizeof *stack, e);
    towers->tower = memory_alloc(count / 4, sizeof *towers->tower, e);
    bool done = seen && stack && towers->tower;
    for (int64_t i = 0; done && i < count; i++) {
        if (seen[i] || land->rock[i] <= 0.1 * relief) {
            continue;
        }
        Region all = region(land, 0.1 * relief, i, seen, stack);
        double foot = (double)all.area * land->cell * land->cell, height = land->rock[all.summit];
        if (foot > least_area && height > 0.2 * relief && towers->count < count / 4) {
            towers->tower[towers->count++] =
                (Tower){.height = height,
                        .ratio = 2.0 * sqrt(foot / 3.14159265358979) / height,
                        .x = all.x,
                        .z = all.z,
                        .whole = all.whole};
        }
    }
    free(seen);
    free(stack);
    return done;
}

// Clark and Evans (1954), for a square, with the edge's correction of Donnelly (1978).
static double nearest_neighbour_index(const Towers *t, double size)
{
    double sum = 0.0, n = (double)t->count;
    for (int64_t i = 0; i < t->count; i++) {
        double nearest = (double)INFINITY;
        for (int64_t j = 0; j < t->count; j++) {
            double x = t->tower[i].x - t->tower[j].x, z = t->tower[i].z - t->tower[j].z;
            double d = x * x + z * z;
            nearest = j != i && d < nearest ? d : nearest;
        }
        sum += sqrt(nearest);
    }
    double random = 0.5 * size / sqrt(n) + (0.0514 + 0.041 / sqrt(n)) * 4.0 * size / n;
    return t->count > 1 ? sum / n / random : (double)NAN;
}

// Of cliffs and slopes between the foot and the upper part.
static double flank_slope(const Landscape *land, double relief, double *values)
{
    int64_t count = 0;
    for (int row = 1; row < land->side - 1; row++) {
        for (int column = 1; column < land->side - 1; column++) {
            int64_t i = (int64_t)row * land->side + column;
            if (land->rock[i] > 0.1 * relief && land->rock[i] < 0.55 * relief) {
                double x = land->rock[i + 1] - land->rock[i - 1];
                double z = land->rock[i + land->side] - land->rock[i - land->side];
                double slope = 0.5 * sqrt(x * x + z * z) / land->cell;
                values[count++] = (double)exact_atan2((float)slope, 1.0f) * 57.29577951308232;
            }
        }
    }
    return median(values, count);
}

static double plain_share(const Landscape *land)
{
    int64_t flat = 0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        flat += land->rock[i] <= 0.0;
    }
    return (double)flat / (double)landscape_count(land);
}

bool terrain_measure_karst(const Terrain *terrain, MeasureList *list, Error *e)
{
    const Landscape *land = terrain->evolved;
    TerrainParams params = terrain_params_resolve(terrain->params);
    double relief = (double)params.relief, nan = (double)NAN;
    double least = 0.04 * (double)params.karst.spacing * (double)params.karst.spacing;
    Towers t = {0};
    double *values = memory_alloc(landscape_count(land), sizeof *values, e);
    bool done = values && find_towers(land, relief, least, &t, e);
    if (done) {
        int64_t whole = 0;
        for (int64_t i = 0; i < t.count; i++) {
            values[whole] = t.tower[i].height;
            whole += t.tower[i].whole;
        }
        double height = median(values, whole);
        whole = 0;
        for (int64_t i = 0; i < t.count; i++) {
            values[whole] = t.tower[i].ratio;
            whole += t.tower[i].whole;
        }
        double ratio = median(values, whole);
        double slope = flank_slope(land, relief, values);
        double index = nearest_neighbour_index(&t, (double)params.size);
        done = measures_add(list, "towers", (double)whole, "", nan, nan, e) &&
               measures_add(list, "tower_height", height, "m", nan, nan, e) &&
               measures_add(list, "tower_ratio", ratio, "", nan, nan, e) &&
               measures_add(list, "flank_slope", slope, "degrees", nan, nan, e) &&
               measures_add(list, "nearest_neighbour_index", index, "", nan, nan, e) &&
               measures_add(list, "plain_share", plain_share(land), "", nan, nan, e);
    }
    free(values);
    free(t.tower);
    return done;
}
