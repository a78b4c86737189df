// Density is a monotone function of depth, softness, altitude and detail, and the first two are
// interpolated between nodes. So its extremes in a box are bounded by those at the eight corners
// with the extremes of the detail in the texels around the box.
#include "render/cloud/cloud_bounds.h"

#include "base/memory.h"
#include "render/cloud/profile.h"

#include <string.h>

enum {
    CORNERS = PARTS + 1,       // of parts, along a cell's side
    SHEET = CORNERS * CORNERS, // corners of one z
    PLANE = CORNERS * SHEET,
    LANES = (PARTS - 1) * (SHEET + CORNERS + 1) + 1, // up to the last part's
    FLAT = CELL_STEPS / 16,                          // cells whose bounds are closer have no parts
    PART_STEPS = PARTS / CELL,                       // parts along a voxel's side
    CELL_NODES = CELL + 1,
    NODES = CELL_NODES * CELL_NODES * CELL_NODES
};

// From a part's first corner to each of its eight. Loops over it are unrolled: else GCC makes them
// the inner ones and gathers what lies side by side.
static const int corner_offset[8] = {0,     1,         CORNERS,         CORNERS + 1,
                                     SHEET, SHEET + 1, SHEET + CORNERS, SHEET + CORNERS + 1};

static const float ROUNDING = 1e-4f; // of shares, in lookups and here

typedef struct Extremes {
    float low, high;
} Extremes;

// Depth inside the coarse form, m, softness, and share of the greatest extinction at a place.
typedef struct Corner {
    float inside, softness, share;
} Corner;

// The same at the corners of a cell's parts, z first, y last; and what softness decides: how much
// is left of billows, how far detail reaches, m, and one over the width of the edge, 1/m. In
// planes, so that one instruction serves many parts.
typedef struct Corners {
    float inside[PLANE], softness[PLANE], share[PLANE];
    float billows[PLANE], reach[PLANE], per_edge[PLANE];
} Corners;

// Extremes in the parts of a cell: part (x, y, z) in the lane of its first corner. The lanes
// between hold numbers that nobody reads.
typedef struct Lanes {
    float low[LANES], high[LANES];
} Lanes;

static int lane_of(int x, int y, int z)
{
    return z * SHEET + x * CORNERS + y;
}

// ---- the coarse form in a cell ----

static Corner corner_at_node(const CloudGrid *g, int x, int y, int z)
{
    const int wrap = g->count[0] - 1;
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
        if (c.inside > -reach_at(&g->rough, c.softness)) {
            return true;
        }
    }
    return false;
}

// Interpolates between CELL_NODES rows of `width` values to CORNERS rows; rows are a step apart.
static void refine(const float *coarse, int coarse_step, float *fine, int fine_step, int width)
{
    for (int i = 0; i < CORNERS; i++) {
        int node = i / PART_STEPS < CELL ? i / PART_STEPS : CELL - 1;
        float t = (float)i / PART_STEPS - (float)node;
        const float *a = coarse + node * coarse_step, *b = a + coarse_step;
        for (int k = 0; k < width; k++) {
            fine[i * fine_step + k] = lerpf(a[k], b[k], t);
        }
    }
}

static void interpolate_plane(const float node[NODES], float plane[PLANE])
{
    float rows[CELL_NODES * CELL_NODES * CORNERS], sheets[CELL_NODES * SHEET];
    for (int i = 0; i < CELL_NODES * CELL_NODES; i++) {
        refine(node + i * CELL_NODES, 1, rows + i * CORNERS, 1, 1);
    }
    for (int z = 0; z < CELL_NODES; z++) {
        refine(rows + z * CELL_NODES * CORNERS, CORNERS, sheets + z * SHEET, CORNERS, CORNERS);
    }
    refine(sheets, SHEET, plane, SHEET, SHEET);
}

static void interpolate(const CloudGrid *g, int cx, int cy, int cz, Corners *out)
{
    float inside[NODES], softness[NODES], share[NODES];
    for (int i = 0; i < NODES; i++) {
        int x = i / CELL_NODES % CELL_NODES, y = i % CELL_NODES, z = i / (CELL_NODES * CELL_NODES);
        Corner c = corner_at_node(g, cx * CELL + x, cy * CELL + y, cz * CELL + z);
        inside[i] = c.inside;
        softness[i] = c.softness;
        share[i] = c.share;
    }
    interpolate_plane(inside, out->inside);
    interpolate_plane(softness, out->softness);
    interpolate_plane(share, out->share);
    const Roughness r = g->rough;
    for (int i = 0; i < PLANE; i++) {
        out->billows[i] = billows_at(out->softness[i]);
        out->reach[i] = reach_at(&r, out->softness[i]);
        out->per_edge[i] = 1.0f / edge_at(&r, out->softness[i]);
    }
}

