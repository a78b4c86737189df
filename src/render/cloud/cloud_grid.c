#include "render/cloud/cloud_grid.h"

#include "base/memory.h"
#include "render/cloud/ash_plume.h"
#include "render/cloud/cloud_bounds.h"
#include "render/cloud/cloud_fill.h"
#include "render/cloud/cloud_voxels.h"
#include "render/cloud/profile.h"
#include "shape/sparse_volume.h"

#include <stdlib.h>

// ---- layout ----

static int up_to_cells(float nodes)
{
    return ((int)nodes / CELL + 1) * CELL;
}

// The least power of two that is at least the cloud's resolution.
static int nodes_across(const Cloud *cloud)
{
    int nodes = CELL;
    while (nodes < cloud->resolution) {
        nodes *= 2;
    }
    return nodes;
}

static void lay_out_on_floor(CloudGrid *g, const Cloud *cloud, float margin)
{
    const CloudFloor *floor = cloud->floor;
    float side = floor->cell * (float)(floor->side - 1);
    g->repeats = g->fog = g->pooled = true;
    g->count[0] = g->count[2] = nodes_across(cloud);
    g->voxel = (floor->periodic ? side : 2.0f * side) / (float)g->count[0];
    g->base = floor->least - margin;
    g->low = vec3(floor->x, g->base, floor->z);
    float tall = floor->most - floor->least + 1.25f * cloud->thickness + 3.0f * margin;
    g->count[1] = up_to_cells(tall / g->voxel);
}

// One cloud at its place, whose density varies by more than height (CloudGrid.ice).
static bool stands_alone(const Cloud *cloud)
{
    return cloud->kind == CLOUD_STORM || cloud->kind == CLOUD_PLUME;
}

static void lay_out_plume(CloudGrid *g, const Cloud *cloud, float margin)
{
    Aabb box = ash_plume_box(cloud);
    Vec3 size = vec3_sub(box.high, box.low);
    g->repeats = false;
    g->fog = true; // densest at the vent
    g->count[0] = g->count[2] = nodes_across(cloud);
    g->voxel = (fmaxf(size.x, size.z) + 2.0f * margin) / (float)g->count[0];
    float across = g->voxel * (float)g->count[0];
    g->low = vec3(0.5f * (box.low.x + box.high.x - across), cloud->base - margin,
                  0.5f * (box.low.z + box.high.z - across));
    g->count[1] = up_to_cells((size.y + 2.0f * margin) / g->voxel);
}

static void lay_out(CloudGrid *g, const Cloud *cloud, float margin)
{
    float across = clampf(16.0f * cloud->size, 2000.0f, 40000.0f);
    g->repeats = !stands_alone(cloud);
    g->fog = cloud->kind == CLOUD_FOG;
    if (!g->repeats) {
        across = 7.0f * cloud->size;
    }
    g->count[0] = g->count[2] = nodes_across(cloud);
    g->voxel = across / (float)g->count[0];
    g->low = vec3(0.0f, cloud->base - margin, 0.0f);
    if (!g->repeats) { // most of the anvil lies downwind
        float wind = cloud->wind * RADIANS_PER_DEGREE, ahead = 1.25f * cloud->size - 0.5f * across;
        g->low.x = cloud->center_x - 0.5f * across + (ahead + 0.5f * across) * sinf(wind);
        g->low.z = cloud->center_z - 0.5f * across + (ahead + 0.5f * across) * cosf(wind);
    }
    g->count[1] = up_to_cells((1.25f * cloud->thickness + 2.0f * margin) / g->voxel);
}

