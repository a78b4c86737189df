#include "land/height_measure.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "land/basin_hypsometry.h"

#include <math.h>
#include <stdlib.h>

// ---- line fits

typedef struct LineFit {
    double n, x, y, xx, xy;
} LineFit;

static void fit_add(LineFit *fit, double x, double y)
{
    fit->n += 1.0;
    fit->x += x;
    fit->y += y;
    fit->xx += x * x;
    fit->xy += x * y;
}

// Least-squares slope; NAN with fewer than `least` points or all at one x.
static double fit_slope(const LineFit *fit, double least)
{
    double spread = fit->n * fit->xx - fit->x * fit->x;
    if (fit->n < least || !(spread > 1e-12)) {
        return (double)NAN;
    }
    return (fit->n * fit->xy - fit->x * fit->y) / spread;
}

// ---- stream orders

bool drainage_orders(const Drainage *drainage, double least_area, uint8_t *order, Error *e)
{
    // per sample: how many of its donors share the highest order so far
    uint8_t *equals = memory_alloc_zero(drainage->samples, 1, e);
    if (!equals) {
        return false;
    }
    for (int64_t k = drainage->count - 1; k >= 0; k--) {
        int32_t i = drainage->order[k], to = drainage->receiver[i];
        if (drainage->area[i] <= least_area) {
            continue;
        }
        if (order[i] == 0) {
            order[i] = 1; // a source
        } else if (equals[i] > 1) {
            order[i]++;
        }
        if (to == i) {
            continue;
        }
        if (order[i] > order[to]) {
            order[to] = order[i];
            equals[to] = 1;
        } else if (order[i] == order[to]) {
            equals[to] = equals[to] < 255 ? (uint8_t)(equals[to] + 1) : 255;
        }
    }
    free(equals);
    return true;
}

// BASIN_ORDER: Strahler (1952) measures basins of third and fourth order.
enum { MAX_ORDERS = 24, AREA_BINS = 64, BASIN_ORDER = 3 };

typedef struct OrderSums {
    double streams, length, area;
} OrderSums;

typedef struct AreaBin {
    double samples, log_area, path, drop, run;
} AreaBin;

typedef struct Survey {
    const HeightField *field;
    const Drainage *drainage;
    double least_area;
    uint8_t *order;
    float *path; // m: length from the farthest upstream sample
    OrderSums sums[MAX_ORDERS];
    AreaBin bin[AREA_BINS];
    int top; // the highest order
    int64_t river_samples, draining;
} Survey;

static float run_length(const HeightField *field, int32_t from, int32_t to)
{
    float x = field->cell.x * (float)(from % field->columns - to % field->columns);
    int rows = from / field->columns - to / field->columns;
    float z = field->cell.y * (float)rows;
    return sqrtf(x * x + z * z);
}

static void measure_paths(Survey *s)
{
    const Drainage *d = s->drainage;
    for (int64_t k = d->count - 1; k >= 0; k--) {
        int32_t i = d->order[k], to = d->receiver[i];
        float length = s->path[i] + run_length(s->field, i, to);
        s->path[to] = length > s->path[to] && to != i ? length : s->path[to];
    }
}

// Sums over the streams of each order; a stream ends where the order rises or the field ends.
static void sum_orders(Survey *s)
{
    const Drainage *d = s->drainage;
    for (int64_t k = 0; k < d->count; k++) {
        int32_t i = d->order[k], to = d->receiver[i];
        int order = s->order[i];
        if (order == 0 || order >= MAX_ORDERS) {
            continue;
        }
        s->top = order > s->top ? order : s->top;
        s->sums[order].length += (double)run_length(s->field, i, to);
        if (to == i || s->order[to] != order) {
            s->sums[order].streams += 1.0;
            s->sums[order].area += d->area[i];
        }
    }
}

// Binned by octaves of area, so that Hack's law and the slope-area law weight small and large
// rivers equally.
static void sum_areas(Survey *s)
{
    const Drainage *d = s->drainage;
    const double half_octave = 0.34657359027997264;
    for (int64_t k = 0; k < d->count; k++) {
        int32_t i = d->order[k], to = d->receiver[i];
        if (s->order[i] == 0 || to == i) {
            continue;
        }
        double log_area = exact_log(d->area[i]);
        int b = (int)((log_area - exact_log(s->least_area)) / half_octave);
        AreaBin *bin = &s->bin[b < 0 ? 0 : b >= AREA_BINS ? AREA_BINS - 1 : b];
        bin->samples += 1.0;
        bin->log_area += log_area;
        bin->path += exact_log((double)s->path[i] + 1e-9);
        bin->drop += (double)(d->filled[i] - d->filled[to]);
        bin->run += (double)run_length(s->field, i, to);
    }
}

// Whether water that follows the receivers never flows uphill.
static bool count_draining(Survey *s, Error *e)
{
    const Drainage *d = s->drainage;
    const float *height = s->field->height;
    uint8_t *drains = memory_alloc_zero(height_field_count(s->field), 1, e);
    for (int64_t k = 0; drains && k < d->count; k++) {
        int32_t i = d->order[k], to = d->receiver[i];
        drains[i] = to == i || (drains[to] && height[to] <= height[i]);
        s->river_samples += s->order[i] > 0;
        s->draining += s->order[i] > 0 && drains[i];
    }
    bool done = drains != NULL;
    free(drains);
    return done;
}