// ---- what detail does to it ----

static void any_corner(const bool plane[PLANE], bool any[restrict LANES])
{
    memcpy(any, plane, LANES * sizeof *any);
#pragma GCC unroll 8
    for (int k = 1; k < 8; k++) {
        const bool *corner = plane + corner_offset[k];
#pragma omp simd
        for (int i = 0; i < LANES; i++) {
            any[i] = any[i] | corner[i];
        }
    }
}

// Whether detail may leave droplets in each part, and whether it may change how many.
static void find_touched(const Corners *c, bool droplets[LANES], bool changed[LANES])
{
    bool near[PLANE], shallow[PLANE];
    for (int i = 0; i < PLANE; i++) {
        near[i] = c->inside[i] > -c->reach[i];
        shallow[i] = (c->inside[i] - c->reach[i]) * c->per_edge[i] < 1.0f + 2.0f * ROUNDING;
    }
    any_corner(near, droplets);
    any_corner(shallow, changed);
}

// The large detail in the box around a part.
static DetailRange large_around(const CloudGrid *g, Vec3 middle, float side)
{
    float scale = 1.0f / g->rough.period[0], half = 0.5f * side * scale;
    return detail_range(g->detail, vec3_scale(cloud_grid_turned(middle), scale),
                        vec3_scale(cloud_grid_turned_cube, half));
}

static void range_plane(const float plane[PLANE], Lanes *range)
{
    for (int i = 0; i < LANES; i++) {
        range->low[i] = range->high[i] = plane[i];
    }
#pragma GCC unroll 8
    for (int k = 1; k < 8; k++) {
        const float *corner = plane + corner_offset[k];
#pragma omp simd
        for (int i = 0; i < LANES; i++) {
            range->low[i] = smaller(range->low[i], corner[i]);
            range->high[i] = larger(range->high[i], corner[i]);
        }
    }
}

// Of the depth that detail leaves, in shares of the edge.
static void range_share(const Roughness *rough, const Corners *c, const Lanes *billow,
                        const Lanes *wisp, DetailRange small, Lanes *restrict share)
{
    const Roughness r = *rough;
    for (int i = 0; i < LANES; i++) {
        share->low[i] = 1.0f;
        share->high[i] = 0.0f;
    }
#pragma GCC unroll 8
    for (int k = 0; k < 8; k++) {
        const float *inside = c->inside + corner_offset[k], *soft = c->softness + corner_offset[k];
        const float *billows = c->billows + corner_offset[k];
        const float *per_edge = c->per_edge + corner_offset[k];
#pragma omp simd
        for (int i = 0; i < LANES; i++) {
            float high =
                billows[i] * (r.billow[0] * billow->high[i] + r.billow[1] * small.high.billow) +
                soft[i] * (r.wisp[0] * wisp->high[i] + r.wisp[1] * small.high.wisp);
            float low =
                billows[i] * (r.billow[0] * billow->low[i] + r.billow[1] * small.low.billow) +
                soft[i] * (r.wisp[0] * wisp->low[i] + r.wisp[1] * small.low.wisp);
            float least = unit_clamp((inside[i] + low) * per_edge[i] - ROUNDING);
            float most = unit_clamp((inside[i] + high) * per_edge[i] + ROUNDING);
            share->low[i] = smaller(share->low[i], least);
            share->high[i] = larger(share->high[i], most);
        }
    }
}

// ---- bounds in a part ----

// Of the factor that altitude decides, or depth.
static Extremes gain_between(const CloudGrid *g, float below, float above, Extremes inside)
{
    if (g->pooled) { // which depth decides
        return (Extremes){below > 0.0f ? gain_at(g, 0.0f, inside.low) : 0.0f,
                          gain_at(g, 0.0f, inside.high)};
    }
    float lower = gain_at(g, below, 0.0f), upper = gain_at(g, above, 0.0f);
    if (!g->fog) {
        return (Extremes){lower, upper};
    }
    return (Extremes){below > 0.0f ? upper : 0.0f, lower}; // ends sharply at its base
}

// Rounded outward.
static CloudBounds in_steps(Extremes e)
{
    float low = floorf(larger(e.low - ROUNDING, 0.0f) * CELL_STEPS);
    float high = e.high > 0.0f ? ceilf(smaller(e.high + ROUNDING, 1.0f) * CELL_STEPS) : 0.0f;
    return (CloudBounds){(uint8_t)low, (uint8_t)high};
}