static Roughness roughness_of(const Cloud *cloud)
{
    float size = cloud->kind == CLOUD_STORM ? 0.5f * cloud->size : cloud->size;
    size = cloud->kind == CLOUD_PLUME ? ash_plume_billow(cloud) : size;
    float torn = fminf(2.0f * cloud->softness, 1.0f);
    Roughness r = {.period = {0.62f * size, 0.097f * size},
                   .billow = {0.05f * size, 0.011f * size},
                   .wisp = {lerpf(0.07f, 0.09f, torn) * size, lerpf(0.03f, 0.04f, torn) * size},
                   .edge = {0.008f * size, lerpf(0.11f, 0.09f, torn) * size},
                   .spread = 0.022f * torn * size,
                   .base = 0.02f * size};
    if (cloud->kind == CLOUD_STRATUS) {
        r.billow[0] = 0.02f * size;
        r.wisp[0] = 0.03f * size;
        r.edge[0] = 0.04f * size;
    }
    if (cloud->kind == CLOUD_FOG) { // lies calm below the inversion
        r.billow[0] = 0.03f * size;
        r.wisp[0] = 0.05f * size;
        r.edge[0] = 0.02f * size;
        r.base = 0.0f;
    }
    if (cloud->kind == CLOUD_PLUME) { // begins at the vent, without a level base
        r.base = 0.0f;
    }
    return r;
}

// All but what lies in memory.
static void describe(CloudGrid *g, const Cloud *cloud, const DetailNoise *detail)
{
    g->rough = roughness_of(cloud);
    g->detail = detail;
    g->base = cloud->base;
    g->thickness = cloud->thickness;
    g->extinction = cloud->extinction;
    g->pooled = false;
    if (cloud->floor) {
        lay_out_on_floor(g, cloud, reach_at(&g->rough, 1.0f));
    } else if (cloud->kind == CLOUD_PLUME) {
        lay_out_plume(g, cloud, reach_at(&g->rough, 1.0f));
    } else {
        lay_out(g, cloud, reach_at(&g->rough, 1.0f));
    }
    for (int i = 0; i < 3; i++) {
        g->cells[i] = g->count[i] / CELL;
    }
}

// ---- contents ----

static int64_t node_count(const CloudGrid *g)
{
    return (int64_t)g->count[0] * g->count[1] * g->count[2];
}

int64_t cloud_grid_bytes(const Cloud *cloud)
{
    if (cloud_has_voxels(cloud)) {
        return cloud_voxels_bytes(cloud);
    }
    CloudGrid grid;
    describe(&grid, cloud, NULL);
    int64_t ice = stands_alone(cloud) ? (int64_t)sizeof *grid.ice : 0;
    return node_count(&grid) * ((int64_t)sizeof *grid.node + ice) +
           cloud_grid_cells(&grid) * (int64_t)sizeof *grid.cell +
           cloud_grid_cells(&grid) / 3 * (grid.pooled ? 2 : 1) * (int64_t)sizeof *grid.part *
               PARTS * PARTS * PARTS;
}

bool cloud_grid_new(CloudGrid *g, const Cloud *cloud, const DetailNoise *detail, uint64_t key,
                    const Run *run, Error *e)
{
    if (cloud_has_voxels(cloud)) {
        return cloud_voxels_new(g, cloud, run, e);
    }
    describe(g, cloud, detail);
    int64_t nodes = node_count(g);
    if (!memory_check((double)cloud_grid_bytes(cloud), e, "clouds of %d x %d x %d voxels",
                      g->count[0], g->count[1], g->count[2])) {
        return false;
    }
    g->node = memory_alloc_wide(nodes, sizeof *g->node, e);
    g->cell = memory_alloc_wide(cloud_grid_cells(g), sizeof *g->cell, e);
    if (stands_alone(cloud)) {
        g->ice = memory_alloc_zero(nodes, sizeof *g->ice, e);
    }
    if (!g->node || !g->cell || (stands_alone(cloud) && !g->ice)) {
        return false;
    }
    for (int64_t i = 0; i < nodes; i++) {
        g->node[i] = (CloudNode){.distance = FARTHEST};
    }
    return cloud_fill(g, cloud, key, run, e) && cloud_bounds_fill(g, run, e);
}

void cloud_grid_clear(CloudGrid *g)
{
    free(g->node);
    free(g->ice);
    free(g->cell);
    free(g->part);
    sparse_volume_free(g->voxels);
    g->voxels = NULL;
    g->node = NULL;
    g->ice = NULL;
    g->cell = NULL;
    g->part = NULL;
}

// ---- looking up ----

// The coarse form at a place.
typedef struct Coarse {
    float inside, softness; // m
    float share;            // of the greatest extinction, where ice takes the droplets' place
} Coarse;

