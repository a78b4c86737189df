// The waves' energy at a shore: the share of the waves' directions, by their energy, from which the
// open sea is seen. Each direction is swept from the sea inland, row by row; interpolation between
// cells spreads it a little behind headlands, as diffraction does.
#include "base/exact_math.h"
#include "base/memory.h"
#include "land/shore_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DIRECTIONS = 15, MIDDLE = DIRECTIONS / 2, INTO_LAND = 8, TO_SEA = 64, CHANNELS = 3 };
#define DEGREE 0.017453292519943295

bool shore_waves_init(ShoreWaves *w, const Landscape *land, Error *e)
{
    int cells = land->side - 1;
    w->stride = cells > SHORE_WAVE_CELLS ? cells / SHORE_WAVE_CELLS : 1;
    w->side = cells / w->stride + 1;
    int64_t count = (int64_t)w->side * w->side;
    return (w->open = memory_alloc(count, sizeof *w->open, e)) &&
           (w->land = memory_alloc(count, sizeof *w->land, e)) &&
           (w->shore = memory_alloc(count, sizeof *w->shore, e)) &&
           (w->energy = memory_alloc(count, sizeof *w->energy, e)) &&
           (w->flux[0] = memory_alloc(count, sizeof *w->flux[0], e)) &&
           (w->flux[1] = memory_alloc(count, sizeof *w->flux[1], e));
}

void shore_waves_clear(ShoreWaves *w)
{
    free(w->open);
    free(w->land);
    free(w->shore);
    free(w->energy);
    free(w->flux[0]);
    free(w->flux[1]);
}

// ---- the sea seen from its border: row `inland`, column `along`

static void to_grid(const ShoreParams *p, int last, int inland, int along, int *column, int *row)
{
    *column = p->sea_x > 0 ? last - inland : p->sea_x < 0 ? inland : along;
    *row = p->sea_z > 0 ? last - inland : p->sea_z < 0 ? inland : along;
}

// Share of sea of the landscape's samples in the cell about (column, row).
static float open_share(const Shore *shore, const Landscape *land, int column, int row)
{
    int reach = shore->waves.stride / 2, count = 0;
    double sum = 0.0;
    for (int r = row - reach; r <= row + reach; r++) {
        for (int c = column - reach; c <= column + reach; c++) {
            if (r >= 0 && c >= 0 && r < land->side && c < land->side) {
                double to = 0.5 - shore->front[(int64_t)r * land->side + c] / land->cell;
                sum += to < 0.0 ? 0.0 : to > 1.0 ? 1.0 : to;
                count++;
            }
        }
    }
    return (float)(sum / count);
}

static void find_open(Shore *shore, const Landscape *land)
{
    ShoreWaves *w = &shore->waves;
    for (int inland = 0; inland < w->side; inland++) {
        for (int along = 0; along < w->side; along++) {
            int column, row;
            to_grid(&shore->params, w->side - 1, inland, along, &column, &row);
            w->open[(int64_t)inland * w->side + along] =
                open_share(shore, land, column * w->stride, row * w->stride);
        }
    }
}

// Means over a square of (2 reach + 1)^2 cells along one axis; borders go on as they are.
static void blur(const float *from, float *to, int side, int reach, int64_t across, int64_t step)
{
    for (int line = 0; line < side; line++) {
        const float *f = from + line * across;
        double sum = 0.0;
        for (int k = -reach; k <= reach; k++) {
            sum += (double)f[(k < 0 ? 0 : k) * step];
        }
        for (int k = 0; k < side; k++) {
            to[line * across + k * step] = (float)(sum / (2 * reach + 1));
            int next = k + reach + 1, last = k - reach;
            sum += (double)f[(next < side ? next : side - 1) * step] -
                   (double)f[(last > 0 ? last : 0) * step];
        }
    }
}

static bool find_land(ShoreWaves *w, Error *e)
{
    int64_t count = (int64_t)w->side * w->side;
    float *half = memory_alloc(count, sizeof *half, e);
    if (!half) {
        return false;
    }
    int reach = w->side / 32 > 0 ? w->side / 32 : 1;
    for (int64_t i = 0; i < count; i++) {
        w->land[i] = 1.0f - w->open[i];
    }
    for (int times = 0; times < 2; times++) {
        blur(w->land, half, w->side, reach, w->side, 1);
        blur(half, w->land, w->side, reach, 1, w->side);
    }
    free(half);
    return true;
}

// ---- sweeps

// A value of a row between its samples.
static float between(const float *row, int side, float at)
{
    at = clampf(at, 0.0f, (float)(side - 1));
    int i = (int)at < side - 1 ? (int)at : side - 2;
    return lerpf(row[i], row[i + 1], at - (float)i);
}

