#include "render/cloud/cloud_grid.h"

#include "base/memory.h"
#include "render/cloud/cloud_fill.h"

#include <stdlib.h>

// Where the border is soft, billows are lower, and droplets fewer: dry air is mixed in.
static const float SOFT_BILLOWS = 0.4f, SOFT_DENSITY = 0.45f;

// ---- layout ----

static int up_to_bricks(float nodes)
{
    return ((int)nodes / BRICK + 1) * BRICK;
}

static void lay_out(CloudGrid *g, const Cloud *cloud, float margin)
{
    float across = clampf(16.0f * cloud->size, 2000.0f, 40000.0f);
    g->repeats = cloud->kind != CLOUD_STORM;
    if (!g->repeats) {
        across = 9.0f * cloud->size;
    }
    g->voxel = across / NODES_ACROSS;
    g->low = vec3(0.0f, cloud->base - margin, 0.0f);
    if (!g->repeats) { // most of the anvil lies downwind
        float wind = cloud->wind * RADIANS_PER_DEGREE, ahead = 1.2f * cloud->size - 0.5f * across;
        g->low.x = cloud->center_x - 0.5f * across + (ahead + 0.5f * across) * sinf(wind);
        g->low.z = cloud->center_z - 0.5f * across + (ahead + 0.5f * across) * cosf(wind);
    }
    g->count[0] = g->count[2] = NODES_ACROSS;
    g->count[1] = up_to_bricks((1.25f * cloud->thickness + 2.0f * margin) / g->voxel);
    for (int i = 0; i < 3; i++) {
        g->bricks[i] = g->count[i] / BRICK;
    }
}

static Roughness roughness_of(const Cloud *cloud)
{
    float size = cloud->kind == CLOUD_STORM ? 0.5f * cloud->size : cloud->size;
    Roughness r = {.period = {0.62f * size, 0.097f * size},
                   .billow = {0.05f * size, 0.011f * size},
                   .wisp = {0.07f * size, 0.03f * size},
                   .edge = {0.008f * size, 0.11f * size},
                   .base = 0.02f * size};
    if (cloud->kind == CLOUD_STRATUS) {
        r.billow[0] = 0.02f * size;
        r.wisp[0] = 0.03f * size;
        r.edge[0] = 0.04f * size;
    }
    return r;
}

float cloud_grid_reach(const CloudGrid *g, float softness)
{
    const Roughness *r = &g->rough;
    float billows = 1.0f + softness * (SOFT_BILLOWS - 1.0f);
    return billows * (r->billow[0] + r->billow[1]) + softness * (r->wisp[0] + r->wisp[1]);
}

// All but what lies in memory.
static void describe(CloudGrid *g, const Cloud *cloud, const DetailNoise *detail)
{
    g->rough = roughness_of(cloud);
    g->detail = detail;
    g->base = cloud->base;
    g->thickness = cloud->thickness;
    g->extinction = cloud->extinction;
    lay_out(g, cloud, cloud_grid_reach(g, 1.0f));
}

// ---- profiles ----

// Liquid water grows in proportion to the height above the condensation level; on as many droplets
// as below, so extinction grows like the power 2/3 of it (Brenguier et al. 2000). share: of the
// thickness.
static float gain_at(float share)
{
    float x = clampf(share / 0.25f, 0.0f, 1.0f);
    return sqrtf(x * sqrtf(x));
}

static float edge_at(const Roughness *r, float softness)
{
    return r->edge[0] + softness * (r->edge[1] - r->edge[0]);
}

static float density_limit(float softness)
{
    return 1.0f + softness * (SOFT_DENSITY - 1.0f);
}

// ---- bounds ----

