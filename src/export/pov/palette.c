#include "export/pov/palette.h"

#include "base/memory.h"

#include <stdlib.h>

// Histogram cells have equal steps of the square root of the colour, about as the eye perceives
// them.
enum { STEPS = 64, CELLS = STEPS * STEPS * STEPS };

typedef struct Cell {
    double count, color[3], second[3];
} Cell;

// A box of cells: [low, high) in each channel.
typedef struct Box {
    int low[3], high[3];
    double count;
} Box;

static int step_of(float value)
{
    return (int)(sqrtf(clampf(value, 0.0f, 1.0f)) * (STEPS - 0.01f));
}

static int cell_of(Vec3 color)
{
    return (step_of(color.x) * STEPS + step_of(color.y)) * STEPS + step_of(color.z);
}

static const Cell *cell_at(const Cell *cell, const int place[3])
{
    return cell + (place[0] * STEPS + place[1]) * STEPS + place[2];
}

// Shrinks a box to its filled cells and counts them.
static void box_fit(Box *box, const Cell *cell)
{
    Box fit = {{STEPS, STEPS, STEPS}, {0, 0, 0}, 0.0};
    int p[3];
    for (p[0] = box->low[0]; p[0] < box->high[0]; p[0]++) {
        for (p[1] = box->low[1]; p[1] < box->high[1]; p[1]++) {
            for (p[2] = box->low[2]; p[2] < box->high[2]; p[2]++) {
                double count = cell_at(cell, p)->count;
                for (int k = 0; k < 3 && count > 0.0; k++) {
                    fit.low[k] = p[k] < fit.low[k] ? p[k] : fit.low[k];
                    fit.high[k] = p[k] + 1 > fit.high[k] ? p[k] + 1 : fit.high[k];
                }
                fit.count += count;
            }
        }
    }
    *box = fit;
}

static int longest_side(const Box *box)
{
    int side = 0;
    for (int k = 1; k < 3; k++) {
        side = box->high[k] - box->low[k] > box->high[side] - box->low[side] ? k : side;
    }
    return side;
}

static int length_of(const Box *box)
{
    int side = longest_side(box);
    return box->high[side] - box->low[side];
}

static double slice_count(const Box *box, const Cell *cell, int side, int at)
{
    Box slice = *box;
    slice.low[side] = at;
    slice.high[side] = at + 1;
    box_fit(&slice, cell);
    return slice.count;
}

// Splits a box at the median of its longest side.
static Box box_split(Box *box, const Cell *cell)
{
    int side = longest_side(box), at = box->low[side];
    double count = 0.0;
    do {
        count += slice_count(box, cell, side, at++);
    } while (count < 0.5 * box->count && at < box->high[side] - 1);
    Box other = *box;
    box->high[side] = other.low[side] = at;
    box_fit(box, cell);
    box_fit(&other, cell);
    return other;
}

// Chooses the box to split: many places and a large spread of colours.
static int box_choose(const Box *box, int count)
{
    int best = -1;
    double most = 0.0;
    for (int i = 0; i < count; i++) {
        double length = length_of(&box[i]) - 1, weight = box[i].count * length * length;
        if (weight > most) {
            most = weight;
            best = i;
        }
    }
    return best;
}

static void add_to(double sum[3], Vec3 v)
{
    sum[0] += (double)v.x;
    sum[1] += (double)v.y;
    sum[2] += (double)v.z;
}

static void fill_cells(const Vec3 *color, const Vec3 *second, int64_t count, Cell *cell)
{
    for (int64_t i = 0; i < count; i++) {
        Cell *c = &cell[cell_of(color[i])];
        c->count += 1.0;
        add_to(c->color, color[i]);
        if (second) {
            add_to(c->second, second[i]);
        }
    }
}

// Computes the box's mean colours and stores its number in its cells.
static void take_box(const Box *box, const Cell *cell, int number, Palette *palette, uint8_t *entry)
{
    double color[3] = {0}, second[3] = {0};
    int p[3];
    for (p[0] = box->low[0]; p[0] < box->high[0]; p[0]++) {
        for (p[1] = box->low[1]; p[1] < box->high[1]; p[1]++) {
            for (p[2] = box->low[2]; p[2] < box->high[2]; p[2]++) {
                const Cell *c = cell_at(cell, p);
                entry[c - cell] = (uint8_t)number;
                for (int k = 0; k < 3; k++) {
                    color[k] += c->color[k];
                    second[k] += c->second[k];
                }
            }
        }
    }
    double scale = box->count > 0.0 ? 1.0 / box->count : 0.0;
    palette->color[number] =
        vec3((float)(color[0] * scale), (float)(color[1] * scale), (float)(color[2] * scale));
    palette->second[number] =
        vec3((float)(second[0] * scale), (float)(second[1] * scale), (float)(second[2] * scale));
}

bool palette_make(const Vec3 *color, const Vec3 *second, int64_t count, int most, Palette *palette,
                  uint8_t *index, Error *e)
{
    Cell *cell = memory_alloc_zero(CELLS, sizeof *cell, e);
    uint8_t *entry = memory_alloc_zero(CELLS, sizeof *entry, e);
    Box *box = memory_alloc(PALETTE_MOST, sizeof *box, e);
    bool done = cell && entry && box;
    if (done) {
        fill_cells(color, second, count, cell);
        int boxes = 1, next;
        box[0] = (Box){{0, 0, 0}, {STEPS, STEPS, STEPS}, 0.0};
        box_fit(&box[0], cell);
        while (boxes < most && (next = box_choose(box, boxes)) >= 0) {
            box[boxes] = box_split(&box[next], cell);
            boxes++;
        }
        palette->count = boxes;
        for (int i = 0; i < boxes; i++) {
            take_box(&box[i], cell, i, palette, entry);
        }
        for (int64_t i = 0; i < count; i++) {
            index[i] = entry[cell_of(color[i])];
        }
    }
    free(cell);
    free(entry);
    free(box);
    return done;
}
