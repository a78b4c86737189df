#include "land/height_drainage.h"

#include "base/lowest_queue.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const int STEP_X[8] = {1, 1, 0, -1, -1, -1, 0, 1};
static const int STEP_Z[8] = {0, 1, 1, 1, 0, -1, -1, -1};

// ---- neighbours

static float step_length(const HeightField *field, int k)
{
    float x = field->cell.x * (float)STEP_X[k], z = field->cell.y * (float)STEP_Z[k];
    return sqrtf(x * x + z * z);
}

// The neighbour of a sample in direction k; -1 outside the field.
static int64_t neighbour(const HeightField *field, int64_t i, int k)
{
    int column = (int)(i % field->columns) + STEP_X[k];
    int row = (int)(i / field->columns) + STEP_Z[k];
    if (column < 0 || row < 0 || column >= field->columns || row >= field->rows) {
        return -1;
    }
    return (int64_t)row * field->columns + column;
}

static bool on_rim(const HeightField *field, int64_t i)
{
    for (int k = 0; k < 8; k++) {
        int64_t n = neighbour(field, i, k);
        if (n < 0 || !isfinite(field->height[n])) {
            return true;
        }
    }
    return false;
}

static bool is_pit(const HeightField *field, int64_t i)
{
    for (int k = 0; k < 8; k++) {
        int64_t n = neighbour(field, i, k);
        if (n < 0 || !(field->height[n] >= field->height[i])) {
            return false;
        }
    }
    return isfinite(field->height[i]) && !on_rim(field, i);
}

int64_t height_field_pits(const HeightField *field)
{
    int64_t pits = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        pits += is_pit(field, i);
    }
    return pits;
}

// ---- priority flood

static float next_above(float x)
{
    uint32_t bits;
    x = x == 0.0f ? 0.0f : x; // no negative zero
    memcpy(&bits, &x, sizeof bits);
    bits += x >= 0.0f ? 1u : (uint32_t)-1;
    memcpy(&x, &bits, sizeof x);
    return x;
}

typedef struct Flood {
    const HeightField *field;
    const uint8_t *outlet; // NULL = the rim
    Drainage *out;
    LowestQueue queue;
    uint8_t *seen;
    float fall;
    bool level;     // pools are level, to the bit; then fall must be 0
    int32_t *trace; // slopes whose neighbours have yet to be reached; NULL = in order of height
    int64_t traced; // of them; `done` have been dealt with
    int64_t done;
    int64_t reached;
} Flood;

static bool begin_at_rim(Flood *flood, Error *e)
{
    const HeightField *field = flood->field;
    for (int64_t i = 0; i < flood->out->count; i++) {
        flood->out->filled[i] = field->height[i];
        flood->out->receiver[i] = (int32_t)i;
        if (!isfinite(field->height[i])) {
            flood->seen[i] = 1;
        } else if (flood->outlet ? flood->outlet[i] : on_rim(field, i)) {
            flood->seen[i] = 1;
            if (!lowest_queue_push(&flood->queue, field->height[i], (int32_t)i, e)) {
                return false;
            }
        }
    }
    return true;
}

// Reaches sample n from `here`, k the direction. Where the ground rises its level is known, so
// tracing need not wait for its turn.
static bool reach(Flood *flood, int32_t here, int64_t n, int k, Error *e)
{
    Drainage *out = flood->out;
    float least = out->filled[here];
    if (flood->fall > 0.0f) {
        least += flood->fall * step_length(flood->field, k);
    }
    float above = flood->level ? out->filled[here] : next_above(out->filled[here]);
    float h = flood->field->height[n];
    least = least > above ? least : above;
    flood->seen[n] = 1;
    out->filled[n] = h > least ? h : least;
    out->receiver[n] = here;
    if (flood->trace && h > least) {
        flood->trace[flood->traced++] = (int32_t)n;
        return true;
    }
    return lowest_queue_push(&flood->queue, out->filled[n], (int32_t)n, e);
}

// Reaches the neighbours of a sample; while tracing, only those that are higher: the others may be
// reached from lower ones, so the sample waits for them in the queue.
static bool reach_around(Flood *flood, int32_t here, bool tracing, Error *e)
{
    int columns = flood->field->columns, rows = flood->field->rows;
    int column = here % columns, row = here / columns;
    bool waits = false;
    for (int k = 0; k < 8; k++) {
        int c = column + STEP_X[k], r = row + STEP_Z[k];
        int64_t n = (int64_t)r * columns + c;
        if (c < 0 || r < 0 || c >= columns || r >= rows || flood->seen[n]) {
            continue;
        }
        if (tracing && !(flood->field->height[n] > next_above(flood->out->filled[here]))) {
            waits = true;
        } else if (!reach(flood, here, n, k, e)) {
            return false;
        }
    }
    return !waits || lowest_queue_push(&flood->queue, flood->out->filled[here], here, e);
}

