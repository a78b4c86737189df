// The ways of the water: each sample drains to one of its eight neighbours, down the steepest way,
// or over the pass of its pit. Slopes are weighed by fixed random factors, so that streams on even
// land do not follow the grid's eight directions (after Fairfield and Leymarie 1991).
#include "base/memory.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "land/landscape_parts.h"

#include <stdlib.h>

void routing_free(Routing *route)
{
    if (route) {
        free(route->order);
        free(route->receiver);
        free(route->area);
        free(route);
    }
}

static Drainage *flood(const Landscape *land, Error *e)
{
    float cell = (float)land->cell, corner = (float)land->corner;
    HeightField *field =
        height_field_new(land->side, land->side, (Vec2){cell, cell}, (Vec2){corner, corner}, e);
    for (int64_t i = 0; field && i < landscape_count(land); i++) {
        field->height[i] = (float)(land->rock[i] + land->loose[i]);
    }
    Drainage *flooded = field ? drainage_flood(field, land->base, e) : NULL;
    height_field_free(field);
    return flooded;
}

// The receiver of sample (column, row), which is not a base.
static int32_t steepest(const Landscape *land, const Drainage *flooded, int column, int row,
                        uint64_t seed)
{
    int64_t i = (int64_t)row * land->side + column;
    float best = 0.0f, here = flooded->filled[i];
    int32_t to = flooded->receiver[i];
    uint64_t bits = random_key(seed, (uint64_t)i);
    for (int k = 0; k < 9; k++, bits >>= 7) {
        int dx = k % 3 - 1, dz = k / 3 - 1, c = column + dx, r = row + dz;
        if (k == 4 || c < 0 || r < 0 || c >= land->side || r >= land->side) {
            continue;
        }
        int64_t n = (int64_t)r * land->side + c;
        float fall = here - flooded->filled[n];
        fall *= dx != 0 && dz != 0 ? 0.70710678f : 1.0f;
        fall *= 0.72f + 0.0044f * (float)(bits & 127);
        if (fall > best) {
            best = fall;
            to = (int32_t)n;
        }
    }
    return to;
}

static void point_down(const Landscape *land, const Drainage *flooded, Routing *route,
                       uint64_t seed, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            route->receiver[i] =
                land->base[i] ? (int32_t)i : steepest(land, flooded, column, row, seed);
        }
    }
}

static void gather_areas(const Landscape *land, Routing *route)
{
    double own = land->cell * land->cell;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        route->area[i] = own;
    }
    for (int64_t k = route->count - 1; k >= 0; k--) {
        int32_t i = route->order[k], to = route->receiver[i];
        if (to != i) {
            route->area[to] += route->area[i];
        }
    }
}

// Fills route->order depth first from the bases (Braun and Willett 2013): a stream's samples come
// one after the other, so passes along it find their data in the cache, as they would not in the
// order of heights. flooded->receiver, which is no longer needed, holds the stack.
static bool order_by_stream(const Landscape *land, Drainage *flooded, Routing *route, Error *e)
{
    int64_t count = landscape_count(land);
    int32_t *first = memory_alloc_zero(count + 1, sizeof *first, e); // of each sample's donors
    int32_t *donor = memory_alloc(count, sizeof *donor, e);
    if (!first || !donor) {
        free(first);
        free(donor);
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        first[route->receiver[i] + 1] += route->receiver[i] != (int32_t)i;
    }
    for (int64_t i = 0; i < count; i++) {
        first[i + 1] += first[i];
    }
    int32_t donors = first[count];
    for (int64_t i = count - 1; i >= 0; i--) { // fills each list from its end
        int32_t to = route->receiver[i];
        if (to != (int32_t)i) {
            donor[--first[to + 1]] = (int32_t)i;
        }
    }
    // Now list i begins at first[i + 1] and ends where list i + 1 begins.
    int32_t *stack = flooded->receiver;
    int64_t placed = 0;
    for (int64_t root = 0; root < count; root++) {
        int64_t height = 0;
        if (land->base[root]) {
            stack[height++] = (int32_t)root;
        }
        while (height > 0) {
            int32_t i = stack[--height];
            route->order[placed++] = i;
            int64_t end = i + 2 <= count ? first[i + 2] : donors;
            for (int64_t k = first[i + 1]; k < end; k++) {
                stack[height++] = donor[k];
            }
        }
    }
    route->count = placed;
    free(first);
    free(donor);
    return true;
}

bool landscape_find_route(Landscape *land, uint64_t seed, const Run *run, Error *e)
{
    Drainage *flooded = flood(land, e);
    if (!flooded) {
        return false;
    }
    Routing *route = land->route;
    if (!route) {
        route = land->route = memory_alloc_zero(1, sizeof *route, e);
        int64_t count = landscape_count(land);
        bool made = route && (route->receiver = memory_alloc(count, sizeof *route->receiver, e)) &&
                    (route->order = memory_alloc(count, sizeof *route->order, e)) &&
                    (route->area = memory_alloc(count, sizeof *route->area, e));
        if (!made) {
            drainage_free(flooded);
            return false;
        }
    }
    point_down(land, flooded, route, seed, run->threads);
    bool done = order_by_stream(land, flooded, route, e);
    drainage_free(flooded);
    if (done) {
        gather_areas(land, route);
    }
    return done;
}
