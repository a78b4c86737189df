// Density is a monotone function of depth, softness, altitude and detail, and the first two are
// interpolated between nodes. So its extremes in a box are bounded by those at the eight corners
// with the extremes of the detail in the texels around the box.
#include "render/cloud/cloud_bounds.h"

#include "base/memory.h"
#include "render/cloud/profile.h"

enum {
    CORNERS = PARTS + 1,       // of parts, along a cell's side
    FLAT = CELL_STEPS / 16,    // cells whose bounds are closer have no parts
    PART_STEPS = PARTS / CELL, // parts along a voxel's side
    CELL_NODES = CELL + 1
};

static const float ROUNDING = 1e-4f; // of shares, in lookups and here

typedef struct Extremes {
    float low, high; // shares of the greatest extinction
} Extremes;

// Depth inside the coarse form, m, softness, and share of the greatest extinction at a place; and
// what softness decides: how far detail reaches, m, and one over the width of the edge, 1/m.
typedef struct Corner {
    float inside, softness, share;
    float reach, per_edge;
} Corner;

typedef struct Box {
    Corner corner[8];
    float below, above; // m over the base: of its lower and its upper side
    Vec3 middle;
    float side;
} Box;

// ---- the coarse form in a cell ----

static Corner corner_at_node(const CloudGrid *g, int x, int y, int z)
{
    const int wrap = NODES_ACROSS - 1;
    bool inside = y < g->count[1] && (g->repeats || (x < g->count[0] && z < g->count[2]));
    if (!inside) { // lookups find nothing between the last nodes and these
        return (Corner){.inside = (float)FARTHEST * g->voxel / DISTANCE_STEPS};
    }
    int64_t at = cloud_grid_node(g, x & wrap, y, z & wrap);
    CloudNode n = g->node[at];
    return (Corner){.inside = (float)n.distance * g->voxel / DISTANCE_STEPS,
                    .softness = (float)n.softness / SOFTEST,
                    .share = g->ice ? (float)g->ice[at] / ICE_STEPS : 1.0f};
}

static bool may_hold_droplets(const CloudGrid *g, int cx, int cy, int cz)
{
    if (g->low.y + g->voxel * (float)(CELL * (cy + 1)) <= g->base) {
        return false;
    }
    for (int i = 0; i < CELL_NODES * CELL_NODES * CELL_NODES; i++) {
        Corner c =
            corner_at_node(g, cx * CELL + i / CELL_NODES % CELL_NODES, cy * CELL + i % CELL_NODES,
                           cz * CELL + i / (CELL_NODES * CELL_NODES));
        if (c.inside > -cloud_grid_reach(g, c.softness)) {
            return true;
        }
    }
    return false;
}

static Corner mix(Corner a, Corner b, float t)
{
    return (Corner){.inside = lerpf(a.inside, b.inside, t),
                    .softness = lerpf(a.softness, b.softness, t),
                    .share = lerpf(a.share, b.share, t)};
}

typedef Corner Corners[CORNERS][CORNERS][CORNERS]; // z, x, y

static void interpolate(const CloudGrid *g, int cx, int cy, int cz, Corners out)
{
    Corner node[CELL_NODES][CELL_NODES][CELL_NODES];
    for (int i = 0; i < CELL_NODES * CELL_NODES * CELL_NODES; i++) {
        int x = i / CELL_NODES % CELL_NODES, y = i % CELL_NODES, z = i / (CELL_NODES * CELL_NODES);
        node[z][x][y] = corner_at_node(g, cx * CELL + x, cy * CELL + y, cz * CELL + z);
    }
    for (int i = 0; i < CORNERS * CORNERS * CORNERS; i++) {
        int x = i / CORNERS % CORNERS, y = i % CORNERS, z = i / (CORNERS * CORNERS);
        int a = x / PART_STEPS < CELL ? x / PART_STEPS : CELL - 1;
        int b = y / PART_STEPS < CELL ? y / PART_STEPS : CELL - 1;
        int c = z / PART_STEPS < CELL ? z / PART_STEPS : CELL - 1;
        float u = (float)x / PART_STEPS - (float)a, v = (float)y / PART_STEPS - (float)b;
        Corner edge[4];
        for (int k = 0; k < 4; k++) {
            const Corner *column = node[c + (k >> 1)][a + (k & 1)];
            edge[k] = mix(column[b], column[b + 1], v);
        }
        Corner here = mix(mix(edge[0], edge[1], u), mix(edge[2], edge[3], u),
                          (float)z / PART_STEPS - (float)c);
        here.reach = cloud_grid_reach(g, here.softness);
        here.per_edge = 1.0f / edge_at(&g->rough, here.softness);
        out[z][x][y] = here;
    }
}

// ---- bounds in a box ----