// Every sample is reached from its lowest flooded neighbour, which is its receiver if it is in a
// pit. Others drain by steepest descent, set by point_downhill. Slopes are traced without the queue
// (after Zhou et al. 2016).
static bool flood_all(Flood *flood, Error *e)
{
    while (flood->queue.count > 0) {
        int32_t here = lowest_queue_pop(&flood->queue).index;
        if (!reach_around(flood, here, false, e)) {
            return false;
        }
        if (!flood->trace) {
            flood->out->order[flood->reached++] = here;
        }
        while (flood->trace && flood->done < flood->traced) {
            if (!reach_around(flood, flood->trace[flood->done++], true, e)) {
                return false;
            }
        }
    }
    if (!flood->trace) {
        flood->out->count = flood->reached;
    }
    return true;
}

// The order is by filled height, so a strictly lower neighbour always comes earlier.
static void point_downhill(const HeightField *field, Drainage *out)
{
    for (int64_t k = 0; k < out->count; k++) {
        int32_t i = out->order[k];
        if (out->receiver[i] == i) {
            continue;
        }
        float steepest = 0.0f;
        for (int d = 0; d < 8; d++) {
            int64_t n = neighbour(field, i, d);
            float slope = n < 0 ? 0.0f : (out->filled[i] - out->filled[n]) / step_length(field, d);
            if (slope > steepest) {
                steepest = slope;
                out->receiver[i] = (int32_t)n;
            }
        }
    }
}

static void gather_areas(const HeightField *field, Drainage *out)
{
    double cell = (double)field->cell.x * (double)field->cell.y;
    for (int64_t k = 0; k < out->count; k++) {
        out->area[out->order[k]] = cell;
    }
    for (int64_t k = out->count - 1; k >= 0; k--) {
        int32_t i = out->order[k], to = out->receiver[i];
        if (to != i) {
            out->area[to] += out->area[i];
        }
    }
}

static Drainage *allocate(const HeightField *field, Error *e)
{
    int64_t count = height_field_count(field);
    Drainage *out = memory_alloc_zero(1, sizeof *out, e);
    if (!out) {
        return NULL;
    }
    out->samples = out->count = count;
    out->receiver = memory_alloc(count, sizeof *out->receiver, e);
    out->order = memory_alloc(count, sizeof *out->order, e);
    out->area = memory_alloc_zero(count, sizeof *out->area, e);
    out->filled = memory_alloc(count, sizeof *out->filled, e);
    if (!out->receiver || !out->order || !out->area || !out->filled) {
        drainage_free(out);
        return NULL;
    }
    return out;
}

// traced: without an order, but faster; then flood.fall must be 0. The caller sets field, outlet,
// fall and level.
static Drainage *flood_field(Flood flood, bool traced, Error *e)
{
    const HeightField *field = flood.field;
    flood.out = allocate(field, e);
    bool done = flood.out != NULL;
    if (done && traced) { // no order
        flood.trace = flood.out->order;
        flood.out->order = NULL;
    }
    if (done) {
        flood.seen = memory_alloc_zero(height_field_count(field), 1, e);
        done = flood.seen && begin_at_rim(&flood, e) && flood_all(&flood, e);
    }
    free(flood.seen);
    free(flood.trace);
    free(flood.queue.item);
    if (!done) {
        drainage_free(flood.out);
        return NULL;
    }
    return flood.out;
}

Drainage *drainage_new(const HeightField *field, Error *e)
{
    Drainage *out = flood_field((Flood){.field = field}, false, e);
    if (out) {
        point_downhill(field, out);
        gather_areas(field, out);
        out->pits = height_field_pits(field);
    }
    return out;
}

Drainage *drainage_flood(const HeightField *field, const uint8_t *outlet, Error *e)
{
    return flood_field((Flood){.field = field, .outlet = outlet}, true, e);
}

Drainage *drainage_spill(const HeightField *field, Error *e)
{
    return flood_field((Flood){.field = field, .level = true}, true, e);
}

void drainage_free(Drainage *drainage)
{
    if (drainage) {
        free(drainage->receiver);
        free(drainage->order);
        free(drainage->area);
        free(drainage->filled);
        free(drainage);
    }
}

bool height_field_fill(HeightField *field, float fall, Error *e)
{
    Drainage *flooded = flood_field((Flood){.field = field, .fall = fall}, false, e);
    if (!flooded) {
        return false;
    }
    memcpy(field->height, flooded->filled,
           sizeof *field->height * (size_t)height_field_count(field));
    drainage_free(flooded);
    return true;
}
