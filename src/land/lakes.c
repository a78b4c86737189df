#include "land/lakes.h"

#include "base/memory.h"
#include "land/height_drainage.h"

#include <stdlib.h>

typedef struct LakeSearch {
    const HeightField *field;
    const Drainage *flooded;
    Lakes *out;
    int32_t *stack; // of the samples of a lake; all that were found stay on it
    int64_t count;
    int64_t capacity; // of out->lake
} LakeSearch;

static bool is_under_water(const LakeSearch *s, int64_t i)
{
    return s->flooded->filled[i] > s->field->height[i];
}

// Puts the samples of the lake on the stack.
static void gather(LakeSearch *s, int64_t from, int32_t number)
{
    int64_t columns = s->field->columns, rows = s->field->rows;
    s->stack[0] = (int32_t)from;
    s->out->label[from] = number;
    s->count = 1;
    for (int64_t k = 0; k < s->count; k++) {
        int64_t column = s->stack[k] % columns, row = s->stack[k] / columns;
        for (int d = 0; d < 9; d++) {
            int64_t c = column + d % 3 - 1, r = row + d / 3 - 1, n = r * columns + c;
            if (c >= 0 && r >= 0 && c < columns && r < rows && s->out->label[n] < 0 &&
                is_under_water(s, n)) {
                s->out->label[n] = number;
                s->stack[s->count++] = (int32_t)n;
            }
        }
    }
}

static void extend(int range[2], int value)
{
    range[0] = value < range[0] ? value : range[0];
    range[1] = value > range[1] ? value : range[1];
}

// The lake on the stack.
static Lake measure(const LakeSearch *s)
{
    double cell = (double)s->field->cell.x * (double)s->field->cell.y;
    Lake lake = {.level = s->flooded->filled[s->stack[0]],
                 .samples = s->count,
                 .columns = {INT32_MAX, 0},
                 .rows = {INT32_MAX, 0},
                 .outlet = -1};
    for (int64_t k = 0; k < s->count; k++) {
        int32_t i = s->stack[k], to = s->flooded->receiver[i];
        extend(lake.columns, i % s->field->columns);
        extend(lake.rows, i / s->field->columns);
        float depth = lake.level - s->field->height[i];
        lake.depth = depth > lake.depth ? depth : lake.depth;
        lake.volume += (double)depth * cell;
        if (!is_under_water(s, to) && (lake.outlet < 0 || to < lake.outlet)) {
            lake.outlet = to;
        }
    }
    return lake;
}

static bool find_all(LakeSearch *s, const LakeLimits *limits, Error *e)
{
    int64_t count = height_field_count(s->field);
    double cell = (double)s->field->cell.x * (double)s->field->cell.y;
    for (int64_t i = 0; i < count; i++) {
        s->out->label[i] = -1;
    }
    for (int64_t i = 0; i < count; i++) {
        if (s->out->label[i] >= 0 || !is_under_water(s, i)) {
            continue;
        }
        // A number that no kept lake has: what is too small is never looked at again.
        gather(s, i, INT32_MAX);
        Lake lake = measure(s);
        if ((double)lake.samples * cell < limits->area || (double)lake.depth < limits->depth) {
            continue;
        }
        if (!memory_reserve(&s->out->lake, &s->capacity, s->out->count + 1, sizeof(Lake), e)) {
            return false;
        }
        for (int64_t k = 0; k < s->count; k++) {
            s->out->label[s->stack[k]] = s->out->count;
        }
        s->out->lake[s->out->count++] = lake;
    }
    return true;
}

typedef struct Rank {
    int64_t samples;
    int32_t number;
} Rank;

static int by_size(const void *a, const void *b)
{
    const Rank *x = a, *y = b;
    return x->samples != y->samples ? (x->samples > y->samples ? -1 : 1)
                                    : (x->number > y->number) - (x->number < y->number);
}

// Orders the lakes by size, keeps `most` of them and numbers the samples anew.
static bool rank(Lakes *lakes, int64_t samples, int most, Error *e)
{
    Rank *order = memory_alloc(lakes->count + 1, sizeof *order, e);
    Lake *lake = memory_alloc(lakes->count + 1, sizeof *lake, e);
    int32_t *place = memory_alloc(lakes->count + 1, sizeof *place, e);
    bool done = order && lake && place;
    if (done) {
        for (int i = 0; i < lakes->count; i++) {
            order[i] = (Rank){lakes->lake[i].samples, i};
        }
        qsort(order, (size_t)lakes->count, sizeof *order, by_size);
        int kept = most > 0 && most < lakes->count ? most : lakes->count;
        for (int i = 0; i < lakes->count; i++) {
            lake[i] = lakes->lake[order[i].number];
            place[order[i].number] = i < kept ? i : -1;
        }
        for (int64_t i = 0; i < samples; i++) {
            int32_t label = lakes->label[i];
            lakes->label[i] = label >= 0 && label < lakes->count ? place[label] : -1;
        }
        free(lakes->lake);
        lakes->lake = lake;
        lakes->count = kept;
        lake = NULL;
    }
    free(order);
    free(lake);
    free(place);
    return done;
}

Lakes *lakes_find(const HeightField *field, const LakeLimits *limits, Error *e)
{
    int64_t count = height_field_count(field);
    Drainage *flooded = drainage_spill(field, e);
    Lakes *out = flooded ? memory_alloc_zero(1, sizeof *out, e) : NULL;
    LakeSearch s = {.field = field, .flooded = flooded, .out = out};
    bool done = out && (out->label = memory_alloc(count, sizeof *out->label, e)) &&
                (s.stack = memory_alloc(count, sizeof *s.stack, e)) && find_all(&s, limits, e) &&
                rank(out, count, limits->count, e);
    free(s.stack);
    drainage_free(flooded);
    if (!done) {
        lakes_free(out);
        return NULL;
    }
    return out;
}

void lakes_free(Lakes *lakes)
{
    if (lakes) {
        free(lakes->lake);
        free(lakes->label);
        free(lakes);
    }
}
