#include "mesh/lattice.h"

#include "base/memory.h"
#include "shape/level_set.h"

#include <stdlib.h>
#include <string.h>

#define MARGIN_VOXELS \
    10.0f // distance from a bar's surface up to which its field is evaluated: a block's half
          // diagonal and the band
#define CELL_VOXELS 16.0f // approximately; a cell lists the bars that are evaluated somewhere in it

// Loss of a cylinder's squared radius, voxels^2: chords of the surface cut the curve; a smoothing
// step takes 1/3 by its time, and first-order redistancing the rest. Measured on cylinders of 2 to
// 5 voxels' radius.
#define LOST_BY_CHORDS 0.41f
#define LOST_BY_STEP 0.54f

bool lattice_add(Lattice *lattice, Bar bar, Error *e)
{
    if (!memory_reserve(&lattice->bar, &lattice->capacity, lattice->count + 1, sizeof bar, e)) {
        return false;
    }
    lattice->bar[lattice->count++] = bar;
    return true;
}

bool lattice_add_tree(Lattice *lattice, const OutTree *tree, Error *e)
{
    bool done = true;
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i] < 0 ? (int32_t)i : tree->parent[i];
        done = lattice_add(
            lattice,
            (Bar){tree->position[parent], tree->position[i], tree->radius[parent], tree->radius[i]},
            e);
    }
    return done;
}

void lattice_clear(Lattice *lattice)
{
    free(lattice->bar);
    *lattice = (Lattice){0};
}

// ---- bars near a point ----

// Hash table of cells with the bars that may be near; the entries of one cell are contiguous.
typedef struct Entry {
    uint64_t cell;
    int32_t bar;
} Entry;

typedef struct BarGrid {
    const Bar *bar;
    float cell, margin; // m
    float grow;         // m^2, added to squared radii
    Vec3 low;
    int64_t size[3];
    Entry *entry; // sorted by cell, then bar
    int64_t count, capacity;
    int64_t *slot; // hash table: first entry of a cell; -1 = none
    uint64_t mask;
} BarGrid;

static float grown(const BarGrid *grid, float radius)
{
    return sqrtf(radius * radius + grid->grow);
}

static double bar_distance(const BarGrid *grid, const Bar *bar, Vec3 p)
{
    Vec3 along = vec3_sub(bar->b, bar->a), to = vec3_sub(p, bar->a);
    float length2 = vec3_dot(along, along);
    float t = length2 > 0.0f ? clampf(vec3_dot(to, along) / length2, 0.0f, 1.0f) : 0.0f;
    return (double)(vec3_distance(to, vec3_scale(along, t)) -
                    grown(grid, lerpf(bar->radius_a, bar->radius_b, t)));
}

static uint64_t cell_key(const BarGrid *grid, const int64_t c[3])
{
    return (uint64_t)((c[0] * grid->size[1] + c[1]) * grid->size[2] + c[2]);
}

static void cell_of(const BarGrid *grid, Vec3 p, int64_t c[3])
{
    const float at[3] = {p.x - grid->low.x, p.y - grid->low.y, p.z - grid->low.z};
    for (int i = 0; i < 3; i++) {
        c[i] = (int64_t)floorf(at[i] / grid->cell);
        c[i] = c[i] < 0 ? 0 : (c[i] >= grid->size[i] ? grid->size[i] - 1 : c[i]);
    }
}

static Aabb bar_box(const BarGrid *grid, const Bar *bar)
{
    float thick = bar->radius_a > bar->radius_b ? bar->radius_a : bar->radius_b;
    Vec3 reach = vec3_splat(grown(grid, thick) + grid->margin);
    return (Aabb){vec3_sub(vec3_min(bar->a, bar->b), reach),
                  vec3_add(vec3_max(bar->a, bar->b), reach)};
}

// Adds the bar to the cells that it may be near.
static bool enter_bar(BarGrid *grid, int32_t number, Error *e)
{
    const Bar *bar = &grid->bar[number];
    Aabb box = bar_box(grid, bar);
    int64_t low[3], high[3], c[3];
    cell_of(grid, box.low, low);
    cell_of(grid, box.high, high);
    double reach = (double)grid->margin + 0.8660255 * (double)grid->cell; // half a cell's diagonal
    for (c[0] = low[0]; c[0] <= high[0]; c[0]++) {
        for (c[1] = low[1]; c[1] <= high[1]; c[1]++) {
            for (c[2] = low[2]; c[2] <= high[2]; c[2]++) {
                Vec3 middle = vec3((float)c[0] + 0.5f, (float)c[1] + 0.5f, (float)c[2] + 0.5f);
                middle = vec3_madd(grid->low, grid->cell, middle);
                if (bar_distance(grid, bar, middle) > reach) {
                    continue;
                }
                if (!memory_reserve(&grid->entry, &grid->capacity, grid->count + 1, sizeof(Entry),
                                    e)) {
                    return false;
                }
                grid->entry[grid->count++] = (Entry){cell_key(grid, c), number};
            }
        }
    }
    return true;
}

