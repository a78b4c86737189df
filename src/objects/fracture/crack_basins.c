#include "objects/fracture/crack_basins.h"

#include "base/memory.h"

#include <stdlib.h>

enum { POLL = 4096 }; // nodes between two looks at the user's wish to stop

#define OPEN \
    0.65f // a gap in a crack this wide over the lesser side's own width joins the two sides

// ---- distance to the network ----

typedef struct Sources {
    SpreadSource *item;
    int64_t count, capacity;
} Sources;

static bool add_source(Sources *sources, Vec3 at, float cost, int32_t node, Error *e)
{
    if (!memory_reserve(&sources->item, &sources->capacity, sources->count + 1,
                        sizeof *sources->item, e)) {
        return false;
    }
    sources->item[sources->count++] = (SpreadSource){.at = at, .cost = cost, .node = node};
    return true;
}

// Segments of the network are straight, the surface is not: points deeper than the grid's spacing
// are projected to the surface, points in the air are dropped.
static bool add_point(Sources *sources, const BodyGrid *grid, const SpreadEntry *to_surface, Vec3 p,
                      Error *e)
{
    int32_t corner[8];
    if (!body_grid_cell(grid, p, corner, NULL)) {
        return true;
    }
    bool near = false;
    int32_t deep = -1;
    for (int i = 0; i < 8; i++) {
        near = near || (corner[i] >= 0 && grid->surface[corner[i]]);
        deep = corner[i] >= 0 ? corner[i] : deep;
    }
    if (!near) {
        int32_t node = to_surface[deep].source;
        return node < 0 || add_source(sources, grid->position[node], 0.0f, node, e);
    }
    for (int i = 0; i < 8; i++) {
        if (corner[i] >= 0 && !add_source(sources, p, 0.0f, corner[i], e)) {
            return false;
        }
    }
    return true;
}

static bool add_network(Sources *sources, const BodyGrid *grid, const SpreadEntry *to_surface,
                        const OutTree *network, Error *e)
{
    for (int64_t i = 0; i < network->count; i++) {
        if (network->parent[i] < 0) {
            continue;
        }
        Vec3 a = network->position[network->parent[i]], b = network->position[i];
        int steps = (int)(2.0f * vec3_distance(a, b) / grid->spacing) + 1;
        for (int k = 0; k <= steps; k++) {
            Vec3 p = vec3_lerp(a, b, (float)k / (float)steps);
            if (!add_point(sources, grid, to_surface, p, e)) {
                return false;
            }
        }
    }
    return true;
}

// entry[node].source becomes the nearest node of the surface (its number, not the source's).
static bool find_surface(const BodyGrid *grid, SpreadEntry *entry, const Run *run, Error *e)
{
    Sources sources = {0};
    bool done = true;
    for (int32_t i = 0; done && i < grid->count; i++) {
        done = !grid->surface[i] || add_source(&sources, grid->position[i], 0.0f, i, e);
    }
    done =
        done && body_grid_spread(grid, sources.item, sources.count, 1, entry, NULL, NULL, run, e);
    for (int32_t i = 0; done && i < grid->count; i++) {
        bool there = sources.item && entry[i].source >= 0;
        entry[i].source = there ? sources.item[entry[i].source].node : -1;
    }
    free(sources.item);
    return done;
}

static bool measure_far(CrackBasins *basins, const BodyGrid *grid, const OutTree *network,
                        SpreadEntry *entry, const Run *run, Error *e)
{
    Sources sources = {0};
    int64_t most = grid->size[0] > grid->size[1] ? grid->size[0] : grid->size[1];
    float without = grid->spacing * (float)(most > grid->size[2] ? most : grid->size[2]);
    bool done = find_surface(grid, entry, run, e) &&
                add_network(&sources, grid, entry, network, e) &&
                body_grid_spread(grid, sources.item, sources.count, 1, entry, NULL, NULL, run, e);
    for (int32_t i = 0; done && i < grid->count; i++) {
        basins->far[i] = entry[i].source < 0 ? without : entry[i].cost;
    }
    free(sources.item);
    return done;
}

// ---- flooding ----

typedef struct Basin {
    int32_t joined; // the basin it was merged into; itself at first
    float peak;
} Basin;

typedef struct Flood {
    const BodyGrid *grid;
    const SpreadEntry *entry; // per node: minus the cost is its height
    float least;
    int32_t *basin; // per node, -1 = not flooded yet
    Basin *list;
    int64_t count, capacity;
    int32_t small;
} Flood;

static int32_t top_of(Flood *flood, int32_t basin)
{
    while (flood->list[basin].joined != basin) {
        flood->list[basin].joined = flood->list[flood->list[basin].joined].joined;
        basin = flood->list[basin].joined;
    }
    return basin;
}