// The greatest density in a brick but for altitude. A quotient of linear functions of distance and
// softness is greatest at a node, of those that the brick shares with the next ones, too.
static float densest(const CloudGrid *g, int bx, int by, int bz)
{
    const int wrap = NODES_ACROSS - 1;
    float most = 0.0f, limit = 0.0f;
    for (int k = 0; k <= BRICK; k++) {
        for (int i = 0; i <= BRICK; i++) {
            int x = bx * BRICK + i, z = bz * BRICK + k;
            x = g->repeats ? x & wrap : (x < g->count[0] ? x : g->count[0] - 1);
            z = g->repeats ? z & wrap : (z < g->count[2] ? z : g->count[2] - 1);
            const CloudNode *column = g->node + cloud_grid_node(g, x, 0, z);
            for (int j = 0; j <= BRICK; j++) {
                int y = by * BRICK + j < g->count[1] ? by * BRICK + j : g->count[1] - 1;
                float softness = (float)column[y].softness / SOFTEST;
                float inside = (float)column[y].distance * g->voxel / DISTANCE_STEPS;
                float share =
                    (inside + cloud_grid_reach(g, softness)) / edge_at(&g->rough, softness);
                most = fmaxf(most, share);
                limit = fmaxf(limit, density_limit(softness));
            }
        }
    }
    return fminf(most, 1.0f) * limit;
}

static void fill_bounds(CloudGrid *g, const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int bz = 0; bz < g->bricks[2]; bz++) {
        for (int bx = 0; bx < g->bricks[0]; bx++) {
            for (int by = 0; by < g->bricks[1]; by++) {
                float top = g->low.y + g->voxel * (float)(BRICK * (by + 1)) - g->base;
                g->bound[((int64_t)bz * g->bricks[0] + bx) * g->bricks[1] + by] =
                    g->extinction * gain_at(top / g->thickness) *
                    clampf(top / g->rough.base, 0.0f, 1.0f) * densest(g, bx, by, bz);
            }
        }
    }
}

static int64_t node_count(const CloudGrid *g)
{
    return (int64_t)g->count[0] * g->count[1] * g->count[2];
}

int64_t cloud_grid_bytes(const Cloud *cloud)
{
    CloudGrid grid;
    describe(&grid, cloud, NULL);
    return node_count(&grid) * (int64_t)sizeof *grid.node;
}

bool cloud_grid_new(CloudGrid *g, const Cloud *cloud, const DetailNoise *detail, uint64_t key,
                    const Run *run, Error *e)
{
    describe(g, cloud, detail);
    int64_t nodes = node_count(g);
    if (!memory_check((double)cloud_grid_bytes(cloud), e, "clouds of %d x %d x %d voxels",
                      g->count[0], g->count[1], g->count[2])) {
        return false;
    }
    g->node = memory_alloc(nodes, sizeof *g->node, e);
    g->bound = memory_alloc(nodes / (BRICK * BRICK * BRICK), sizeof *g->bound, e);
    if (!g->node || !g->bound) {
        return false;
    }
    for (int64_t i = 0; i < nodes; i++) {
        g->node[i] = (CloudNode){.distance = FARTHEST};
    }
    if (!cloud_fill(g, cloud, key, run, e)) {
        return false;
    }
    fill_bounds(g, run);
    return true;
}

void cloud_grid_clear(CloudGrid *g)
{
    free(g->node);
    free(g->bound);
    g->node = NULL;
    g->bound = NULL;
}

// ---- looking up ----

// The coarse form at a place.
typedef struct Coarse {
    float inside, softness; // m
} Coarse;

static Coarse between(CloudNode a, CloudNode b, float t)
{
    return (Coarse){lerpf(a.distance, b.distance, t), lerpf(a.softness, b.softness, t)};
}

static Coarse mix(Coarse a, Coarse b, float t)
{
    return (Coarse){lerpf(a.inside, b.inside, t), lerpf(a.softness, b.softness, t)};
}