static Coarse between(CloudNode a, CloudNode b, float t)
{
    return (Coarse){lerpf(a.distance, b.distance, t), lerpf(a.softness, b.softness, t), 1.0f};
}

static Coarse mix(Coarse a, Coarse b, float t)
{
    return (Coarse){lerpf(a.inside, b.inside, t), lerpf(a.softness, b.softness, t), 1.0f};
}

// By trilinear interpolation between nodes, column by column.
static float ice_at(const int64_t column[4], const uint8_t *ice, float u, float v, float w)
{
    float at[4];
    for (int i = 0; i < 4; i++) {
        at[i] = lerpf(ice[column[i]], ice[column[i] + 1], v);
    }
    return lerpf(lerpf(at[0], at[1], u), lerpf(at[2], at[3], u), w) / ICE_STEPS;
}

// By trilinear interpolation; p in voxels from node 0.
static Coarse coarse_at(const CloudGrid *g, Vec3 p)
{
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    int x = (int)fx, y = (int)fy, z = (int)fz;
    if (y < 0 || y + 1 >= g->count[1]) {
        return (Coarse){-INFINITY, 0.0f, 0.0f};
    }
    if (!g->repeats && (x < 0 || z < 0 || x + 1 >= g->count[0] || z + 1 >= g->count[2])) {
        return (Coarse){-INFINITY, 0.0f, 0.0f};
    }
    const int wrap = g->count[0] - 1;
    const int64_t column[4] = {cloud_grid_node(g, x & wrap, y, z & wrap),
                               cloud_grid_node(g, (x + 1) & wrap, y, z & wrap),
                               cloud_grid_node(g, x & wrap, y, (z + 1) & wrap),
                               cloud_grid_node(g, (x + 1) & wrap, y, (z + 1) & wrap)};
    const CloudNode *a = g->node + column[0], *b = g->node + column[1];
    const CloudNode *c = g->node + column[2], *d = g->node + column[3];
    float u = p.x - fx, v = p.y - fy, w = p.z - fz;
    Coarse near = mix(between(a[0], a[1], v), between(b[0], b[1], v), u);
    Coarse far = mix(between(c[0], c[1], v), between(d[0], d[1], v), u);
    Coarse sum = mix(near, far, w);
    return (Coarse){sum.inside * g->voxel / DISTANCE_STEPS, sum.softness / SOFTEST,
                    g->ice ? ice_at(column, g->ice, u, v, w) : 1.0f};
}

const Vec3 cloud_grid_turned_cube = {1.64f, 1.72f, 1.4f};

Vec3 cloud_grid_turned(Vec3 p)
{
    return vec3(0.8f * p.x + 0.36f * p.y + 0.48f * p.z, -0.6f * p.x + 0.48f * p.y + 0.64f * p.z,
                -0.8f * p.y + 0.6f * p.z);
}

// Extinction where detail has moved the border: inside and ragged (0 .. 2 + 2 RAGGED_SMALL) are
// what it makes.
static float profile(const CloudGrid *g, float above, const Coarse *c, float inside, float ragged)
{
    const Roughness *r = &g->rough;
    float share = unit_clamp(inside / edge_at(r, c->softness));
    return g->extinction * c->share * gain_at(g, above, c->inside) * raised_at(r, above, ragged) *
           density_at(share, c->softness);
}

// A lookup in stages, each of which leaves less of the detail open.
typedef struct Lookup {
    Coarse coarse;
    float above;  // m over the base
    float inside; // m: of the border as far as it is known
    float open;   // m: farthest that what is not looked up yet moves it
    float ragged;
} Lookup;

static Lookup lookup_begin(const CloudGrid *g, Vec3 p)
{
    Coarse c = coarse_at(g, vec3_scale(vec3_sub(p, g->low), 1.0f / g->voxel));
    return (Lookup){.coarse = c,
                    .above = p.y - g->base,
                    .inside = c.inside,
                    .open = reach_at(&g->rough, c.softness)};
}