static int compare_entries(const void *a, const void *b)
{
    const Entry *p = a, *q = b;
    if (p->cell != q->cell) {
        return p->cell < q->cell ? -1 : 1;
    }
    return p->bar < q->bar ? -1 : (p->bar > q->bar);
}

static uint64_t slot_of(const BarGrid *grid, uint64_t cell)
{
    uint64_t slot = cell * 0x9e3779b97f4a7c15ull;
    slot ^= slot >> 32;
    while (grid->slot[slot & grid->mask] >= 0 &&
           grid->entry[grid->slot[slot & grid->mask]].cell != cell) {
        slot++;
    }
    return slot & grid->mask;
}

static bool make_table(BarGrid *grid, Error *e)
{
    if (grid->count == 0) {
        return error_set(e, ERROR_INTERNAL, "bars without a cell");
    }
    qsort(grid->entry, (size_t)grid->count, sizeof *grid->entry, compare_entries);
    uint64_t slots = 16;
    while (slots < 2 * (uint64_t)grid->count) {
        slots *= 2;
    }
    grid->mask = slots - 1;
    grid->slot = memory_alloc((int64_t)slots, sizeof *grid->slot, e);
    if (!grid->slot) {
        return false;
    }
    memset(grid->slot, 0xff, sizeof *grid->slot * slots);
    for (int64_t i = grid->count - 1; i >= 0; i--) {
        grid->slot[slot_of(grid, grid->entry[i].cell)] = i;
    }
    return true;
}

static void grid_free(BarGrid *grid)
{
    free(grid->entry);
    free(grid->slot);
}

static bool grid_init(BarGrid *grid, const Lattice *lattice, Aabb box, const Run *run, Error *e)
{
    grid->low = box.low;
    const float extent[3] = {box.high.x - box.low.x, box.high.y - box.low.y,
                             box.high.z - box.low.z};
    for (int i = 0; i < 3; i++) {
        grid->size[i] = (int64_t)(extent[i] / grid->cell) + 1;
    }
    for (int64_t i = 0; i < lattice->count; i++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        if (!enter_bar(grid, (int32_t)i, e)) {
            return false;
        }
    }
    return make_table(grid, e);
}

static double solid_distance(const void *solid, Vec3 p, double *bound)
{
    const BarGrid *grid = solid;
    int64_t c[3];
    cell_of(grid, p, c);
    uint64_t key = cell_key(grid, c);
    int64_t first = grid->slot[slot_of(grid, key)];
    double least = (double)grid->margin;
    for (int64_t i = first; i >= 0 && i < grid->count && grid->entry[i].cell == key; i++) {
        double d = bar_distance(grid, &grid->bar[grid->entry[i].bar], p);
        least = d < least ? d : least;
    }
    *bound = least < 0.0 ? -least : least;
    return least;
}

Mesh *lattice_surface(const Lattice *lattice, float voxel, int smoothing, const Run *run, Error *e)
{
    BarGrid grid = {.bar = lattice->bar,
                    .cell = CELL_VOXELS * voxel,
                    .margin = MARGIN_VOXELS * voxel,
                    .grow = (LOST_BY_CHORDS + LOST_BY_STEP * (float)smoothing) * voxel * voxel};
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < lattice->count; i++) {
        box = aabb_union(box, bar_box(&grid, &lattice->bar[i]));
    }
    LevelSetFrame frame = {box.low, voxel};
    if (!level_set_fits(box, frame, e)) {
        return NULL;
    }
    if (aabb_is_empty(box)) {
        return mesh_new(3, 0, 0, MESH_NORMAL, e);
    }
    Mesh *mesh = NULL;
    LevelSet *set = NULL;
    if (grid_init(&grid, lattice, box, run, e)) {
        set = level_set_from_distance(solid_distance, &grid, box, frame, run, e);
    }
    if (set && level_set_smooth(set, smoothing, run, e) && level_set_finish(set, e)) {
        mesh = level_set_surface(set, e);
    }
    level_set_free(set);
    grid_free(&grid);
    return mesh;
}
