#include "land/braid.h"

#include "base/memory.h"
#include "land/braid_parts.h"

#include <stdlib.h>
#include <string.h>

Braid *braid_new(int side, double size, double width, double slope, double mean, Error *e)
{
    Braid *b = memory_alloc_zero(1, sizeof *b, e);
    if (!b) {
        return NULL;
    }
    *b = (Braid){.side = side, .cell = size / side, .slope = slope, .mean = mean, .width = width};
    int64_t count = (int64_t)side * side;
    float **arrays[] = {&b->depth,    &b->flow_x, &b->flow_z, &b->shear,  &b->age,
                        &b->erodible, &b->ground, &b->next_x, &b->next_z, &b->share};
    bool done = (b->bed = memory_alloc_zero(count, sizeof *b->bed, e)) &&
                (b->load = memory_alloc_zero(3 * count, sizeof *b->load, e)) &&
                (b->span = memory_alloc_zero(side, sizeof *b->span, e)) &&
                (b->wet = memory_alloc_zero(side, sizeof *b->wet, e));
    for (size_t k = 0; done && k < sizeof arrays / sizeof *arrays; k++) {
        *arrays[k] = memory_alloc_zero(count, sizeof(float), e);
        done = *arrays[k];
    }
    if (!done) {
        braid_free(b);
        return NULL;
    }
    for (int64_t i = 0; i < count; i++) {
        b->erodible[i] = 1.0f;
    }
    return b;
}

void braid_free(Braid *b)
{
    if (b) {
        free(b->bed);
        free(b->depth);
        free(b->flow_x);
        free(b->flow_z);
        free(b->shear);
        free(b->age);
        free(b->erodible);
        free(b->ground);
        free(b->next_x);
        free(b->next_z);
        free(b->share);
        free(b->load);
        free(b->span);
        free(b->wet);
        free(b);
    }
}

double braid_volume(const Braid *b)
{
    double sum = 0.0;
    for (int64_t i = 0; i < braid_count(b); i++) {
        sum += b->bed[i];
    }
    return sum * b->cell * b->cell;
}

double braid_water(const Braid *b)
{
    double sum = 0.0;
    for (int64_t i = 0; i < braid_count(b); i++) {
        sum += (double)b->depth[i];
    }
    return sum * b->cell * b->cell;
}

double braid_discharge(const Braid *b)
{
    double sum = 0.0;
    for (int64_t i = 0; i < braid_count(b); i++) {
        sum += (double)b->flow_z[i];
    }
    return sum * b->cell / b->side;
}

double braid_forming_discharge(const Braid *b)
{
    return b->width * BRAID_FROUDE * sqrt(BRAID_GRAVITY * b->mean) * b->mean;
}

// Places of the finer cells lie a quarter of a coarse cell from its middle: weights 3/4 and 1/4.
// Each coarse cell gives all of its volume, so the sum stays.
static double finer_value(const Braid *b, const double *field, int column, int row)
{
    int side = b->side, c = column / 2, r = row / 2;
    int c2 = c + (column % 2 ? 1 : -1), r2 = (r + (row % 2 ? 1 : -1) + side) % side;
    c2 = c2 < 0 ? 0 : c2 >= side ? side - 1 : c2; // the walls mirror
    const double *near = field + (int64_t)r * side, *far = field + (int64_t)r2 * side;
    return 0.75 * (0.75 * near[c] + 0.25 * near[c2]) + 0.25 * (0.75 * far[c] + 0.25 * far[c2]);
}

Braid *braid_refined(const Braid *b, Error *e)
{
    Braid *f = braid_new(2 * b->side, b->cell * b->side, b->width, b->slope, b->mean, e);
    double *level = f ? memory_alloc(braid_count(b), sizeof *level, e) : NULL;
    if (!level) {
        braid_free(f);
        return NULL;
    }
    for (int64_t i = 0; i < braid_count(b); i++) {
        level[i] = b->bed[i] + (double)b->depth[i];
    }
    for (int row = 0; row < f->side; row++) {
        for (int column = 0; column < f->side; column++) {
            int64_t i = (int64_t)row * f->side + column;
            int64_t from = (int64_t)(row / 2) * b->side + column / 2;
            f->bed[i] = finer_value(b, b->bed, column, row);
            double water = finer_value(b, level, column, row) - f->bed[i];
            f->depth[i] = b->depth[from] > 0.0f && water > 0.0 ? (float)water : 0.0f;
            f->flow_x[i] = b->flow_x[from];
            f->flow_z[i] = b->flow_z[from];
            f->age[i] = b->age[from];
            f->erodible[i] = b->erodible[from];
        }
    }
    free(level);
    return f;
}

// Water enters or leaves everywhere in proportion to its depth, until the discharge is right.
static void correct_discharge(Braid *b, double wanted)
{
    double now = braid_discharge(b);
    double ratio = now > 0.0 ? wanted / now : 2.0;
    ratio = ratio > 2.0 ? 2.0 : ratio < 0.5 ? 0.5 : ratio;
    float scale = (float)(1.0 + BRAID_CORRECTION * (ratio - 1.0));
    for (int row = 0; row < b->side; row++) {
        float *depth = b->depth + (int64_t)row * b->side;
        for (int c = b->span[row].begin; c < b->span[row].end; c++) {
            depth[c] *= scale;
        }
    }
}

bool braid_run(Braid *b, const BraidRates *rates, const Run *run, Error *e)
{
    double wanted = rates->discharge * braid_forming_discharge(b);
    int64_t updates = 1 + (int64_t)(rates->turnovers / braid_update_turnovers(b));
    braid_begin(b);
    for (int64_t n = 0; n < updates; n++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        if (n % 64 == 0) {
            run_progress(run, "river", (double)n / (double)updates);
        }
        float step = braid_step_limit(b);
        for (int k = 0; k < BRAID_FLOW_STEPS; k++) {
            braid_flow(b, step, run->threads);
        }
        correct_discharge(b, wanted);
        braid_find_load(b, run->threads);
        if (rates->moves) {
            braid_move_bed(b, run->threads);
        }
    }
    return true;
}