// Whether the border's detail makes no difference to the extinction.
static bool decided(const CloudGrid *g, const Lookup *l)
{
    bool inner = l->inside >= edge_at(&g->rough, l->coarse.softness) + l->open;
    return l->inside <= -l->open || (inner && l->above >= RAGGED_UP_TO * g->rough.base);
}

static void look_up_large(const CloudGrid *g, Vec3 q, Lookup *l)
{
    const Roughness *r = &g->rough;
    float s = l->coarse.softness, billows = billows_at(s);
    Detail large = detail_at(g->detail, vec3_scale(q, 1.0f / r->period[0]));
    l->inside += billows * r->billow[0] * large.billow + s * r->wisp[0] * large.wisp;
    l->open = billows * r->billow[1] + s * r->wisp[1];
    l->ragged = 1.0f + large.wisp;
}

static void look_up_small(const CloudGrid *g, Vec3 q, Lookup *l)
{
    const Roughness *r = &g->rough;
    float s = l->coarse.softness;
    if (l->inside > -l->open && l->inside < edge_at(r, s) + l->open) {
        Detail small = detail_at(g->detail, vec3_scale(q, 1.0f / r->period[1]));
        l->inside += billows_at(s) * r->billow[1] * small.billow + s * r->wisp[1] * small.wisp;
        l->ragged += RAGGED_SMALL * (1.0f + small.wisp);
    }
    l->open = 0.0f;
}

float cloud_grid_extinction(const CloudGrid *g, Vec3 p, bool fine)
{
    if (g->voxels) {
        return cloud_voxels_extinction(g, p);
    }
    if (p.y <= g->base) {
        return 0.0f;
    }
    Lookup l = lookup_begin(g, p);
    if (!decided(g, &l)) {
        Vec3 q = cloud_grid_turned(p);
        look_up_large(g, q, &l);
        if (fine) {
            look_up_small(g, q, &l);
        }
    }
    return profile(g, l.above, &l.coarse, l.inside, l.ragged);
}

// 1 or 0 where what is open cannot change it, else -1. gain: greatest extinction at the altitude.
static int told(const CloudGrid *g, const Lookup *l, float gain, float level)
{
    float scale = 1.0f / edge_at(&g->rough, l->coarse.softness);
    float high = unit_clamp((l->inside + l->open) * scale);
    float low = unit_clamp((l->inside - l->open) * scale);
    if (gain * density_at(high, l->coarse.softness) <= level) {
        return 0;
    }
    bool level_base = l->above >= RAGGED_UP_TO * g->rough.base;
    return level_base && gain * density_at(low, l->coarse.softness) > level ? 1 : -1;
}

bool cloud_grid_exceeds(const CloudGrid *g, Vec3 p, bool fine, float level)
{
    if (g->voxels) {
        return cloud_voxels_extinction(g, p) > level;
    }
    if (p.y <= g->base) {
        return false;
    }
    Lookup l = lookup_begin(g, p);
    float gain = g->extinction * l.coarse.share * gain_at(g, l.above, l.coarse.inside);
    int known = told(g, &l, gain, level);
    if (known < 0 && !decided(g, &l)) {
        Vec3 q = cloud_grid_turned(p);
        look_up_large(g, q, &l);
        l.open = fine ? l.open : 0.0f;
        known = told(g, &l, gain, level);
        if (known < 0 && fine) {
            look_up_small(g, q, &l);
        }
    }
    return known >= 0 ? known : profile(g, l.above, &l.coarse, l.inside, l.ragged) > level;
}

float cloud_grid_smooth(const CloudGrid *g, Vec3 p)
{
    if (g->voxels) {
        return cloud_voxels_extinction(g, p);
    }
    float above = p.y - g->base;
    Coarse c = coarse_at(g, vec3_scale(vec3_sub(p, g->low), 1.0f / g->voxel));
    float s = c.softness, reach = (1.0f - s) * g->rough.billow[0];
    if (above <= 0.0f || c.inside <= -reach) {
        return 0.0f;
    }
    Detail large =
        detail_at(g->detail, vec3_scale(cloud_grid_turned(p), 1.0f / g->rough.period[0]));
    return profile(g, above, &c, c.inside + reach * large.billow, 1.4f);
}
