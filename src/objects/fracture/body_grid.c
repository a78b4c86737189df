#include "objects/fracture/body_grid.h"

#include "base/lowest_queue.h"
#include "base/memory.h"

#include <stdlib.h>

enum { NEIGHBOURS = 26, POLL = 4096 }; // POLL: steps between two looks at the user's wish to stop

#define LEAST_GAIN 0.8f // of a step: a straight way through 26 neighbours gains 0.88 or more

// ---- nodes ----

static Vec3 point_position(const BodyGrid *grid, int64_t point)
{
    int64_t z = point % grid->size[2], row = point / grid->size[2];
    int64_t y = row % grid->size[1], x = row / grid->size[1];
    return vec3_madd(grid->origin, grid->spacing, vec3((float)x, (float)y, (float)z));
}

static bool lay_out(BodyGrid *grid, Aabb box, float spacing, Error *e)
{
    grid->spacing = spacing;
    grid->origin = vec3_sub(box.low, vec3_splat(2.5f * spacing)); // nodes beside, and a border
    const Vec3 size = vec3_sub(box.high, box.low);
    const float extent[3] = {size.x, size.y, size.z};
    double points = 1.0;
    for (int i = 0; i < 3; i++) {
        grid->size[i] = (int64_t)(extent[i] / spacing) + 7;
        points *= (double)grid->size[i];
    }
    if (points > (double)INT32_MAX) {
        return error_set(e, ERROR_MEMORY,
                         "a grid of %.3g points for the cracks is too fine; at most %d are "
                         "possible: lower resolution",
                         points, INT32_MAX);
    }
    grid->node_at = memory_alloc((int64_t)points, sizeof *grid->node_at, e);
    return grid->node_at;
}

static bool is_border(const BodyGrid *grid, int64_t point)
{
    int64_t z = point % grid->size[2], row = point / grid->size[2];
    int64_t y = row % grid->size[1], x = row / grid->size[1];
    return x == 0 || y == 0 || z == 0 || x == grid->size[0] - 1 || y == grid->size[1] - 1 ||
           z == grid->size[2] - 1;
}

