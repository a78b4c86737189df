#include "objects/terrain/meander_trace.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

static const double STAMP = 0.16; // time between two records of the channel
static const double REACH = 3.0;  // half widths from the river's middle within which it is known
static const double SCAR = 1.4;   // likewise of bends that were cut off
static const double FILL = 26.0;  // mean time in which a cut bend fills
enum { PIECES = 3 }; // straight ones between two nodes: with one, banks would show corners

bool meander_trace_new(MeanderTrace *trace, const HeightField *field, Error *e)
{
    *trace = (MeanderTrace){.field = field};
    int64_t count = height_field_count(field);
    const struct {
        float **array;
        float value;
    } arrays[] = {{&trace->left, -1.0f},   {&trace->aside, INFINITY}, {&trace->bend, 0.0f},
                  {&trace->old, INFINITY}, {&trace->open, 0.0f},      {&trace->filled, 0.0f}};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) {
        float *array = *arrays[k].array = memory_alloc(count, sizeof *array, e);
        if (!array) {
            return false;
        }
        for (int64_t i = 0; i < count; i++) {
            array[i] = arrays[k].value;
        }
    }
    return true;
}

void meander_trace_free(MeanderTrace *trace)
{
    free(trace->left);
    free(trace->aside);
    free(trace->bend);
    free(trace->old);
    free(trace->open);
    free(trace->filled);
}

// ---- pieces of a line

// A sample near a piece.
typedef struct Near {
    int64_t sample;
    double aside; // m from the piece, positive on its left
    double along; // 0..1
} Near;

typedef void Touch(void *data, const Near *near);

static Near look(MeanderNode a, MeanderNode b, double x, double z)
{
    double dx = b.x - a.x, dz = b.z - a.z, squared = dx * dx + dz * dz;
    double t = squared > 0.0 ? ((x - a.x) * dx + (z - a.z) * dz) / squared : 0.0;
    t = fmin(fmax(t, 0.0), 1.0);
    double u = x - a.x - t * dx, v = z - a.z - t * dz, away = sqrt(u * u + v * v);
    return (Near){.aside = u * dz - v * dx < 0.0 ? -away : away, .along = t};
}

// A piece of a line and who wants to know of samples near it.
typedef struct Piece {
    MeanderNode a, b;
    double first, share; // of `along`: at a, and what the piece adds to b
    double reach;        // m
    Touch *touch;
    void *data;
} Piece;

// All samples within its reach, as far as the trace moves them.
static void touch_piece(const MeanderTrace *trace, const Piece *piece)
{
    const HeightField *f = trace->field;
    MeanderNode a = piece->a, b = piece->b;
    double reach = piece->reach + (trace->moved ? (double)trace->most : 0.0);
    double cell = (double)f->cell.x, corner = (double)f->origin.x, last = f->columns - 1;
    int first_column = (int)fmax(ceil((fmin(a.x, b.x) - reach - corner) / cell), 0.0);
    int last_column = (int)fmin(floor((fmax(a.x, b.x) + reach - corner) / cell), last);
    int first_row = (int)fmax(ceil((fmin(a.z, b.z) - reach - corner) / cell), 0.0);
    int last_row = (int)fmin(floor((fmax(a.z, b.z) + reach - corner) / cell), last);
    for (int row = first_row; row <= last_row; row++) {
        for (int column = first_column; column <= last_column; column++) {
            int64_t i = (int64_t)row * f->columns + column;
            Vec2 moved = trace->moved ? trace->moved[i] : (Vec2){0, 0};
            Near near = look(a, b, corner + column * cell + (double)moved.x,
                             corner + row * cell + (double)moved.y);
            if (fabs(near.aside) <= piece->reach) {
                near.sample = i;
                near.along = piece->first + near.along * piece->share;
                piece->touch(piece->data, &near);
            }
        }
    }
}

