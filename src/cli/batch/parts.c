// The parts of a batch: their numbers, places and files.
#include "cli/batch/batch.h"

#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Of the renderer's tiles, in pixels, in which --noise is judged; and of the samples that it traces
// together.
enum { TILE = 16 };

const char *batch_noun(const Batch *batch)
{
    return batch->ranges > 1 ? "part" : (batch->columns > 0 ? "tile" : "frame");
}

static char *part_name(const Batch *batch, int part, const char *ending, RamifyError *e)
{
    char *name = allocate(BATCH_PATH + 64, 1, e);
    if (name) {
        snprintf(name, BATCH_PATH + 64, "%s/parts/%06d%s", batch->folder, part, ending);
    }
    return name;
}

char *batch_part_file(const Batch *batch, int part, RamifyError *e)
{
    return part_name(batch, part, batch->ending, e);
}

char *batch_begun_file(const Batch *batch, int part, RamifyError *e)
{
    return part_name(batch, part, ".begun.exr", e);
}

char *batch_frame_pattern(const Batch *batch, RamifyError *e)
{
    char *pattern = allocate(2 * BATCH_PATH + 64, 1, e), *at = pattern;
    for (const char *c = batch->folder; pattern && *c; c++) {
        *at++ = *c;
        if (*c == '%') {
            *at++ = '%';
        }
    }
    if (pattern) {
        snprintf(at, 64, "/parts/%%06d%.8s", batch->ending);
    }
    return pattern;
}

bool batch_part_done(const Batch *batch, int part)
{
    RamifyError ignored;
    char *file = batch_part_file(batch, part, &ignored);
    bool done = file && access(file, F_OK) == 0;
    free(file);
    return done;
}

// Pixel (or sample) at which column (row, range) number i of `count` begins.
static int tile_edge(int i, int count, int all)
{
    int tiles = (all + TILE - 1) / TILE, edge = (int)((int64_t)tiles * i / count) * TILE;
    return edge < all ? edge : all;
}

void batch_tile_crop(const Batch *batch, int part, float crop[4])
{
    int width, height, tile = part / batch->ranges;
    int column = tile % batch->columns, row = tile / batch->columns;
    ramify_scene_size(batch->scene, &width, &height);
    for (int end = 0; end < 2; end++) {
        crop[2 * end] = (float)tile_edge(column + end, batch->columns, width) / (float)width;
        crop[2 * end + 1] = (float)tile_edge(row + end, batch->rows, height) / (float)height;
    }
}

void batch_samples(const Batch *batch, int part, int *first, int *end)
{
    int ignored_first, ignored_end, all, range = part % batch->ranges;
    ramify_scene_sample_range(batch->scene, &ignored_first, &ignored_end, &all);
    *first = tile_edge(range, batch->ranges, all);
    *end = tile_edge(range + 1, batch->ranges, all);
}

void batch_list(const bool *wanted, int first, int last, const char *separator, char *text,
                size_t size)
{
    size_t used = 0;
    text[0] = 0;
    for (int i = first; i <= last; i++) {
        if (!wanted[i - first]) {
            continue;
        }
        if (used + 40 > size) {
            snprintf(text + used, size - used, "...");
            return;
        }
        int begin = i;
        while (i < last && wanted[i + 1 - first]) {
            i++;
        }
        used += (size_t)snprintf(text + used, size - used, "%s%d", used ? separator : "", begin);
        if (i > begin) {
            used += (size_t)snprintf(text + used, size - used, "-%d", i);
        }
    }
}

bool *batch_missing(const Batch *batch, int *count, RamifyError *e)
{
    bool *missing = allocate(batch->last - batch->first + 1, sizeof *missing, e);
    int sum = 0;
    for (int part = batch->first; missing && part <= batch->last; part++) {
        sum += missing[part - batch->first] = !batch_part_done(batch, part);
    }
    if (count) {
        *count = sum;
    }
    return missing;
}

static bool read_number(const char **text, int low, int high, int *value)
{
    char *end = NULL;
    long number = **text >= '0' && **text <= '9' ? strtol(*text, &end, 10) : -1;
    bool valid = end && number >= low && number <= high;
    if (valid) {
        *value = (int)number;
        *text = end;
    }
    return valid;
}

bool batch_read_range(const char *text, int low, int high, int *first, int *last)
{
    bool valid = read_number(&text, low, high, first);
    *last = *first;
    if (valid && *text == '-') {
        text++;
        valid = read_number(&text, *first, high, last);
    }
    return valid && *text == 0;
}
