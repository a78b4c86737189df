// Measures of the flow through vessels, and of their orders by diameter.
#include "base/memory.h"
#include "objects/vessels/vessels.h"
#include "outtree/diameter_orders.h"
#include "outtree/flow.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define ML_PER_MINUTE 6e7 // in a m^3/s

// The list that measures are added to, under one prefix.
typedef struct Adder {
    MeasureList *list;
    const char *prefix;
    Error *e;
} Adder;

static bool add(const Adder *a, const char *name, double value, const char *unit, double low,
                double high)
{
    char full[sizeof((Measure){0}.name)];
    snprintf(full, sizeof full, "%s_%s", a->prefix, name);
    return measures_add(a->list, full, value, unit, low, high, a->e);
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Shear at the end of each segment: its 10th, 50th and 90th percentile.
static bool find_shears(const OutTree *tree, const SegmentList *segments, const Flow *flow,
                        double shear[3], Error *e)
{
    double *all = memory_alloc(segments->count, sizeof *all, e);
    for (int64_t i = 0; all && i < segments->count; i++) {
        int32_t end = segments->segment[i].to;
        all[i] = flow_wall_shear(flow->viscosity[end], flow->flow[end], (double)tree->radius[end]);
    }
    if (all && segments->count > 0) {
        qsort(all, (size_t)segments->count, sizeof *all, compare_doubles);
    }
    for (int k = 0; all && k < 3; k++) {
        int64_t at = (segments->count - 1) * (1 + 4 * k) / 10;
        shear[k] = segments->count > 0 ? all[at] : (double)NAN;
    }
    free(all);
    return all;
}

static bool add_flow(const Adder *a, const OutTree *tree, const SegmentList *segments,
                     const Flow *flow)
{
    double inflow = 0.0, drop = 0.0, none = (double)NAN, shear[3];
    int64_t ends = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        inflow += tree->parent[i] < 0 ? flow->flow[i] : 0.0;
    }
    for (int64_t i = 0; i < segments->count; i++) {
        if (segments->segment[i].children == 0) {
            drop += fabs(flow->pressure[segments->segment[i].to] - flow->pressure[0]);
            ends++;
        }
    }
    drop = ends > 0 ? drop / (double)ends : none;
    return find_shears(tree, segments, flow, shear, a->e) &&
           add(a, "inflow", inflow > 0.0 ? inflow * ML_PER_MINUTE : none, "ml/min", none, none) &&
           add(a, "resistance", inflow > 0.0 ? drop / inflow : none, "Pa s/m3", none, none) &&
           add(a, "pressure_drop", drop, "Pa", none, none) &&
           add(a, "wall_shear", shear[1], "Pa", none, none) &&
           add(a, "wall_shear_low", shear[0], "Pa", none, none) &&
           add(a, "wall_shear_high", shear[2], "Pa", none, none);
}

// Ranges: coronary and pulmonary vessels (Kassab 1993, Huang 1996).
static bool add_orders(const Adder *a, const DiameterOrders *orders, int64_t segments)
{
    double none = (double)NAN;
    double series =
        orders->element_count > 0 ? (double)segments / (double)orders->element_count : none;
    return add(a, "orders", (double)orders->highest, "", none, none) &&
           add(a, "order_number", orders->number, "", 3.3, 3.6) &&
           add(a, "order_diameter", orders->diameter_ratio, "", 1.5, 1.9) &&
           add(a, "order_length", orders->length_ratio, "", 1.4, 2.2) &&
           add(a, "segments_in_series", series, "", none, none);
}

bool vessels_measure_flow(const OutTree *tree, const FlowParams *params, const char *prefix,
                          MeasureList *list, Error *e)
{
    Adder adder = {list, prefix, e};
    Flow flow;
    SegmentList segments;
    DiameterOrders orders;
    if (!flow_init(&flow, tree, params, e)) {
        return false;
    }
    bool done = segments_init(&segments, tree, e);
    if (done) {
        done = add_flow(&adder, tree, &segments, &flow);
        if (done && (done = diameter_orders_init(&orders, tree, &segments, e))) {
            done = add_orders(&adder, &orders, segments.count);
            diameter_orders_free(&orders);
        }
        segments_free(&segments);
    }
    flow_free(&flow);
    return done;
}
