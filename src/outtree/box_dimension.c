#include "outtree/box_dimension.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { COARSEST = 2, MIN_SIZES = 3, MAX_HALVINGS = 20 };
#define SAMPLES_PER_BOX 4.0 // samples per box along a segment
#define MAX_SAMPLES 1.6e7

// Boxes of the finest size, identified by Morton codes; dropping low bits gives the coarser boxes.
typedef struct BoxSet {
    Vec3 low;
    double inverse_size; // 1/m, of the finest boxes
    int halvings;        // the extent spans 2^halvings of them
    uint64_t *name;
    int64_t count, capacity;
} BoxSet;

static uint64_t spread_bits(uint64_t x)
{
    uint64_t out = 0;
    for (int bit = 0; bit < MAX_HALVINGS; bit++) {
        out |= (x >> bit & 1u) << (3 * bit);
    }
    return out;
}

static uint64_t box_of(const BoxSet *set, Vec3 p)
{
    const float at[3] = {p.x - set->low.x, p.y - set->low.y, p.z - set->low.z};
    double most = (double)(1ll << set->halvings) - 1.0;
    uint64_t name = 0;
    for (int axis = 0; axis < 3; axis++) {
        double cell = (double)at[axis] * set->inverse_size;
        cell = cell > 0.0 ? (cell < most ? cell : most) : 0.0;
        name |= spread_bits((uint64_t)cell) << axis;
    }
    return name;
}

static bool add_box(BoxSet *set, Vec3 p, Error *e)
{
    uint64_t name = box_of(set, p);
    if (set->count > 0 && set->name[set->count - 1] == name) {
        return true;
    }
    if (!memory_reserve(&set->name, &set->capacity, set->count + 1, sizeof *set->name, e)) {
        return false;
    }
    set->name[set->count++] = name;
    return true;
}

static int compare_names(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

// Number of distinct codes after dropping their last 3 * dropped bits; the codes are sorted.
static int64_t count_boxes(const BoxSet *set, int dropped)
{
    int64_t count = 0;
    for (int64_t i = 0; i < set->count; i++) {
        count += i == 0 || set->name[i] >> (3 * dropped) != set->name[i - 1] >> (3 * dropped);
    }
    return count;
}

// Slope of log2 (boxes) over halvings, starting at boxes of a quarter of the extent.
static double fit_dimension(BoxSet *set)
{
    qsort(set->name, (size_t)set->count, sizeof *set->name, compare_names);
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int k = COARSEST; k <= set->halvings; k++) {
        double x = k, y = exact_log((double)count_boxes(set, set->halvings - k)) / exact_log(2.0);
        n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// Chooses boxes over bounds, no finer than `finest`; false when they give too few sizes.
static bool set_up(BoxSet *set, Aabb bounds, double finest)
{
    double extent = (double)aabb_extent(bounds);
    *set = (BoxSet){.low = bounds.low};
    while (set->halvings < MAX_HALVINGS && extent > 2.0 * finest) {
        extent *= 0.5;
        set->halvings++;
    }
    set->inverse_size = 1.0 / extent;
    return finest > 0.0 && set->halvings >= COARSEST + MIN_SIZES - 1;
}

bool points_box_dimension(const Vec3 *points, int64_t count, double finest, double *dimension,
                          Error *e)
{
    Aabb bounds = aabb_empty();
    for (int64_t i = 0; i < count; i++) {
        bounds = aabb_add(bounds, points[i]);
    }
    BoxSet set;
    *dimension = (double)NAN;
    if (count == 0 || !set_up(&set, bounds, finest)) {
        return true;
    }
    bool done = true;
    for (int64_t i = 0; done && i < count; i++) {
        done = add_box(&set, points[i], e);
    }
    *dimension = done ? fit_dimension(&set) : (double)NAN;
    free(set.name);
    return done;
}

static bool add_segment(BoxSet *set, Vec3 a, Vec3 b, Error *e)
{
    double pieces = (double)vec3_distance(a, b) * set->inverse_size * SAMPLES_PER_BOX;
    int64_t count = 1 + (int64_t)pieces;
    bool done = true;
    for (int64_t i = 0; done && i <= count; i++) {
        done = add_box(set, vec3_lerp(a, b, (float)i / (float)count), e);
    }
    return done;
}

bool out_tree_box_dimension(const OutTree *tree, double *dimension, Error *e)
{
    double length = 0.0, segments = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            length += (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
            segments += 1.0;
        }
    }
    *dimension = (double)NAN;
    double finest = length / segments; // bounds the number of samples of a long tree
    finest = fmax(finest, SAMPLES_PER_BOX * length / MAX_SAMPLES);
    BoxSet set;
    if (segments < 1.0 || !set_up(&set, out_tree_bounds(tree), finest)) {
        return true;
    }
    bool done = true;
    for (int64_t i = 0; done && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            done = add_segment(&set, tree->position[tree->parent[i]], tree->position[i], e);
        }
    }
    *dimension = done ? fit_dimension(&set) : (double)NAN;
    free(set.name);
    return done;
}
