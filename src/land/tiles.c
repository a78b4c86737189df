#include "land/tiles.h"

#include "base/memory.h"
#include "land/tile_detail.h"

#include <stdlib.h>
#include <string.h>

// The world's sample that stands for any index along an axis.
static int inside(const HeightField *world, int64_t index)
{
    return (int)tile_folded(index, world->columns - 1, world->periodic);
}

static TileWindow window_of(int64_t x, int64_t z, int64_t columns, int64_t rows)
{
    return (TileWindow){.x = x, .z = z, .columns = (int)columns, .rows = (int)rows};
}

// What a level needs of the one before: two samples on each side of every sample.
static TileWindow window_before(const TileWindow *window)
{
    int64_t x = tile_half(window->x) - 1, z = tile_half(window->z) - 1;
    return window_of(x, z, tile_half(window->x + window->columns - 1) + 3 - x,
                     tile_half(window->z + window->rows - 1) + 3 - z);
}

static TileWindow widened(TileWindow window, int margin)
{
    return window_of(window.x - margin, window.z - margin, window.columns + 2 * margin,
                     window.rows + 2 * margin);
}

static bool read_world(TileWindow *window, const HeightField *world, Error *e)
{
    window->height = memory_alloc((int64_t)window->columns * window->rows, sizeof(float), e);
    for (int row = 0; window->height && row < window->rows; row++) {
        const float *from =
            world->height + (int64_t)inside(world, window->z + row) * world->columns;
        float *to = window->height + (int64_t)row * window->columns;
        for (int column = 0; column < window->columns; column++) {
            to[column] = from[inside(world, window->x + column)];
        }
    }
    return window->height;
}

// The heights of a window at a level of refinement, 0 = the world's own samples.
static bool fill_window(TileWindow *window, const HeightField *world, const TileGrid *grid,
                        int level, const Run *run, Error *e)
{
    if (level == 0) {
        return read_world(window, world, e);
    }
    int margin = grid->detail > 0.0f ? tile_detail_reach() : 0;
    TileWindow wide = widened(*window, margin), coarse = window_before(&wide);
    bool done =
        fill_window(&coarse, world, grid, level - 1, run, e) && tile_refine(&wide, &coarse, run, e);
    free(coarse.height);
    TileDetail detail = {.cell = world->cell.x / (float)(1 << level),
                         .strength = grid->detail,
                         .seed = grid->seed + (uint64_t)level,
                         .period = (int64_t)(world->columns - 1) << level,
                         .periodic = world->periodic};
    done = done && (grid->detail <= 0.0f || tile_roughen(&wide, &detail, run, e)) &&
           !run_is_cancelled(run);
    if (done) {
        window->height = memory_alloc((int64_t)window->columns * window->rows, sizeof(float), e);
        done = window->height;
    }
    for (int row = 0; done && row < window->rows; row++) {
        memcpy(window->height + (int64_t)row * window->columns,
               wide.height + (int64_t)(row + margin) * wide.columns + margin,
               sizeof(float) * (size_t)window->columns);
    }
    free(wide.height);
    return done || (run_is_cancelled(run) && run_cancel_error(e));
}

// Bilinear from the world: the values of one record, `width` floats a sample.
static bool take_record(float **to, const float *from, int width, const HeightField *world,
                        const TileWindow *window, int level, Error *e)
{
    if (!from) {
        return true;
    }
    *to = memory_alloc((int64_t)window->columns * window->rows * width, sizeof **to, e);
    int64_t mask = ((int64_t)1 << level) - 1;
    float share = 1.0f / (float)(1 << level);
    for (int64_t i = 0; *to && i < (int64_t)window->columns * window->rows; i++) {
        int64_t x = window->x + i % window->columns, z = window->z + i / window->columns;
        float u = (float)(x & mask) * share, v = (float)(z & mask) * share;
        int64_t column[2] = {inside(world, x >> level), inside(world, (x >> level) + 1)};
        int64_t row[2] = {(int64_t)inside(world, z >> level) * world->columns,
                          (int64_t)inside(world, (z >> level) + 1) * world->columns};
        for (int k = 0; k < width; k++) {
            float north = lerpf(from[(row[0] + column[0]) * width + k],
                                from[(row[0] + column[1]) * width + k], u);
            float south = lerpf(from[(row[1] + column[0]) * width + k],
                                from[(row[1] + column[1]) * width + k], u);
            (*to)[i * width + k] = lerpf(north, south, v);
        }
    }
    return *to;
}