// Of the depth that detail leaves at a corner, in shares of the edge.
static Extremes share_at(const CloudGrid *g, Corner c, DetailRange large, DetailRange small)
{
    const Roughness *r = &g->rough;
    float billows = billows_at(c.softness);
    float high = billows * (r->billow[0] * large.high.billow + r->billow[1] * small.high.billow) +
                 c.softness * (r->wisp[0] * large.high.wisp + r->wisp[1] * small.high.wisp);
    float low = billows * (r->billow[0] * large.low.billow + r->billow[1] * small.low.billow) +
                c.softness * (r->wisp[0] * large.low.wisp + r->wisp[1] * small.low.wisp);
    return (Extremes){unit_clamp((c.inside + low) * c.per_edge - ROUNDING),
                      unit_clamp((c.inside + high) * c.per_edge + ROUNDING)};
}

static bool beyond_detail(const Box *box)
{
    bool any = false;
    for (int i = 0; i < 8; i++) {
        any |= box->corner[i].inside > -box->corner[i].reach;
    }
    return !any || box->above <= 0.0f;
}

// Whether no detail changes the density: too deep inside, and too high over a ragged base.
static bool below_detail(const CloudGrid *g, const Box *box)
{
    bool all = box->below >= RAGGED_UP_TO * g->rough.base;
    for (int i = 0; i < 8; i++) {
        Corner c = box->corner[i];
        all &= (c.inside - c.reach) * c.per_edge >= 1.0f + 2.0f * ROUNDING;
    }
    return all;
}

// Of the large detail.
static DetailRange large_in(const CloudGrid *g, const Box *box)
{
    if (below_detail(g, box)) {
        return detail_range_whole(g->detail);
    }
    float scale = 1.0f / g->rough.period[0], half = 0.5f * box->side * scale;
    Vec3 middle = vec3_scale(cloud_grid_turned(box->middle), scale);
    return detail_range(g->detail, middle, vec3_scale(cloud_grid_turned_cube, half));
}

// Of the factor that altitude decides, or depth.
static Extremes gain_in(const CloudGrid *g, const Box *box)
{
    if (g->pooled) { // which depth decides
        Extremes deep = {box->corner[0].inside, box->corner[0].inside};
        for (int i = 1; i < 8; i++) {
            deep = (Extremes){smaller(deep.low, box->corner[i].inside),
                              larger(deep.high, box->corner[i].inside)};
        }
        return (Extremes){box->below > 0.0f ? gain_at(g, 0.0f, deep.low) : 0.0f,
                          gain_at(g, 0.0f, deep.high)};
    }
    float below = gain_at(g, box->below, 0.0f), above = gain_at(g, box->above, 0.0f);
    if (!g->fog) {
        return (Extremes){below, above};
    }
    return (Extremes){box->below > 0.0f ? above : 0.0f, below}; // ends sharply at its base
}

static Extremes in_box(const CloudGrid *g, const Box *box, DetailRange small)
{
    if (beyond_detail(box)) {
        return (Extremes){0.0f, 0.0f};
    }
    DetailRange large = large_in(g, box);
    Extremes share = {1.0f, 0.0f}, softness = {1.0f, 0.0f}, ice = {1.0f, 0.0f};
    for (int i = 0; i < 8; i++) {
        Corner c = box->corner[i];
        Extremes e = share_at(g, c, large, small);
        share = (Extremes){smaller(share.low, e.low), larger(share.high, e.high)};
        softness = (Extremes){smaller(softness.low, c.softness), larger(softness.high, c.softness)};
        ice = (Extremes){smaller(ice.low, c.share), larger(ice.high, c.share)};
    }
    float smooth = 1.0f + large.low.wisp;
    float torn = 1.0f + large.high.wisp + RAGGED_SMALL * (1.0f + small.high.wisp);
    Extremes gain = gain_in(g, box);
    return (Extremes){density_at(share.low, softness.high) * gain.low * ice.low *
                          raised_at(&g->rough, box->below, torn),
                      density_at(share.high, softness.low) * gain.high * ice.high *
                          raised_at(&g->rough, box->above, smooth)};
}

// Rounded outward.
static CloudBounds in_steps(Extremes e)
{
    float low = floorf(larger(e.low - ROUNDING, 0.0f) * CELL_STEPS);
    float high = e.high > 0.0f ? ceilf(smaller(e.high + ROUNDING, 1.0f) * CELL_STEPS) : 0.0f;
    return (CloudBounds){(uint8_t)low, (uint8_t)high};
}