// By trilinear interpolation; p in voxels from node 0.
static Coarse coarse_at(const CloudGrid *g, Vec3 p)
{
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    int x = (int)fx, y = (int)fy, z = (int)fz;
    if (y < 0 || y + 1 >= g->count[1]) {
        return (Coarse){-INFINITY, 0.0f};
    }
    if (!g->repeats && (x < 0 || z < 0 || x + 1 >= g->count[0] || z + 1 >= g->count[2])) {
        return (Coarse){-INFINITY, 0.0f};
    }
    const int wrap = NODES_ACROSS - 1;
    const CloudNode *a = g->node + cloud_grid_node(g, x & wrap, y, z & wrap);
    const CloudNode *b = g->node + cloud_grid_node(g, (x + 1) & wrap, y, z & wrap);
    const CloudNode *c = g->node + cloud_grid_node(g, x & wrap, y, (z + 1) & wrap);
    const CloudNode *d = g->node + cloud_grid_node(g, (x + 1) & wrap, y, (z + 1) & wrap);
    float u = p.x - fx, v = p.y - fy, w = p.z - fz;
    Coarse near = mix(between(a[0], a[1], v), between(b[0], b[1], v), u);
    Coarse far = mix(between(c[0], c[1], v), between(d[0], d[1], v), u);
    Coarse sum = mix(near, far, w);
    return (Coarse){sum.inside * g->voxel / DISTANCE_STEPS, sum.softness / SOFTEST};
}

// Turned, so that the period of the detail is along no axis.
static Vec3 turned(Vec3 p)
{
    return vec3(0.8f * p.x + 0.36f * p.y + 0.48f * p.z, -0.6f * p.x + 0.48f * p.y + 0.64f * p.z,
                -0.8f * p.y + 0.6f * p.z);
}

// Extinction where detail has moved the border: inside and ragged (0 .. 2.8) are what it makes.
static float profile(const CloudGrid *g, float above, float inside, float softness, float ragged)
{
    const Roughness *r = &g->rough;
    float share = clampf(inside / edge_at(r, softness), 0.0f, 1.0f);
    float raised = clampf(above / r->base - 0.8f * ragged, 0.0f, 1.0f);
    return g->extinction * gain_at(above / g->thickness) * raised * density_limit(softness) *
           share * lerpf(1.0f, share, softness);
}

float cloud_grid_extinction(const CloudGrid *g, Vec3 p, bool fine)
{
    const Roughness *r = &g->rough;
    float above = p.y - g->base;
    if (above <= 0.0f) {
        return 0.0f;
    }
    Coarse c = coarse_at(g, vec3_scale(vec3_sub(p, g->low), 1.0f / g->voxel));
    float s = c.softness, edge = edge_at(r, s), reach = cloud_grid_reach(g, s);
    if (c.inside <= -reach) {
        return 0.0f;
    }
    float billows = 1.0f + s * (SOFT_BILLOWS - 1.0f), inside = c.inside, ragged = 0.0f;
    if (inside < edge + reach || above < 3.3f * r->base) {
        Vec3 q = turned(p);
        Detail large = detail_at(g->detail, vec3_scale(q, 1.0f / r->period[0]));
        inside += billows * r->billow[0] * large.billow + s * r->wisp[0] * large.wisp;
        ragged = 1.0f + large.wisp;
        float rest = billows * r->billow[1] + s * r->wisp[1];
        if (fine && inside > -rest && inside < edge + rest) {
            Detail small = detail_at(g->detail, vec3_scale(q, 1.0f / r->period[1]));
            inside += billows * r->billow[1] * small.billow + s * r->wisp[1] * small.wisp;
            ragged += 0.4f * (1.0f + small.wisp);
        }
    }
    return profile(g, above, inside, s, ragged);
}

float cloud_grid_smooth(const CloudGrid *g, Vec3 p)
{
    float above = p.y - g->base;
    Coarse c = coarse_at(g, vec3_scale(vec3_sub(p, g->low), 1.0f / g->voxel));
    float s = c.softness, reach = (1.0f - s) * g->rough.billow[0];
    if (above <= 0.0f || c.inside <= -reach) {
        return 0.0f;
    }
    Detail large = detail_at(g->detail, vec3_scale(turned(p), 1.0f / g->rough.period[0]));
    return profile(g, above, c.inside + reach * large.billow, s, 1.4f);
}