static bool take_records(HeightField *tile, const HeightField *world, const TileWindow *window,
                         int level, Error *e)
{
    return take_record(&tile->wetness, world->wetness, 1, world, window, level, e) &&
           take_record(&tile->climate, world->climate, 1, world, window, level, e) &&
           take_record(&tile->change, world->change, 1, world, window, level, e) &&
           take_record(&tile->loose, world->loose, 1, world, window, level, e) &&
           take_record(&tile->ground, world->ground, 1, world, window, level, e) &&
           take_record(&tile->age, world->age, 1, world, window, level, e) &&
           take_record((float **)(void *)&tile->wind, (const float *)(const void *)world->wind, 2,
                       world, window, level, e) &&
           height_field_take_place(tile, world, 0.0, 0.0, e);
}

static bool check_tile(const TileGrid *grid, int column, int row, Error *e)
{
    return (column >= 0 && row >= 0 && column < grid->count && row < grid->count) ||
           error_set(e, ERROR_INPUT, "tile %d,%d; the world has tiles 0,0 to %d,%d", column, row,
                     grid->count - 1, grid->count - 1);
}

// How often the world's cells are halved for this grid; -1 and e if they cannot be.
static int find_level(const HeightField *world, const TileGrid *grid, Error *e)
{
    int64_t cells = (int64_t)grid->count * grid->cells;
    int level = 0;
    while ((int64_t)(world->columns - 1) << level < cells) {
        level++;
    }
    if ((int64_t)(world->columns - 1) << level != cells || world->rows != world->columns) {
        error_set(e, ERROR_INPUT,
                  "%d x %d tiles of %d cells; the land has %d cells a side, and tiles must have as "
                  "many or 2, 4, 8, ... times as many together",
                  grid->count, grid->count, grid->cells, world->columns - 1);
        return -1;
    }
    return level;
}

HeightField *tile_land_around(const HeightField *world, const TileGrid *grid, int column, int row,
                              int margin, const Run *run, Error *e)
{
    int level = find_level(world, grid, e);
    if (level < 0) {
        return NULL;
    }
    TileWindow window = widened(window_of((int64_t)column * grid->cells, (int64_t)row * grid->cells,
                                          grid->cells + 1, grid->cells + 1),
                                margin);
    double cell = (double)world->cell.x / (double)(1 << level);
    Vec2 origin = {(float)((double)world->origin.x + cell * (double)window.x),
                   (float)((double)world->origin.y + cell * (double)window.z)};
    HeightField *tile =
        height_field_new(window.columns, window.rows, (Vec2){(float)cell, (float)cell}, origin, e);
    if (!tile || !fill_window(&window, world, grid, level, run, e)) {
        height_field_free(tile);
        return NULL;
    }
    free(tile->height);
    tile->height = window.height;
    if (!take_records(tile, world, &window, level, e)) {
        height_field_free(tile);
        return NULL;
    }
    return tile;
}

HeightField *tile_land(const HeightField *world, const TileGrid *grid, int column, int row,
                       const Run *run, Error *e)
{
    return check_tile(grid, column, row, e) ? tile_land_around(world, grid, column, row, 0, run, e)
                                            : NULL;
}

// The tile without its margin of one sample; its records are left behind.
static HeightField *without_margin(const HeightField *wide, Error *e)
{
    Vec2 origin = {wide->origin.x + wide->cell.x, wide->origin.y + wide->cell.y};
    HeightField *tile = height_field_new(wide->columns - 2, wide->rows - 2, wide->cell, origin, e);
    for (int row = 0; tile && row < tile->rows; row++) {
        memcpy(tile->height + (int64_t)row * tile->columns,
               wide->height + (int64_t)(row + 1) * wide->columns + 1,
               sizeof(float) * (size_t)tile->columns);
    }
    if (tile && !height_field_take_place(tile, wide, 0.0, 0.0, e)) {
        height_field_free(tile);
        return NULL;
    }
    return tile;
}

static bool is_local(int kind)
{
    return kind == HEIGHT_MAP_SLOPE || kind == HEIGHT_MAP_ASPECT || kind == HEIGHT_MAP_CURVATURE ||
           kind == HEIGHT_MAP_ALTITUDE;
}

HeightField *tile_map(const HeightField *world, const TileGrid *grid, int column, int row,
                      const HeightMap *map, const Run *run, Error *e)
{
    HeightField *tile = NULL;
    if (!check_tile(grid, column, row, e)) {
        return NULL;
    }
    if (is_local(map->kind)) {
        HeightField *wide = tile_land_around(world, grid, column, row, 1, run, e);
        HeightField *drawn = wide ? height_map(wide, map, run, e) : NULL;
        tile = drawn ? without_margin(drawn, e) : NULL;
        height_field_free(drawn);
        height_field_free(wide);
        return tile;
    }
    TileGrid smooth = *grid;
    smooth.detail = 0.0f;
    HeightField *whole = height_map(world, map, run, e);
    tile = whole ? tile_land_around(whole, &smooth, column, row, 0, run, e) : NULL;
    height_field_free(whole);
    return tile;
}