static Extremes in_lane(const Lanes *lanes, int lane)
{
    return (Extremes){lanes->low[lane], lanes->high[lane]};
}

// What bounds the extinction in each part of a cell.
typedef struct CellLanes {
    Lanes inside, softness, ice, share;
    Lanes billow, wisp; // of the large detail
    bool droplets[LANES];
} CellLanes;

// Of a part that lies from below to above, m over the base.
static Extremes in_part(const CloudGrid *g, const CellLanes *l, int lane, float below, float above,
                        DetailRange small)
{
    if (!l->droplets[lane] || above <= 0.0f) {
        return (Extremes){0.0f, 0.0f};
    }
    Extremes share = in_lane(&l->share, lane), softness = in_lane(&l->softness, lane);
    Extremes ice = in_lane(&l->ice, lane), wisp = in_lane(&l->wisp, lane);
    float smooth = 1.0f + wisp.low;
    float torn = 1.0f + wisp.high + RAGGED_SMALL * (1.0f + small.high.wisp);
    Extremes gain = gain_between(g, below, above, in_lane(&l->inside, lane));
    return (Extremes){density_at(share.low, softness.high) * gain.low * ice.low *
                          raised_at(&g->rough, below, torn),
                      density_at(share.high, softness.low) * gain.high * ice.high *
                          raised_at(&g->rough, above, smooth)};
}

// Of part (x, y, z) of the grid.
static Vec3 middle_of_part(const CloudGrid *g, int x, int y, int z)
{
    Vec3 places = vec3((float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f);
    return vec3_madd(g->low, g->voxel / PART_STEPS, places);
}

// The large detail in a cell's parts: everywhere's, where it changes nothing.
static void range_detail(const CloudGrid *g, const int cell[3], const bool changed[LANES],
                         CellLanes *l)
{
    const float side = g->voxel / PART_STEPS;
    const DetailRange whole = detail_range_whole(g->detail);
    memset(&l->billow, 0, sizeof l->billow);
    memset(&l->wisp, 0, sizeof l->wisp);
    for (int i = 0; i < PARTS * PARTS * PARTS; i++) {
        int x = i / PARTS % PARTS, y = i % PARTS, z = i / (PARTS * PARTS), lane = lane_of(x, y, z);
        Vec3 middle =
            middle_of_part(g, cell[0] * PARTS + x, cell[1] * PARTS + y, cell[2] * PARTS + z);
        float below = middle.y - 0.5f * side - g->base;
        bool reached = changed[lane] || below < RAGGED_UP_TO * g->rough.base;
        bool asked = l->droplets[lane] && below + side > 0.0f && reached;
        DetailRange large = asked ? large_around(g, middle, side) : whole;
        l->billow.low[lane] = large.low.billow;
        l->billow.high[lane] = large.high.billow;
        l->wisp.low[lane] = large.low.wisp;
        l->wisp.high[lane] = large.high.wisp;
    }
}

static void describe_cell(const CloudGrid *g, const int cell[3], DetailRange small, CellLanes *l)
{
    Corners c;
    bool changed[LANES];
    interpolate(g, cell[0], cell[1], cell[2], &c);
    find_touched(&c, l->droplets, changed);
    range_detail(g, cell, changed, l);
    range_plane(c.inside, &l->inside);
    range_plane(c.softness, &l->softness);
    range_plane(c.share, &l->ice);
    range_share(&g->rough, &c, &l->billow, &l->wisp, small, &l->share);
}

// Fills the bounds of a cell's parts; returns those of the cell.
static CloudBounds fill_parts(const CloudGrid *g, const int cell[3], DetailRange small,
                              CloudBounds part[])
{
    CellLanes l;
    describe_cell(g, cell, small, &l);
    const float side = g->voxel / PART_STEPS;
    CloudBounds all = {CELL_STEPS, 0};
    for (int i = 0; i < PARTS * PARTS * PARTS; i++) {
        int x = i / PARTS % PARTS, y = i % PARTS, z = i / (PARTS * PARTS);
        float below = middle_of_part(g, 0, cell[1] * PARTS + y, 0).y - 0.5f * side - g->base;
        Extremes e = in_part(g, &l, lane_of(x, y, z), below, below + side, small);
        part[i] = in_steps(e);
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
    g->part = memory_alloc_wide(count > 0 ? count : 1, sizeof *g->part * PARTS * PARTS * PARTS, e);
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
                    cell->bounds = fill_parts(g, (int[3]){x, y, z}, small, part);
                    bool flat = cell->bounds.most - cell->bounds.least <= FLAT;
                    cell->parts = flat ? -1 : cell->parts;
                }
            }
        }
    }
    cloud_bounds_find_gaps(g);
    return true;
}