// ---- results

// exp of the slope of log(sums per stream) over the orders; NAN with fewer than three orders.
static double horton_ratio(const Survey *s, int which)
{
    LineFit fit = {0};
    for (int order = 1; order <= s->top; order++) {
        const OrderSums *sums = &s->sums[order];
        double value = which == 0   ? 1.0 / sums->streams
                       : which == 1 ? sums->length / sums->streams
                                    : sums->area / sums->streams;
        // A last river that leaves the field after a few steps has no meaningful length.
        if (sums->streams > 0.0 && value > 0.0 && !(which == 1 && order == s->top)) {
            fit_add(&fit, order, exact_log(value));
        }
    }
    double slope = fit_slope(&fit, which == 1 ? 2.0 : 3.0);
    return isnan(slope) ? slope : exact_exp(slope);
}

// Hack's 0.55 to 0.6 is of rivers followed to their mouths. A square of land cuts large rivers
// short: surveyed squares have 0.455 to 0.54 by this code (docs/references.md).
static double hack_exponent(const Survey *s)
{
    LineFit fit = {0};
    for (int b = 0; b < AREA_BINS; b++) {
        const AreaBin *bin = &s->bin[b];
        if (bin->samples >= 4.0) {
            fit_add(&fit, bin->log_area / bin->samples, bin->path / bin->samples);
        }
    }
    return fit_slope(&fit, 3.0);
}

static double concavity(const Survey *s)
{
    LineFit fit = {0};
    for (int b = 0; b < AREA_BINS; b++) {
        const AreaBin *bin = &s->bin[b];
        if (bin->samples >= 4.0 && bin->drop > 0.0) {
            fit_add(&fit, bin->log_area / bin->samples, exact_log(bin->drop / bin->run));
        }
    }
    return -fit_slope(&fit, 3.0);
}

static double hypsometric_integral(const HeightField *field, double *relief)
{
    double sum = 0.0, count = 0.0, low = 1e300, high = -1e300;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        double h = (double)field->height[i];
        if (isfinite(h)) {
            sum += h;
            count += 1.0;
            low = h < low ? h : low;
            high = h > high ? h : high;
        }
    }
    *relief = count > 0.0 ? high - low : (double)NAN;
    return *relief > 0.0 ? (sum / count - low) / *relief : (double)NAN;
}

static bool list_survey(const Survey *s, MeasureList *list, Error *e)
{
    double relief, nan = (double)NAN;
    double integral = hypsometric_integral(s->field, &relief), basins;
    if (!basin_hypsometry(s->field, s->drainage, s->order, BASIN_ORDER, &basins, e)) {
        return false;
    }
    double share = s->river_samples > 0 ? (double)s->draining / (double)s->river_samples : nan;
    return measures_add(list, "relief", relief, "m", nan, nan, e) &&
           measures_add(list, "river_orders", s->top, "", nan, nan, e) &&
           measures_add(list, "horton_bifurcation_ratio", horton_ratio(s, 0), "", 3, 5, e) &&
           measures_add(list, "horton_length_ratio", horton_ratio(s, 1), "", 1.5, 3.5, e) &&
           measures_add(list, "horton_area_ratio", horton_ratio(s, 2), "", 3, 6, e) &&
           measures_add(list, "hack_exponent", hack_exponent(s), "", 0.455, 0.6, e) &&
           measures_add(list, "concavity", concavity(s), "", 0.225, 0.575, e) &&
           measures_add(list, "hypsometric_integral", integral, "", 0.35, 0.6, e) &&
           measures_add(list, "basin_hypsometric_integral", basins, "", 0.35, 0.6, e) &&
           measures_add(list, "pits", (double)s->drainage->pits, "", nan, nan, e) &&
           measures_add(list, "rivers_that_drain", share, "", nan, nan, e);
}

double height_field_river_area(const HeightField *field)
{
    double cell = (double)field->cell.x * (double)field->cell.y;
    return fmax(1e-3 * (double)height_field_count(field), 32.0) * cell;
}

bool height_field_measure(const HeightField *field, double least_area, MeasureList *list, Error *e)
{
    int64_t count = height_field_count(field);
    Survey s = {.field = field,
                .least_area = least_area > 0.0 ? least_area : height_field_river_area(field)};
    Drainage *drainage = drainage_new(field, e);
    s.drainage = drainage;
    s.order = memory_alloc_zero(count, 1, e);
    s.path = memory_alloc_zero(count, sizeof *s.path, e);
    bool done =
        drainage && s.order && s.path && drainage_orders(drainage, s.least_area, s.order, e);
    if (done) {
        measure_paths(&s);
        sum_orders(&s);
        sum_areas(&s);
        done = count_draining(&s, e) && list_survey(&s, list, e);
    }
    drainage_free(drainage);
    free(s.order);
    free(s.path);
    return done;
}