// What of a direction comes to a cell from the row before, `aside` columns away: past the sea
// between.
static float comes(const ShoreWaves *w, const float *before, int inland, int along, float aside)
{
    int pieces = (int)ceilf(fabsf(aside));
    float passes = between(before, w->side, (float)along - aside);
    for (int k = 1; k < pieces; k++) {
        float t = (float)k / (float)pieces; // from the row before to this one
        int64_t first = (int64_t)(t < 0.5f ? inland - 1 : inland) * w->side;
        passes *= between(w->open + first, w->side, (float)along - (1.0f - t) * aside);
    }
    return passes;
}

typedef struct Sweep {
    float weight;  // share of the waves' energy
    float aside;   // columns per row inland
    float flux[2]; // the way of the waves along x and z: 1 in the mean
} Sweep;

static void sweep(ShoreWaves *w, const Sweep *s, float *rows)
{
    float *before = rows, *now = rows + w->side;
    for (int inland = 0; inland < w->side; inland++) {
        int64_t first = (int64_t)inland * w->side;
        for (int along = 0; along < w->side; along++) {
            float in = inland > 0 ? comes(w, before, inland, along, s->aside) : 1.0f;
            float part = s->weight * in;
            w->energy[first + along] += part;
            w->flux[0][first + along] += part * s->flux[0];
            w->flux[1][first + along] += part * s->flux[1];
            now[along] = in * w->open[first + along];
        }
        float *swap = before;
        before = now;
        now = swap;
    }
}

// Waves of all directions about the mean: their energy goes with the square of the cosine.
static int directions(const ShoreParams *p, Sweep *sweeps)
{
    double energy = 0.0, flux = 0.0; // of all on a shore across the waves
    double along_x = p->sea_z != 0 ? 1.0 : 0.0, along_z = 1.0 - along_x;
    int count = 0;
    for (int k = 0; k < DIRECTIONS; k++) {
        double off = (k - MIDDLE) * 10.0, sine, cosine, side, ahead;
        exact_sincos_double(off * DEGREE, &sine, &cosine);
        double weight = cosine * cosine;
        energy += weight;
        flux += weight * cosine;
        if (fabs(off + p->waves) > 78.0) { // along the shore
            continue;
        }
        exact_sincos_double((off + p->waves) * DEGREE, &side, &ahead);
        // They come from the sea's side, turned clockwise seen from above, and go the other way.
        double x = -(ahead * p->sea_x - side * p->sea_z);
        double z = -(ahead * p->sea_z + side * p->sea_x);
        sweeps[count++] = (Sweep){.weight = (float)weight,
                                  .aside = (float)((x * along_x + z * along_z) / ahead),
                                  .flux = {(float)x, (float)z}};
    }
    for (int k = 0; k < count; k++) {
        sweeps[k].weight /= (float)energy;
        sweeps[k].flux[0] *= (float)(energy / flux);
        sweeps[k].flux[1] *= (float)(energy / flux);
    }
    return count;
}

// ---- beyond where they are known

// queue: cells beside those that are known, which are known a round later; room for all cells.
typedef struct Filling {
    float *channel[CHANNELS];
    int channels, side;
    uint8_t *known, *queued; // or known
    int32_t *queue;
    int64_t count; // of cells in the queue
} Filling;

// A cell's neighbours; itself beyond the border.
static void cells_beside(const Filling *f, int64_t i, int64_t near[4])
{
    int column = (int)(i % f->side), row = (int)(i / f->side);
    near[0] = column > 0 ? i - 1 : i;
    near[1] = column < f->side - 1 ? i + 1 : i;
    near[2] = row > 0 ? i - f->side : i;
    near[3] = row < f->side - 1 ? i + f->side : i;
}

// Gives a cell the mean of its neighbours that are known.
static void fill_cell(const Filling *f, int64_t i)
{
    int64_t near[4];
    int count = 0;
    float sum[CHANNELS] = {0};
    cells_beside(f, i, near);
    for (int k = 0; k < 4; k++) {
        for (int c = 0; f->known[near[k]] && c < f->channels; c++) {
            sum[c] += f->channel[c][near[k]];
        }
        count += f->known[near[k]];
    }
    for (int c = 0; c < f->channels; c++) {
        f->channel[c][i] = sum[c] / (float)count;
    }
}

static void queue_beside(Filling *f, int64_t i)
{
    int64_t near[4];
    cells_beside(f, i, near);
    for (int k = 0; k < 4; k++) {
        if (!f->queued[near[k]]) {
            f->queued[near[k]] = 1;
            f->queue[f->count++] = (int32_t)near[k];
        }
    }
}