MeanderNode meander_between(const MeanderNode node[4], double t)
{
    double t2 = t * t, t3 = t2 * t;
    double w[4] = {0.5 * (2.0 * t2 - t3 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
                   0.5 * (4.0 * t2 - 3.0 * t3 + t), 0.5 * (t3 - t2)};
    return (MeanderNode){w[0] * node[0].x + w[1] * node[1].x + w[2] * node[2].x + w[3] * node[3].x,
                         w[0] * node[0].z + w[1] * node[1].z + w[2] * node[2].z + w[3] * node[3].z};
}

// What lies between the second and the third of four nodes. It may lie anywhere along the line
// without end; the square is one `length` of it.
static void touch_all(const MeanderTrace *trace, const MeanderNode node[4], double length,
                      double reach, Touch *touch, void *data)
{
    double turns = floor(node[1].z / length + 0.5);
    for (int k = -1; k <= 1; k++) {
        double move = (k - turns) * length;
        for (int n = 0; n < PIECES; n++) {
            Piece piece = {.a = meander_between(node, (double)n / PIECES),
                           .b = meander_between(node, (double)(n + 1) / PIECES),
                           .first = (double)n / PIECES,
                           .share = 1.0 / PIECES,
                           .reach = reach,
                           .touch = touch,
                           .data = data};
            piece.a.z += move;
            piece.b.z += move;
            touch_piece(trace, &piece);
        }
    }
}

// Nodes i - 1 .. i + 2 of the river.
static void nodes_around(const Meander *m, int64_t i, MeanderNode node[4])
{
    for (int k = 0; k < 4; k++) {
        int64_t at = i + k - 1, turn = at < 0 ? -1 : at >= m->count ? 1 : 0;
        node[k] = m->node[at - turn * m->count];
        node[k].z += (double)turn * m->length;
    }
}

// Likewise of a bend that was cut off, which ends.
static void oxbow_around(const Oxbow *oxbow, int64_t i, MeanderNode node[4])
{
    for (int k = 0; k < 4; k++) {
        int64_t at = i + k - 1;
        node[k] = oxbow->node[at < 0 ? 0 : at < oxbow->count ? at : oxbow->count - 1];
    }
}

// ---- when the channel left

typedef struct Stamping {
    MeanderTrace *trace;
    float *near;    // m to the river when it was last recorded
    float *inside;  // likewise, when it was last in the channel
    int32_t *when;  // number of that record
    int32_t *found; // samples of this record
    int32_t count, number;
} Stamping;

static void touch_channel(void *data, const Near *near)
{
    Stamping *s = data;
    int64_t i = near->sample;
    float away = (float)fabs(near->aside);
    if (s->when[i] != s->number) {
        s->when[i] = s->number;
        s->near[i] = away;
        s->found[s->count++] = (int32_t)i;
    } else if (away < s->near[i]) {
        s->near[i] = away;
    }
}

// Records where the channel is at this time. Between two records its edge moves evenly.
static void stamp(Stamping *s, const Meander *m, double before)
{
    float half = (float)(0.5 * m->width);
    s->number++;
    s->count = 0;
    for (int64_t i = 0; i < m->count; i++) {
        MeanderNode node[4];
        nodes_around(m, i, node);
        touch_all(s->trace, node, m->length, 0.9 * m->width, touch_channel, s);
    }
    for (int32_t k = 0; k < s->count; k++) {
        int32_t i = s->found[k];
        float *left = &s->trace->left[i];
        if (s->near[i] <= half) {
            *left = (float)m->time;
            s->inside[i] = s->near[i];
        } else if (*left == (float)before) {
            float share = (half - s->inside[i]) / (s->near[i] - s->inside[i]);
            *left += share * (float)(m->time - before);
        }
    }
}

bool meander_trace_run(MeanderTrace *trace, Meander *m, double time, const Run *run, Error *e)
{
    int64_t count = height_field_count(trace->field), parts = (int64_t)(time / STAMP) + 1;
    Stamping s = {.trace = trace,
                  .near = memory_alloc(count, sizeof *s.near, e),
                  .inside = memory_alloc(count, sizeof *s.inside, e),
                  .when = memory_alloc_zero(count, sizeof *s.when, e),
                  .found = memory_alloc(count, sizeof *s.found, e)};
    bool done = s.near && s.inside && s.when && s.found;
    for (int64_t n = 0; done && n < parts; n++) {
        run_progress(run, "river", (double)n / (double)parts);
        double before = m->time;
        done = meander_run(m, STAMP, run, e);
        if (done) {
            stamp(&s, m, before);
        }
    }
    free(s.near);
    free(s.inside);
    free(s.when);
    free(s.found);
    return done;
}

// ---- the river now

typedef struct Tracing {
    MeanderTrace *trace;
    double half;      // m, of the channel
    double bend[2];   // at the ends of the piece
    double begin;     // m along an oxbow's line
    double piece;     // m, of the piece
    double whole;     // m, of the line
    double filled;    // of the oxbow
    float cut;        // time when that was cut
    uint8_t *claimed; // by an oxbow that was cut later, within its channel
} Tracing;

static void touch_river(void *data, const Near *near)
{
    const Tracing *t = data;
    float aside = (float)(near->aside / t->half), *known = &t->trace->aside[near->sample];
    if (fabsf(aside) < fabsf(*known)) {
        *known = aside;
        t->trace->bend[near->sample] =
            (float)(t->bend[0] + near->along * (t->bend[1] - t->bend[0]));
    }
}

bool meander_trace_river(MeanderTrace *trace, const Meander *m, Error *e)
{
    Tracing t = {.trace = trace, .half = 0.5 * m->width};
    double *bend = memory_alloc(m->count, sizeof *bend, e);
    if (!bend) {
        return false;
    }
    meander_bends(m, bend);
    for (int64_t i = 0; i < m->count; i++) {
        t.bend[0] = bend[i];
        t.bend[1] = bend[(i + 1) % m->count];
        MeanderNode node[4];
        nodes_around(m, i, node);
        touch_all(trace, node, m->length, REACH * t.half, touch_river, &t);
    }
    free(bend);
    return true;
}

// ---- oxbows

// How far it has been filled; 1 = to its last water.
static double filled_at(const Meander *m, int64_t i)
{
    double slow = (double)random_range(random_key(m->seed, 7000 + (uint64_t)i), 0.6f, 1.6f);
    return (m->time - m->oxbow[i].time) / (FILL * slow);
}

// Half width of the water, in those of the channel. The river plugs the ends with sand first, then
// mud narrows the rest.
static double open_at(const Tracing *t, double along)
{
    double width = 2.0 * t->half, end = fmin(along, t->whole - along) / width;
    double plug = fmin(0.5 + 3.0 * t->filled, 0.3 * t->whole / width);
    double taper = fmin(fmax((end - plug) / 1.6, 0.0), 1.0);
    return t->filled < 1.0 ? (1.0 - 0.68 * t->filled) * sqrt(taper) : 0.0;
}

static void touch_oxbow(void *data, const Near *near)
{
    const Tracing *t = data;
    MeanderTrace *trace = t->trace;
    int64_t i = near->sample;
    float away = (float)(fabs(near->aside) / t->half);
    // The river has been there since, or another oxbow has.
    if (trace->left[i] > t->cut + (float)STAMP || t->claimed[i] || away >= trace->old[i]) {
        return;
    }
    trace->old[i] = away;
    trace->open[i] = (float)open_at(t, t->begin + near->along * t->piece);
    trace->filled[i] = (float)t->filled;
}

static double piece_length(MeanderNode a, MeanderNode b)
{
    double x = b.x - a.x, z = b.z - a.z;
    return sqrt(x * x + z * z);
}

bool meander_trace_oxbows(MeanderTrace *trace, const Meander *m, Error *e)
{
    Tracing t = {.trace = trace, .half = 0.5 * m->width};
    int64_t count = height_field_count(trace->field);
    t.claimed = memory_alloc_zero(count, 1, e);
    for (int64_t k = m->oxbows - 1; t.claimed && k >= 0; k--) {
        const Oxbow *oxbow = &m->oxbow[k];
        t.filled = filled_at(m, k);
        t.cut = (float)oxbow->time;
        t.begin = t.whole = 0.0;
        for (int64_t i = 0; i + 1 < oxbow->count; i++) {
            t.whole += piece_length(oxbow->node[i], oxbow->node[i + 1]);
        }
        for (int64_t i = 0; i + 1 < oxbow->count && t.filled < 2.0; i++) {
            t.piece = piece_length(oxbow->node[i], oxbow->node[i + 1]);
            MeanderNode node[4];
            oxbow_around(oxbow, i, node);
            touch_all(trace, node, m->length, SCAR * t.half, touch_oxbow, &t);
            t.begin += t.piece;
        }
        for (int64_t i = 0; i < count && t.filled < 2.0; i++) {
            t.claimed[i] = trace->old[i] < 1.0f;
        }
    }
    bool done = t.claimed;
    free(t.claimed);
    return done;
}

int64_t meander_open_oxbows(const Meander *m)
{
    int64_t open = 0;
    for (int64_t i = 0; i < m->oxbows; i++) {
        open += filled_at(m, i) < 1.0;
    }
    return open;
}
