#include "cli/command.h"
#include "cli/land.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct TileRange {
    int first[2], last[2]; // columns, rows
} TileRange;

static bool read_axis(const char *text, int *first, int *last, const char **rest)
{
    char *end;
    long from = strtol(text, &end, 10), to = from;
    bool read = end != text && text[0] >= '0' && text[0] <= '9';
    if (read && *end == '-') {
        const char *second = end + 1;
        to = strtol(second, &end, 10);
        read = end != second && second[0] >= '0' && second[0] <= '9';
    }
    *rest = end;
    *first = (int)from;
    *last = (int)to;
    return read && from <= to && to < INT_MAX;
}

static bool read_range(const char *text, TileRange *range, RamifyError *e)
{
    const char *rest;
    bool read = read_axis(text, &range->first[0], &range->last[0], &rest) && *rest == ',' &&
                read_axis(rest + 1, &range->first[1], &range->last[1], &rest) && *rest == 0;
    return read ||
           fail(e, RAMIFY_BAD_INPUT,
                "--tile %s; it must be column,row, such as 3,5, or ranges, such as 0-3,5", text);
}

static int tile_count(const RamifyScene *scene, int index)
{
    RamifyObjectInfo object;
    ramify_scene_object(scene, index, &object);
    return object.tiles;
}

// The only object that is cut into tiles; -1 if there is none or several.
static int find_tiled(const RamifyScene *scene)
{
    int found = -1, many = 0;
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        if (tile_count(scene, i) > 0) {
            found = i;
            many++;
        }
    }
    return many == 1 ? found : -1;
}

bool land_check_tiles(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    TileRange range = {0};
    if (!read_range(options->tile, &range, e)) {
        return false;
    }
    const char *file = options->output;
    int index = find_tiled(scene);
    if (index < 0 || !file || output_has_ending(file, ".png") ||
        !(output_has_ending(file, ".exr") || output_has_ending(file, ".asc") ||
          output_has_ending(file, ".tif"))) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "--tile %s; it needs a scene with one terrain that has the key tiles, and "
                    "--output .exr, .asc or .tif (the greys of a .png would differ by tile)",
                    options->tile);
    }
    int last = tile_count(scene, index) - 1;
    return (range.last[0] <= last && range.last[1] <= last) ||
           fail(e, RAMIFY_BAD_INPUT, "--tile %s; the world has tiles 0,0 to %d,%d", options->tile,
                last, last);
}

// FILE.ext as FILE-X-Y.ext. The caller frees it.
static char *tile_file(const char *file, int column, int row, RamifyError *e)
{
    size_t size = strlen(file) + 32;
    char *name = allocate((int64_t)size, 1, e);
    const char *ending = strrchr(file, '.');
    if (name) {
        snprintf(name, size, "%.*s-%d-%d%s", (int)(ending - file), file, column, row, ending);
    }
    return name;
}

static bool write_tile(const Options *options, const RamifyScene *scene, int index,
                       const RamifyLand *world, int column, int row, const char *file,
                       const RamifyRun *run, RamifyError *e)
{
    RamifyLand *tile = ramify_land_tile(scene, index, world, options->map, column, row, run, e);
    bool done = tile && ramify_land_write(tile, file, e);
    if (done && !options->quiet) {
        fprintf(stderr, "%s: ", file);
        land_describe(scene, index, options->map, tile);
    }
    ramify_land_free(tile);
    return done;
}

bool land_write_tiles(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                      const RamifyRun *run, RamifyError *e)
{
    TileRange range = {0};
    int index = find_tiled(scene);
    RamifyLand *world = read_range(options->tile, &range, e)
                            ? ramify_land(scene, index, trees[index], run, e)
                            : NULL;
    bool one = world && range.first[0] == range.last[0] && range.first[1] == range.last[1];
    bool done = world;
    for (int row = range.first[1]; done && row <= range.last[1]; row++) {
        for (int column = range.first[0]; done && column <= range.last[0]; column++) {
            char *name = one ? NULL : tile_file(options->output, column, row, e);
            done = (one || name) && write_tile(options, scene, index, world, column, row,
                                               one ? options->output : name, run, e);
            free(name);
        }
    }
    ramify_land_free(world);
    return done;
}
