#include "land/braid_level.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FILM 0.05f // mean depths: less is no water to be seen

void braid_level_free(BraidLevel *level)
{
    if (level) {
        free(level->level);
        free(level->ring);
        free(level);
    }
}

// Index of the cell at (column, row), rows in a circle; -1 beyond the sides.
static int64_t cell_at(int side, int column, int row)
{
    return column < 0 || column >= side ? -1 : (int64_t)((row + side) % side) * side + column;
}

// Marks the water that hangs together with cell `first` by 1. *stack holds it, from 0 to the
// returned count.
static int64_t collect(const BraidLevel *level, uint8_t *seen, int64_t *stack, int64_t first)
{
    int64_t count = 0;
    seen[first] = 1;
    stack[count++] = first;
    for (int64_t n = 0; n < count; n++) {
        int column = (int)(stack[n] % level->side), row = (int)(stack[n] / level->side);
        for (int k = 0; k < 9; k++) {
            int64_t next = cell_at(level->side, column + k % 3 - 1, row + k / 3 - 1);
            if (next >= 0 && level->ring[next] == 0 && !seen[next]) {
                seen[next] = 1;
                stack[count++] = next;
            }
        }
    }
    return count;
}

static bool drop_puddles(BraidLevel *level, int64_t least, Error *e)
{
    int64_t cells = (int64_t)level->side * level->side;
    uint8_t *seen = memory_alloc_zero(cells, 1, e);
    int64_t *stack = seen ? memory_alloc(cells, sizeof *stack, e) : NULL;
    for (int64_t i = 0; stack && i < cells; i++) {
        if (level->ring[i] != 0 || seen[i]) {
            continue;
        }
        int64_t count = collect(level, seen, stack, i);
        for (int64_t n = 0; count < least && n < count; n++) {
            level->ring[stack[n]] = BRAID_NO_WATER;
        }
    }
    bool done = stack;
    free(seen);
    free(stack);
    return done;
}

// Cells next to the last ring get the mean level of what it has around them.
static void add_ring(BraidLevel *level, int ring)
{
    int side = level->side;
    for (int row = 0; row < side; row++) {
        for (int column = 0; column < side; column++) {
            int64_t i = (int64_t)row * side + column;
            if (level->ring[i] != BRAID_NO_WATER) {
                continue;
            }
            double sum = 0.0;
            int count = 0;
            for (int k = 0; k < 9; k++) {
                int64_t near = cell_at(side, column + k % 3 - 1, row + k / 3 - 1);
                if (near >= 0 && level->ring[near] < ring) {
                    sum += level->level[near];
                    count++;
                }
            }
            if (count > 0) {
                level->level[i] = sum / count;
                level->ring[i] = (uint8_t)ring;
            }
        }
    }
}

BraidLevel *braid_level_new(const Braid *b, int64_t least, Error *e)
{
    BraidLevel *level = memory_alloc_zero(1, sizeof *level, e);
    int64_t count = braid_count(b);
    bool done = level && (level->level = memory_alloc_zero(count, sizeof *level->level, e)) &&
                (level->ring = memory_alloc(count, sizeof *level->ring, e));
    if (done) {
        level->side = b->side;
        for (int64_t i = 0; i < count; i++) {
            level->ring[i] = b->depth[i] > FILM * (float)b->mean ? 0 : BRAID_NO_WATER;
            level->level[i] = b->bed[i] + (double)b->depth[i];
        }
        done = drop_puddles(level, least, e);
    }
    if (!done) {
        braid_level_free(level);
        return NULL;
    }
    for (int ring = 1; ring <= BRAID_RINGS; ring++) {
        add_ring(level, ring);
    }
    return level;
}

BraidWater braid_water_at(const BraidLevel *level, double u, double v)
{
    int column = (int)floor(u - 0.5), row = (int)floor(v - 0.5);
    double s = u - 0.5 - column, t = v - 0.5 - row, sum = 0.0, weight = 0.0, rings = 0.0;
    for (int k = 0; k < 4; k++) {
        int64_t i = cell_at(level->side, column + k % 2, row + k / 2);
        double w = (k % 2 ? s : 1.0 - s) * (k / 2 ? t : 1.0 - t);
        if (i >= 0 && level->ring[i] < BRAID_NO_WATER && w > 0.0) {
            sum += w * level->level[i];
            rings += w * level->ring[i];
            weight += w;
        }
    }
    if (!(weight > 0.0)) {
        return (BraidWater){.known = false, .away = 1.0};
    }
    double away = rings / weight / BRAID_RINGS;
    return (BraidWater){.known = true, .level = sum / weight, .away = away < 1.0 ? away : 1.0};
}
