// Streams: dh/dt = -K A^0.5 S + G Q / A, Q the load of sediment from upstream (Yuan et al. 2019).
// Heights are found implicitly from the bases up, bed by bed, with the load of the last step; then
// the load is summed downstream, and no more is dropped than arrives.
#include "base/memory.h"
#include "land/landscape_parts.h"

#include <math.h>
#include <stdlib.h>

// Erosion of one sample, layer by layer. The step is implicit: everything erodes at the slope that
// the sample has at its end, dh/dt = -k (h - below). So a layer of thickness d and rate k that is
// cut through takes the share d / (k (h - below)) of the step.
typedef struct Cutting {
    double top, below; // m: of what is left; of the receiver
    double spent;      // sum of d / k over the layers that are cut through, m
} Cutting;

// Cuts into a layer; true if the step ends in it, at c->top.
static bool cut_layer(Cutting *c, double k, double floor)
{
    if (k <= 0.0) {
        return true;
    }
    double height = (c->top + k * (c->spent + c->below)) / (1.0 + k);
    if (height >= floor) {
        c->top = height;
        return true;
    }
    c->spent += (c->top - floor) / k;
    c->top = floor;
    return false;
}

// The height of sample i after the step. power: sqrt(area) * time / length.
static double cut(const Landscape *land, const LandscapeRates *rates, int64_t i, double power,
                  double dropped, double below)
{
    enum { MOST_BEDS = 16 }; // in one step
    double rock = land->rock[i], weakness = (double)land->weakness[i];
    Cutting c = {rock + land->loose[i] + dropped, below, 0.0};
    bool ends = c.top <= below ||
                (c.top > rock && cut_layer(&c, power * rates->loose, rock > below ? rock : below));
    for (int k = 0; k < MOST_BEDS && !ends; k++) {
        // A little lower, so that a sample at a contact is cut in the lower bed.
        int bed = landscape_bed(land, i, c.top - 1e-3);
        double erodibility = landscape_erodibility(landscape_hardness(land, bed));
        double floor =
            land->strata ? (double)land->stack[i] + (double)land->strata->floor[bed] : -INFINITY;
        ends = cut_layer(&c, power * rates->incision * weakness * erodibility, floor);
    }
    return c.top;
}

// Finds the heights after the step.
static void find_heights(const Landscape *land, const LandscapeRates *rates, double time,
                         double *height)
{
    const Routing *route = land->route;
    double own = land->cell * land->cell;
    for (int64_t k = 0; k < route->count; k++) {
        int32_t i = route->order[k], to = route->receiver[i];
        if (to == i) {
            height[i] = land->rock[i] + land->loose[i];
            continue;
        }
        int32_t step = to > i ? to - i : i - to;
        bool straight = step == 1 || step == land->side;
        double length = land->cell * (straight ? 1.0 : 1.4142135623730951);
        double area = route->area[i];
        double gathers = area / (area + rates->least_area);
        double power = gathers * sqrt(area) * time / length;
        // Never more than lies on a cell: the load passes on.
        double dropped = rates->deposition * land->load[i] / area;
        double most = land->load[i] / own;
        height[i] = cut(land, rates, i, power, dropped < most ? dropped : most, height[to]);
    }
}

// Moves sediment downstream so that heights come true as far as the load allows.
static void carry(Landscape *land, const double *height)
{
    const Routing *route = land->route;
    double own = land->cell * land->cell;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->load[i] = 0.0;
    }
    for (int64_t k = route->count - 1; k >= 0; k--) {
        int32_t i = route->order[k], to = route->receiver[i];
        if (to == i) {
            land->outflow += land->load[i];
            continue;
        }
        double rise = height[i] - (land->rock[i] + land->loose[i]), load = land->load[i];
        if (rise > 0.0) {
            rise = rise * own < load ? rise : load / own;
            land->loose[i] += rise;
        } else {
            double dug = -rise, loose = dug < land->loose[i] ? dug : land->loose[i];
            land->loose[i] -= loose;
            land->rock[i] -= dug - loose;
        }
        land->load[to] += load - rise * own;
    }
}

bool landscape_streams(Landscape *land, const LandscapeRates *rates, double time, Error *e)
{
    double *height = memory_alloc(landscape_count(land), sizeof *height, e);
    if (!height) {
        return false;
    }
    find_heights(land, rates, time, height);
    carry(land, height);
    free(height);
    return true;
}