// Fills the bounds of a cell's parts; returns those of the cell.
static CloudBounds fill_parts(const CloudGrid *g, int cx, int cy, int cz, DetailRange small,
                              CloudBounds part[])
{
    Corners at;
    interpolate(g, cx, cy, cz, at);
    CloudBounds all = {CELL_STEPS, 0};
    Box box = {.side = g->voxel / PART_STEPS};
    for (int i = 0; i < PARTS * PARTS * PARTS; i++) {
        int x = i / PARTS % PARTS, y = i % PARTS, z = i / (PARTS * PARTS);
        for (int k = 0; k < 8; k++) {
            box.corner[k] = at[z + (k >> 2)][x + (k >> 1 & 1)][y + (k & 1)];
        }
        Vec3 places = vec3((float)(cx * PARTS + x) + 0.5f, (float)(cy * PARTS + y) + 0.5f,
                           (float)(cz * PARTS + z) + 0.5f);
        box.middle = vec3_madd(g->low, box.side, places);
        box.below = box.middle.y - 0.5f * box.side - g->base;
        box.above = box.below + box.side;
        part[i] = in_steps(in_box(g, &box, small));
        all.least = part[i].least < all.least ? part[i].least : all.least;
        all.most = part[i].most > all.most ? part[i].most : all.most;
    }
    return all;
}

// ---- gaps ----

// Clear cells learn the least of their neighbours' gaps plus one, in two sweeps through the grid
// (Rosenfeld and Pfaltz 1966), which are exact for chessboard distances.
static void sweep(CloudGrid *g, bool back)
{
    const int *n = g->cells;
    int64_t all = (int64_t)n[0] * n[1] * n[2];
    for (int64_t k = 0; k < all; k++) {
        int64_t at = back ? all - 1 - k : k;
        if (g->cell[at].gap == 0) {
            continue;
        }
        int y = (int)(at % n[1]), x = (int)(at / n[1] % n[0]), z = (int)(at / n[1] / n[0]);
        int gap = g->cell[at].gap;
        for (int i = 0; i < 13; i++) { // the neighbours that the sweep has passed
            int dx = back ? 1 - i / 3 % 3 : i / 3 % 3 - 1, dy = back ? 1 - i % 3 : i % 3 - 1;
            int dz = back ? 1 - i / 9 : i / 9 - 1;
            int64_t other = cloud_grid_cell(g, x + dx, y + dy, z + dz);
            int next = other < 0 ? MOST_GAP : g->cell[other].gap + 1;
            gap = next < gap ? next : gap;
        }
        g->cell[at].gap = (uint8_t)gap;
    }
}

void cloud_bounds_find_gaps(CloudGrid *g)
{
    for (int64_t i = 0; i < cloud_grid_cells(g); i++) {
        g->cell[i].gap = g->cell[i].bounds.most > 0 ? 0 : MOST_GAP;
    }
    for (int round = 0; round < (g->repeats ? 2 : 1); round++) { // the second carries on across
        sweep(g, false);                                         // the borders
        sweep(g, true);
    }
}

// ---- all cells ----

// Gives cells that may hold droplets a place for their parts.
static bool make_room(CloudGrid *g, const Run *run, Error *e)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < g->cells[2]; z++) {
        for (int x = 0; x < g->cells[0]; x++) {
            for (int y = 0; y < g->cells[1]; y++) {
                g->cell[cloud_grid_cell(g, x, y, z)] =
                    (CloudCell){.parts = may_hold_droplets(g, x, y, z) ? 0 : -1};
            }
        }
    }
    int64_t count = 0;
    for (int64_t i = 0; i < cloud_grid_cells(g); i++) {
        if (g->cell[i].parts == 0) {
            g->cell[i].parts = (int32_t)count++;
        }
    }
    g->part = memory_alloc(count > 0 ? count : 1, sizeof *g->part * PARTS * PARTS * PARTS, e);
    return g->part;
}

bool cloud_bounds_fill(CloudGrid *g, const Run *run, Error *e)
{
    if (!make_room(g, run, e)) {
        return false;
    }
    DetailRange small = detail_range_whole(g->detail); // or none, for blurred light
    small.high.billow = larger(small.high.billow, 0.0f);
    small.high.wisp = larger(small.high.wisp, 0.0f);
    small.low.billow = smaller(small.low.billow, 0.0f);
    small.low.wisp = smaller(small.low.wisp, 0.0f);
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int z = 0; z < g->cells[2]; z++) {
        for (int x = 0; x < g->cells[0]; x++) {
            for (int y = 0; y < g->cells[1]; y++) {
                CloudCell *cell = &g->cell[cloud_grid_cell(g, x, y, z)];
                if (cell->parts >= 0) {
                    CloudBounds *part = &g->part[(int64_t)cell->parts * PARTS * PARTS * PARTS];
                    cell->bounds = fill_parts(g, x, y, z, small, part);
                    bool flat = cell->bounds.most - cell->bounds.least <= FLAT;
                    cell->parts = flat ? -1 : cell->parts;
                }
            }
        }
    }
    cloud_bounds_find_gaps(g);
    return true;
}
