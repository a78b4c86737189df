// What the cells of a delta's model tell, made continuous: levels beneath dry land, the distance of
// channels, ages, mud that spreads through bays and out to sea.
#include "base/memory.h"
#include "objects/terrain/delta.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void delta_land_free(DeltaLand *land)
{
    if (!land) {
        return;
    }
    delta_free(land->model);
    free(land->ground);
    free(land->level);
    free(land->levee);
    free(land->age);
    free(land->load);
    free(land->way_x);
    free(land->way_z);
    free(land->fine_load);
    creeks_free(land->creeks);
    free(land);
}

// ---- values that spread from cells where they are known

typedef struct Spread {
    const Delta *d;
    float *value;
    uint8_t *known; // 1 = given, 2 = found
    float fade;     // what is left of a value a cell away
} Spread;

// The mean of the neighbours along the axes that are known up to `upto`; false without any.
static bool mean_beside(const Spread *s, int64_t i, int upto, float *mean)
{
    int columns = s->d->columns, rows = s->d->rows, count = 0;
    int column = (int)(i % columns), row = (int)(i / columns);
    float sum = 0.0f;
    for (int k = 0; k < 4; k++) {
        int c = column + (k == 0) - (k == 1), r = row + (k == 2) - (k == 3);
        int64_t n = (int64_t)r * columns + c;
        if (c >= 0 && r >= 0 && c < columns && r < rows && s->known[n] > 0 && s->known[n] <= upto) {
            sum += s->value[n];
            count++;
        }
    }
    *mean = count > 0 ? sum / (float)count : 0.0f;
    return count > 0;
}

// Fills cells outward, ring by ring, then evens out what was filled.
static bool spread(Spread *s, int sweeps, Error *e)
{
    int64_t count = delta_count(s->d);
    float *found = memory_alloc(count, sizeof *found, e);
    for (bool more = true; found && more;) {
        more = false;
        memcpy(found, s->value, (size_t)count * sizeof *found);
        for (int64_t i = 0; i < count; i++) {
            if (s->known[i] == 0 && mean_beside(s, i, 2, &found[i])) {
                found[i] *= s->fade;
                s->known[i] = 3; // counts from the next ring on
                more = true;
            }
        }
        for (int64_t i = 0; i < count; i++) {
            s->known[i] = s->known[i] == 3 ? 2 : s->known[i];
        }
        memcpy(s->value, found, (size_t)count * sizeof *found);
    }
    for (int n = 0; found && n < sweeps; n++) {
        for (int64_t i = 0; i < count; i++) {
            found[i] = s->value[i];
            if (s->known[i] == 2 && mean_beside(s, i, 2, &found[i])) {
                found[i] *= s->fade;
            }
        }
        memcpy(s->value, found, (size_t)count * sizeof *found);
    }
    free(found);
    return found;
}

// ---- levels

static bool is_wet(const Delta *d, int64_t i)
{
    return d->kind[i] != DELTA_PLAIN && d->level[i] - d->bed[i] > DELTA_DRY * d->depth;
}

static bool find_levels(DeltaLand *land, uint8_t *known, Error *e)
{
    const Delta *d = land->model;
    for (int64_t i = 0; i < delta_count(d); i++) {
        known[i] = is_wet(d, i);
        land->level[i] = (float)(d->level[i] - DELTA_FALL * d->depth);
        land->ground[i] = (float)d->bed[i];
    }
    Spread s = {d, land->level, known, 1.0f};
    if (!spread(&s, 40, e)) {
        return false;
    }
    for (int64_t i = 0; i < delta_count(d); i++) { // old land stands above its river
        if (d->kind[i] == DELTA_PLAIN) {
            land->ground[i] += land->level[i];
        }
    }
    return true;
}

// ---- channels

static bool is_channel(const Delta *d, int64_t i)
{
    return d->kind[i] == DELTA_TRUNK || (d->kind[i] == DELTA_OPEN && d->speed[i] > 0.3 &&
                                         d->level[i] - d->bed[i] > 0.08 * d->depth);
}

