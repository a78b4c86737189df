#include "outtree/strahler.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_ORDERS = 32 }; // 2^31 nodes have no higher order

void out_tree_strahler(const OutTree *tree, int32_t *order)
{
    // While children are visited, an entry is twice their highest order, plus 1 if two or more
    // share it.
    for (int64_t i = 0; i < tree->count; i++) {
        order[i] = 0;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        order[i] = order[i] == 0 ? 1 : order[i] / 2 + order[i] % 2;
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            int32_t highest = order[parent] / 2;
            if (order[i] > highest) {
                order[parent] = 2 * order[i];
            } else if (order[i] == highest) {
                order[parent] |= 1;
            }
        }
    }
}

// Totals over the streams of one order.
typedef struct OrderSum {
    int64_t streams;
    double length, thickness; // m; length x diameter, m^2
} OrderSum;

static int32_t sum_orders(const OutTree *tree, const int32_t *order, OrderSum *sum)
{
    int32_t highest = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        OrderSum *mine = &sum[order[i]];
        highest = order[i] > highest ? order[i] : highest;
        mine->streams += parent < 0 || order[parent] != order[i];
        if (parent >= 0) {
            double length = (double)vec3_distance(tree->position[i], tree->position[parent]);
            mine->length += length;
            mine->thickness += length * 2.0 * (double)tree->radius[i];
        }
    }
    return highest;
}

// e^slope of the least-squares line through ln value[1..highest]; skips values that are not
// positive.
static double mean_ratio(const double *value, int32_t highest)
{
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int32_t w = 1; w <= highest; w++) {
        if (value[w] > 0.0) {
            double x = w, y = exact_log(value[w]);
            n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
        }
    }
    return n < 2.0 ? (double)NAN : exact_exp((n * sxy - sx * sy) / (n * sxx - sx * sx));
}

bool out_tree_horton(const OutTree *tree, HortonRatios *ratios, Error *e)
{
    int32_t *order = memory_alloc(tree->count, sizeof *order, e);
    if (!order) {
        return false;
    }
    OrderSum sum[MAX_ORDERS + 1] = {{0}};
    double number[MAX_ORDERS + 1], length[MAX_ORDERS + 1], diameter[MAX_ORDERS + 1];
    out_tree_strahler(tree, order);
    int32_t highest = sum_orders(tree, order, sum);
    for (int32_t w = 1; w <= highest; w++) {
        number[w] = (double)sum[w].streams;
        length[w] = sum[w].length / number[w];
        diameter[w] = sum[w].length > 0.0 ? sum[w].thickness / sum[w].length : 0.0;
    }
    *ratios = (HortonRatios){.highest = highest,
                             .number = 1.0 / mean_ratio(number, highest),
                             .length = mean_ratio(length, highest),
                             .diameter = mean_ratio(diameter, highest)};
    free(order);
    return true;
}