// So many cells around those that are known.
static void fill(Filling *f, int rounds)
{
    int64_t cells = (int64_t)f->side * f->side;
    memcpy(f->queued, f->known, (size_t)cells);
    f->count = 0;
    for (int64_t i = 0; i < cells; i++) {
        if (f->known[i]) {
            queue_beside(f, i);
        }
    }
    for (int64_t k = 0, begin = 0; k < rounds; k++) {
        int64_t end = f->count;
        for (int64_t i = begin; i < end; i++) {
            fill_cell(f, f->queue[i]);
        }
        for (int64_t i = begin; i < end; i++) {
            f->known[f->queue[i]] = 1;
            queue_beside(f, f->queue[i]);
        }
        begin = end;
    }
}

static double focus_of(float land)
{
    double focus = 1.0 + 1.6 * (0.5 - (double)land);
    return focus < 0.3 ? 0.3 : focus > 1.6 ? 1.6 : focus;
}

// From the shore to the sea, and evened out along the shore; rows: room for all cells.
static void find_shore(ShoreWaves *w, const Filling *room, float *half)
{
    Filling f = *room;
    int64_t count = (int64_t)w->side * w->side;
    f.channels = 1;
    f.channel[0] = w->shore;
    for (int64_t i = 0; i < count; i++) {
        f.known[i] = w->open[i] > 0.02f && w->open[i] < 0.98f;
        w->shore[i] = f.known[i] ? w->energy[i] * (float)focus_of(w->land[i]) : 0.0f;
    }
    fill(&f, TO_SEA);
    int reach = w->side / 64 > 0 ? w->side / 64 : 1;
    for (int64_t i = 0; i < count; i++) { // far out: the open sea
        w->shore[i] = f.known[i] ? w->shore[i] : 1.0f;
    }
    for (int times = 0; times < 2; times++) {
        blur(w->shore, half, w->side, reach, w->side, 1);
        blur(half, w->shore, w->side, reach, 1, w->side);
    }
}

static void sweep_all(ShoreWaves *w, const ShoreParams *params, float *rows)
{
    Sweep sweeps[DIRECTIONS];
    int64_t count = (int64_t)w->side * w->side;
    int used = directions(params, sweeps);
    memset(w->energy, 0, sizeof *w->energy * (size_t)count);
    memset(w->flux[0], 0, sizeof *w->energy * (size_t)count);
    memset(w->flux[1], 0, sizeof *w->energy * (size_t)count);
    for (int k = 0; k < used; k++) {
        sweep(w, &sweeps[k], rows);
    }
}

bool shore_find_waves(Shore *shore, const Landscape *land, Error *e)
{
    ShoreWaves *w = &shore->waves;
    int64_t count = (int64_t)w->side * w->side;
    float *room = memory_alloc(count, sizeof *room, e);
    Filling f = {.channel = {w->energy, w->flux[0], w->flux[1]},
                 .channels = 3,
                 .side = w->side,
                 .known = memory_alloc(count, 1, e),
                 .queued = memory_alloc(count, 1, e),
                 .queue = memory_alloc(count, sizeof(int32_t), e)};
    find_open(shore, land);
    bool done = room && f.known && f.queued && f.queue && find_land(w, e);
    if (done) {
        sweep_all(w, &shore->params, room);
        for (int64_t i = 0; i < count; i++) {
            f.known[i] = w->open[i] > 0.5f;
        }
        fill(&f, INTO_LAND);
        find_shore(w, &f, room);
    }
    free(room);
    free(f.known);
    free(f.queued);
    free(f.queue);
    return done;
}

WavesAt shore_waves_at(const Shore *shore, const Landscape *land, double column, double row)
{
    const ShoreWaves *w = &shore->waves;
    const ShoreParams *p = &shore->params;
    double last = (double)(land->side - 1), scale = 1.0 / w->stride;
    column = column < 0.0 ? 0.0 : column > last ? last : column;
    row = row < 0.0 ? 0.0 : row > last ? last : row;
    double inland = scale * (p->sea_x > 0   ? last - column
                             : p->sea_x < 0 ? column
                             : p->sea_z > 0 ? last - row
                                            : row);
    double along = scale * (p->sea_x != 0 ? row : column);
    int i = (int)inland < w->side - 1 ? (int)inland : w->side - 2;
    int k = (int)along < w->side - 1 ? (int)along : w->side - 2;
    float u = (float)(inland - i), v = (float)(along - k);
    int64_t at = (int64_t)i * w->side + k;
    const float *channel[] = {w->energy, w->flux[0], w->flux[1], w->land, w->shore};
    float value[5];
    for (int c = 0; c < 5; c++) {
        const float *f = channel[c] + at;
        value[c] = lerpf(lerpf(f[0], f[1], v), lerpf(f[w->side], f[w->side + 1], v), u);
    }
    return (WavesAt){.energy = (double)value[0],
                     .flux = {(double)value[1], (double)value[2]},
                     .shore = (double)value[4],
                     .focus = focus_of(value[3])};
}