// Distances over the grid, in two sweeps (Borgefors 1986).
static void find_levees(DeltaLand *land)
{
    const Delta *d = land->model;
    const float reach = 3.0f, far = 1e6f;
    const int ways[4][2] = {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    int64_t count = delta_count(d);
    for (int64_t i = 0; i < count; i++) {
        land->levee[i] = is_channel(d, i) ? 0.0f : far;
    }
    for (int64_t k = 0; k < 2 * count; k++) {
        bool back = k >= count;
        int64_t i = back ? 2 * count - 1 - k : k;
        int column = (int)(i % d->columns), row = (int)(i / d->columns);
        for (int n = 0; n < 4; n++) {
            int c = column + (back ? -ways[n][0] : ways[n][0]);
            int r = row + (back ? -ways[n][1] : ways[n][1]);
            if (c >= 0 && r >= 0 && c < d->columns && r < d->rows) {
                float step = ways[n][0] != 0 && ways[n][1] != 0 ? 1.41421356f : 1.0f;
                land->levee[i] =
                    fminf(land->levee[i], land->levee[(int64_t)r * d->columns + c] + step);
            }
        }
    }
    for (int64_t i = 0; i < count; i++) {
        land->levee[i] = fmaxf(1.0f - land->levee[i] / reach, 0.0f);
    }
}

// ---- ages and mud

static void find_ages(DeltaLand *land, double total)
{
    const Delta *d = land->model;
    for (int64_t i = 0; i < delta_count(d); i++) {
        double since = (double)(d->step - d->bared[i]) / fmax(total, 1.0);
        land->age[i] = d->kind[i] == DELTA_PLAIN ? 1.0f : (float)(0.7 * since / (since + 0.12));
    }
}

// The way of the water, unit or 0, of each cell: that of the flow where there is one; elsewhere
// spread from there, and bent to the right, as the Earth's turning bends plumes in the north.
static bool find_ways(const DeltaLand *land, const uint8_t *flows, float *x, float *z, Error *e)
{
    const Delta *d = land->model;
    const float bend = 0.3f; // to the right, of what goes ahead
    int64_t count = delta_count(d);
    uint8_t *known = memory_alloc(count, sizeof *known, e);
    bool done = known;
    for (int axis = 0; done && axis < 2; axis++) {
        float *way = axis == 0 ? x : z;
        for (int64_t i = 0; i < count; i++) {
            double flow = sqrt(d->flow_x[i] * d->flow_x[i] + d->flow_z[i] * d->flow_z[i]);
            known[i] = flows[i] == 1 && flow > 0.0;
            way[i] = known[i] ? (float)((axis == 0 ? d->flow_x[i] : d->flow_z[i]) / flow) : 0.0f;
        }
        Spread s = {d, way, known, 1.0f};
        done = spread(&s, 12, e);
    }
    for (int64_t i = 0; done && i < count; i++) {
        if (!known[i] || known[i] == 2) {
            float to_x = x[i] - bend * z[i], to_z = z[i] + bend * x[i];
            float length = sqrtf(to_x * to_x + to_z * to_z);
            x[i] = length > 0.0f ? to_x / length : 0.0f;
            z[i] = length > 0.0f ? to_z / length : 0.0f;
        }
    }
    free(known);
    return done;
}

// Bilinear, at cells; on the rim beyond it.
static float load_at(const Delta *d, const float *load, float column, float row)
{
    column = clampf(column, 0.0f, (float)(d->columns - 1));
    row = clampf(row, 0.0f, (float)(d->rows - 1));
    int c = (int)column, r = (int)row;
    c = c > d->columns - 2 ? d->columns - 2 : c;
    r = r > d->rows - 2 ? d->rows - 2 : r;
    float u = column - (float)c, v = row - (float)r;
    const float *at = load + (int64_t)r * d->columns + c;
    return lerpf(lerpf(at[0], at[1], u), lerpf(at[d->columns], at[d->columns + 1], u), v);
}

// Plumes: where the river's water runs out to sea it carries its mud on, widens by mixing with the
// sea beside it and loses some to the bed on its way. known: 1 where the mud is given.
static bool run_out(DeltaLand *land, const uint8_t *known, Error *e)
{
    const float mixing = 0.16f, left = 0.97f; // a cell of its way
    const Delta *d = land->model;
    int64_t count = delta_count(d);
    float *x = land->way_x = memory_alloc(count, sizeof *x, e);
    float *z = land->way_z = memory_alloc(count, sizeof *z, e);
    float *next = memory_alloc(count, sizeof *next, e);
    bool done = x && z && next && find_ways(land, known, x, z, e);
    for (int n = 0; done && n < d->columns; n++) {
        for (int64_t i = 0; i < count; i++) {
            next[i] = land->load[i];
            if (known[i] != 1) {
                int64_t line = i / d->columns;
                float column = (float)(i % d->columns), row = (float)line;
                float before = load_at(d, land->load, column - x[i], row - z[i]);
                float beside =
                    0.5f * (load_at(d, land->load, column - x[i] - z[i], row - z[i] + x[i]) +
                            load_at(d, land->load, column - x[i] + z[i], row - z[i] - x[i]));
                next[i] = left * lerpf(before, beside, mixing);
            }
        }
        memcpy(land->load, next, (size_t)count * sizeof *next);
    }
    free(next);
    return done;
}

static bool find_load(DeltaLand *land, uint8_t *known, Error *e)
{
    const double least = 0.01; // water that tells, of the river's
    const Delta *d = land->model;
    for (int64_t i = 0; i < delta_count(d); i++) {
        bool runs = d->kind[i] == DELTA_TRUNK || is_channel(d, i);
        known[i] = runs && is_wet(d, i) && d->water[i] > least;
        land->load[i] = known[i] ? (float)fmin(d->mud[i] / d->water[i], 1.2) : 0.0f;
    }
    if (!run_out(land, known, e)) {
        return false;
    }
    // Bays beside channels mix with them.
    for (int64_t i = 0; i < delta_count(d); i++) {
        known[i] = 1;
        if (d->kind[i] != DELTA_TRUNK && !is_channel(d, i)) {
            known[i] = 2;
        }
    }
    Spread s = {d, land->load, known, 1.0f};
    return spread(&s, 3, e);
}

bool delta_land_finish(DeltaLand *land, double total, Error *e)
{
    int64_t count = delta_count(land->model);
    uint8_t *known = memory_alloc(count, sizeof *known, e);
    bool done = known && (land->ground = memory_alloc(count, sizeof(float), e)) &&
                (land->level = memory_alloc(count, sizeof(float), e)) &&
                (land->levee = memory_alloc(count, sizeof(float), e)) &&
                (land->age = memory_alloc(count, sizeof(float), e)) &&
                (land->load = memory_alloc(count, sizeof(float), e)) &&
                find_levels(land, known, e) && find_load(land, known, e);
    if (done) {
        find_levees(land);
        find_ages(land, total);
    }
    free(known);
    return done;
}
