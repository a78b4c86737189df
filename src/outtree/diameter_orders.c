#include "outtree/diameter_orders.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "outtree/strahler.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_ROUNDS = 100 };

// Strahler orders of segments: those of the nodes that they lead to.
static bool begin_with_strahler(DiameterOrders *orders, const OutTree *tree,
                                const SegmentList *list, Error *e)
{
    int32_t *of_node = memory_alloc(tree->count, sizeof *of_node, e);
    if (!of_node) {
        return false;
    }
    out_tree_strahler(tree, of_node);
    for (int64_t i = 0; i < list->count; i++) {
        orders->order[i] = of_node[list->segment[i].to];
        orders->highest = orders->order[i] > orders->highest ? orders->order[i] : orders->highest;
    }
    free(of_node);
    return true;
}

static double diameter_of(const SegmentList *list, int64_t segment)
{
    return 2.0 * list->segment[segment].radius;
}

// Mean and standard deviation of the diameters of each order; empty orders are dropped.
static void describe_classes(DiameterOrders *orders, const SegmentList *list)
{
    int32_t renumbered[MOST_DIAMETER_ORDERS + 1] = {0}, highest = 0;
    for (int32_t n = 1; n <= orders->highest; n++) {
        orders->of[n] = (OrderClass){0};
    }
    for (int64_t i = 0; i < list->count; i++) {
        OrderClass *class = &orders->of[orders->order[i]];
        class->segments++;
        class->diameter += diameter_of(list, i);
    }
    for (int32_t n = 1; n <= orders->highest; n++) {
        if (orders->of[n].segments > 0) {
            renumbered[n] = ++highest;
            orders->of[highest] = orders->of[n];
            orders->of[highest].diameter /= (double)orders->of[highest].segments;
        }
    }
    orders->highest = highest;
    for (int64_t i = 0; i < list->count; i++) {
        orders->order[i] = renumbered[orders->order[i]];
        OrderClass *class = &orders->of[orders->order[i]];
        double away = diameter_of(list, i) - class->diameter;
        class->diameter_spread += away * away / (double)class->segments; // a variance until below
    }
    for (int32_t n = 1; n <= highest; n++) {
        orders->of[n].diameter_spread = sqrt(orders->of[n].diameter_spread);
    }
}

// Puts each segment into the class of its diameter; true if one changes.
static bool reassign(DiameterOrders *orders, const SegmentList *list)
{
    double end[MOST_DIAMETER_ORDERS + 1]; // of the range of each order but the highest
    for (int32_t n = 1; n < orders->highest; n++) {
        const OrderClass *low = &orders->of[n], *high = &orders->of[n + 1];
        double between =
            0.5 * (low->diameter + low->diameter_spread + high->diameter - high->diameter_spread);
        bool separates = between > low->diameter && between < high->diameter;
        end[n] = separates ? between : 0.5 * (low->diameter + high->diameter);
    }
    bool changes = false;
    for (int64_t i = 0; i < list->count; i++) {
        int32_t n = 1;
        while (n < orders->highest && diameter_of(list, i) > end[n]) {
            n++;
        }
        changes = changes || n != orders->order[i];
        orders->order[i] = n;
    }
    return changes;
}

// Segment that continues the element of each segment; -1 = none.
static int32_t *find_next(const DiameterOrders *orders, const SegmentList *list, Error *e)
{
    int32_t *next = memory_alloc(list->count, sizeof *next, e);
    for (int64_t i = 0; next && i < list->count; i++) {
        int32_t parent = list->segment[i].parent;
        next[i] = -1;
        if (parent >= 0 && orders->order[parent] == orders->order[i] &&
            (next[parent] < 0 || list->segment[next[parent]].radius < list->segment[i].radius)) {
            next[parent] = (int32_t)i;
        }
    }
    return next;
}

// Elements: runs of segments of one order, and the elements that leave them.
static void join_elements(DiameterOrders *orders, const SegmentList *list, const int32_t *next)
{
    for (int64_t i = 0; i < list->count; i++) {
        int32_t parent = list->segment[i].parent;
        OrderClass *class = &orders->of[orders->order[i]];
        class->length += list->segment[i].length;
        if (parent >= 0 && next[parent] == i) {
            orders->element[i] = orders->element[parent];
            continue;
        }
        orders->element[i] = (int32_t)orders->element_count++;
        class->elements++;
        if (parent >= 0) {
            orders->connectivity[orders->order[i]][orders->order[parent]] += 1.0;
        }
    }
    for (int32_t n = 1; n <= orders->highest; n++) {
        OrderClass *class = &orders->of[n];
        double elements = (double)class->elements;
        class->length /= elements;
        for (int32_t m = 1; m <= orders->highest; m++) {
            orders->connectivity[m][n] /= elements;
        }
    }
}

// Geometric mean of the ratios of neighbouring orders: e^slope through the logarithms.
static double ratio_of(const DiameterOrders *orders, double (*value)(const OrderClass *class))
{
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int32_t w = 1; w <= orders->highest; w++) {
        double v = value(&orders->of[w]);
        if (v > 0.0) {
            double x = w, y = exact_log(v);
            n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
        }
    }
    return n < 2.0 ? (double)NAN : exact_exp((n * sxy - sx * sy) / (n * sxx - sx * sx));
}

static double elements_of(const OrderClass *class)
{
    return (double)class->elements;
}

static double mean_diameter_of(const OrderClass *class)
{
    return class->diameter;
}

static double length_of(const OrderClass *class)
{
    return class->length;
}

static bool find_elements(DiameterOrders *orders, const SegmentList *list, Error *e)
{
    int32_t *next = find_next(orders, list, e);
    if (!next) {
        return false;
    }
    join_elements(orders, list, next);
    free(next);
    orders->number = 1.0 / ratio_of(orders, elements_of);
    orders->diameter_ratio = ratio_of(orders, mean_diameter_of);
    orders->length_ratio = ratio_of(orders, length_of);
    return true;
}

bool diameter_orders_init(DiameterOrders *orders, const OutTree *tree, const SegmentList *list,
                          Error *e)
{
    *orders = (DiameterOrders){.order = memory_alloc(list->count, sizeof *orders->order, e),
                               .element = memory_alloc(list->count, sizeof *orders->element, e)};
    bool done = orders->order && orders->element && begin_with_strahler(orders, tree, list, e);
    if (done) {
        describe_classes(orders, list);
    }
    for (int round = 0; done && round < MOST_ROUNDS && reassign(orders, list); round++) {
        describe_classes(orders, list);
    }
    done = done && find_elements(orders, list, e);
    if (!done) {
        diameter_orders_free(orders);
    }
    return done;
}

void diameter_orders_free(DiameterOrders *orders)
{
    free(orders->order);
    free(orders->element);
    *orders = (DiameterOrders){0};
}