static bool add_nodes(BodyGrid *grid, BodyDistance distance, const void *body, const Run *run,
                      Error *e)
{
    int64_t points = grid->size[0] * grid->size[1] * grid->size[2];
    int64_t capacity = 0, flags = 0, places = 0;
    float near = 0.99f * grid->spacing; // distances beyond may be clamped
    for (int64_t i = 0; i < points; i++) {
        if (i % POLL == 0 && run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        float outer;
        grid->node_at[i] = -1;
        if (is_border(grid, i) || !(distance(body, point_position(grid, i), &outer) < near)) {
            continue;
        }
        if (!memory_reserve(&grid->point, &capacity, grid->count + 1, sizeof *grid->point, e) ||
            !memory_reserve(&grid->position, &places, grid->count + 1, sizeof *grid->position, e) ||
            !memory_reserve(&grid->surface, &flags, grid->count + 1, sizeof *grid->surface, e)) {
            return false;
        }
        grid->point[grid->count] = (int32_t)i;
        grid->position[grid->count] = point_position(grid, i);
        grid->surface[grid->count] = fabsf(outer) < near;
        grid->node_at[i] = grid->count++;
    }
    return true;
}

bool body_grid_new(BodyGrid *grid, BodyDistance distance, const void *body, Aabb box, float spacing,
                   const Run *run, Error *e)
{
    *grid = (BodyGrid){0};
    if (!lay_out(grid, box, spacing, e) || !add_nodes(grid, distance, body, run, e)) {
        body_grid_clear(grid);
        return false;
    }
    return true;
}

void body_grid_clear(BodyGrid *grid)
{
    free(grid->node_at);
    free(grid->point);
    free(grid->position);
    free(grid->surface);
    *grid = (BodyGrid){0};
}

bool body_grid_cell(const BodyGrid *grid, Vec3 p, int32_t corner[8], float t[3])
{
    Vec3 d = vec3_scale(vec3_sub(p, grid->origin), 1.0f / grid->spacing);
    const float at[3] = {d.x, d.y, d.z};
    int64_t c[3];
    for (int i = 0; i < 3; i++) {
        if (!(at[i] >= 0.0f) || !(at[i] < (float)(grid->size[i] - 1))) {
            return false;
        }
        c[i] = (int64_t)at[i];
        if (t) {
            t[i] = at[i] - (float)c[i];
        }
    }
    bool any = false;
    for (int i = 0; i < 8; i++) {
        int64_t row = (c[0] + (i >> 2)) * grid->size[1] + c[1] + (i >> 1 & 1);
        corner[i] = grid->node_at[row * grid->size[2] + c[2] + (i & 1)];
        any = any || corner[i] >= 0;
    }
    return any;
}

// ---- spreading ----

typedef struct Spread {
    const BodyGrid *grid;
    const SpreadSource *source;
    int kept;
    SpreadEntry *entry;
    uint8_t *settled; // per node: entries that are final
    LowestQueue queue;
    int64_t step[NEIGHBOURS]; // to a neighbour's point
    float length[NEIGHBOURS]; // m
} Spread;

static void find_neighbours(Spread *s)
{
    int n = 0;
    for (int i = 0; i < 27; i++) {
        int x = i / 9 - 1, y = i / 3 % 3 - 1, z = i % 3 - 1;
        if (x || y || z) {
            s->step[n] = (x * s->grid->size[1] + y) * s->grid->size[2] + z;
            s->length[n++] = s->grid->spacing * sqrtf((float)(x * x + y * y + z * z));
        }
    }
}

// Inserts into the node's sorted entries; does nothing if all are at least as cheap.
static bool offer(Spread *s, int32_t node, SpreadEntry offered, Error *e)
{
    SpreadEntry *slot = s->entry + (int64_t)node * s->kept;
    int at = s->kept - 1;
    for (int i = 0; i < s->kept && slot[i].source >= 0; i++) {
        if (s->source[slot[i].source].label == s->source[offered.source].label) {
            at = i;
            break;
        }
    }
    if (at < s->settled[node] || offered.cost >= slot[at].cost) {
        return true;
    }
    for (; at > s->settled[node] && slot[at - 1].cost > offered.cost; at--) {
        slot[at] = slot[at - 1];
    }
    slot[at] = offered;
    return lowest_queue_push(&s->queue, offered.cost, node, e);
}

static bool offer_neighbours(Spread *s, int32_t node, SpreadEntry settled, Error *e)
{
    const SpreadSource *source = &s->source[settled.source];
    for (int i = 0; i < NEIGHBOURS; i++) {
        int32_t to = s->grid->node_at[s->grid->point[node] + s->step[i]];
        if (to < 0 || s->settled[to] == s->kept) {
            continue;
        }
        float straight = source->cost + vec3_distance(s->grid->position[to], source->at);
        float least = settled.cost + LEAST_GAIN * s->length[i];
        SpreadEntry entry = {straight > least ? straight : least, settled.source};
        if (!offer(s, to, entry, e)) {
            return false;
        }
    }
    return true;
}

static bool start(Spread *s, int64_t source_count, Error *e)
{
    int64_t entries = (int64_t)s->grid->count * s->kept;
    for (int64_t i = 0; i < entries; i++) {
        s->entry[i] = (SpreadEntry){INFINITY, -1};
    }
    for (int64_t i = 0; i < source_count; i++) {
        const SpreadSource *source = &s->source[i];
        float far = vec3_distance(s->grid->position[source->node], source->at);
        if (!offer(s, source->node, (SpreadEntry){source->cost + far, (int32_t)i}, e)) {
            return false;
        }
    }
    return true;
}

static bool run_spread(Spread *s, int32_t *order, int32_t *reached, const Run *run, Error *e)
{
    int32_t ordered = 0;
    for (int64_t steps = 0; s->queue.count > 0; steps++) {
        if (steps % POLL == 0 && run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        QueueItem item = lowest_queue_pop(&s->queue);
        int place = s->settled[item.index];
        SpreadEntry entry = {INFINITY, -1};
        if (place < s->kept) {
            entry = s->entry[(int64_t)item.index * s->kept + place];
        }
        if (entry.source < 0 || entry.cost != item.height) {
            continue; // replaced by a cheaper entry
        }
        s->settled[item.index]++;
        if (place == 0 && order) {
            order[ordered] = item.index;
        }
        ordered += place == 0;
        if (!offer_neighbours(s, item.index, entry, e)) {
            return false;
        }
    }
    if (reached) {
        *reached = ordered;
    }
    return true;
}

bool body_grid_spread(const BodyGrid *grid, const SpreadSource *source, int64_t source_count,
                      int kept, SpreadEntry *entry, int32_t *order, int32_t *reached,
                      const Run *run, Error *e)
{
    Spread s = {.grid = grid, .source = source, .kept = kept, .entry = entry};
    find_neighbours(&s);
    s.settled = memory_alloc_zero(grid->count, sizeof *s.settled, e);
    bool done = s.settled && start(&s, source_count, e) && run_spread(&s, order, reached, run, e);
    free(s.settled);
    free(s.queue.item);
    return done;
}