// Merges two basins that meet at this height if the pass between them is high or one is small.
static void meet(Flood *flood, int32_t a, int32_t b, float height)
{
    if (flood->list[a].peak < flood->list[b].peak ||
        (b < a && flood->list[a].peak == flood->list[b].peak)) {
        int32_t swap = a;
        a = b, b = swap;
    }
    float lesser = flood->list[b].peak;
    bool open = height > OPEN * lesser, small = lesser < flood->least;
    if (open || small) {
        flood->list[b].joined = a;
        flood->small += !open && small;
    }
}

// The basin of the highest flooded neighbour; merges others it touches if needed.
static bool wet(Flood *flood, int32_t node, Error *e)
{
    const BodyGrid *grid = flood->grid;
    float height = -flood->entry[node].cost, highest = -INFINITY;
    int32_t own = -1, near[26];
    int count = 0;
    for (int i = 0; i < 27; i++) {
        int64_t step = ((i / 9 - 1) * grid->size[1] + i / 3 % 3 - 1) * grid->size[2] + i % 3 - 1;
        int32_t to = i == 13 ? -1 : grid->node_at[grid->point[node] + step];
        if (to >= 0 && flood->basin[to] >= 0) {
            near[count++] = flood->basin[to];
            bool higher = -flood->entry[to].cost > highest;
            own = higher ? flood->basin[to] : own;
            highest = higher ? -flood->entry[to].cost : highest;
        }
    }
    if (count == 0 || !flood->list) {
        if (!memory_reserve(&flood->list, &flood->capacity, flood->count + 1, sizeof *flood->list,
                            e)) {
            return false;
        }
        own = (int32_t)flood->count++;
        flood->list[own] = (Basin){own, height};
    }
    flood->basin[node] = own;
    for (int i = 0; i < count; i++) {
        int32_t a = top_of(flood, own), b = top_of(flood, near[i]);
        if (a != b) {
            meet(flood, a, b, height);
        }
    }
    return true;
}

// Numbers the remaining basins in order of their peaks, highest first.
static bool number_cells(CrackBasins *basins, Flood *flood, Error *e)
{
    int32_t *number = memory_alloc(flood->count, sizeof *number, e);
    basins->peak = number ? memory_alloc(flood->count, sizeof *basins->peak, e) : NULL;
    if (!basins->peak) {
        free(number);
        return false;
    }
    for (int32_t i = 0; i < flood->count; i++) {
        if (flood->list[i].joined == i) {
            basins->peak[basins->count] = flood->list[i].peak;
            number[i] = basins->count++;
        }
    }
    for (int32_t i = 0; i < flood->grid->count; i++) {
        basins->cell[i] = number[top_of(flood, flood->basin[i])];
    }
    basins->small = flood->small;
    free(number);
    return true;
}

// From the surface inward heights fall by the path length.
static bool flood_body(CrackBasins *basins, const BodyGrid *grid, float least, SpreadEntry *entry,
                       const Run *run, Error *e)
{
    Sources sources = {0};
    Flood flood = {.grid = grid, .entry = entry, .least = least, .basin = basins->cell};
    int32_t *order = memory_alloc(grid->count, sizeof *order, e), reached = 0;
    bool done = order;
    for (int32_t i = 0; done && i < grid->count; i++) {
        flood.basin[i] = -1;
        done = !grid->surface[i] || add_source(&sources, grid->position[i], -basins->far[i], i, e);
    }
    done = done &&
           body_grid_spread(grid, sources.item, sources.count, 1, entry, order, &reached, run, e);
    for (int32_t i = 0; done && i < reached; i++) {
        bool stop = i % POLL == 0 && run_is_cancelled(run);
        done = stop ? run_cancel_error(e) : wet(&flood, order[i], e);
    }
    if (done && (!flood.list || reached < grid->count)) {
        error_set(e, ERROR_INPUT,
                  "a part of the body is too thin to break on a grid of %g m; raise resolution",
                  (double)grid->spacing);
        done = false;
    }
    done = done && number_cells(basins, &flood, e);
    free(flood.list);
    free(sources.item);
    free(order);
    return done;
}

bool crack_basins_new(CrackBasins *basins, const BodyGrid *grid, const OutTree *network,
                      float least, const Run *run, Error *e)
{
    *basins = (CrackBasins){0};
    SpreadEntry *entry = memory_alloc(grid->count, sizeof *entry, e);
    basins->cell = memory_alloc(grid->count, sizeof *basins->cell, e);
    basins->far = memory_alloc(grid->count, sizeof *basins->far, e);
    bool done = entry && basins->cell && basins->far &&
                measure_far(basins, grid, network, entry, run, e) &&
                flood_body(basins, grid, least, entry, run, e);
    free(entry);
    if (!done) {
        crack_basins_clear(basins);
    }
    return done;
}

void crack_basins_clear(CrackBasins *basins)
{
    free(basins->cell);
    free(basins->far);
    free(basins->peak);
    *basins = (CrackBasins){0};
}
