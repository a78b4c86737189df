#include "render/cloud/cloud_grid.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/cloud/puffs.h"

#include <stdlib.h>
#include <string.h>

enum { NODES_ACROSS = 512, FARTHEST = -128 * DISTANCE_STEPS };

static int64_t node_at(const CloudGrid *g, int x, int y, int z)
{
    return ((int64_t)z * g->count[0] + x) * g->count[1] + y;
}

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

static void set_roughness(CloudGrid *g, const Cloud *cloud, const Billow *billow)
{
    bool sheet = cloud->kind == CLOUD_STRATUS;
    float size = cloud->kind == CLOUD_STORM ? 0.5f * cloud->size : cloud->size;
    g->billow = billow;
    g->period[0] = 0.37f * size;
    g->period[1] = 0.071f * size;
    g->height[0] = (sheet ? 0.02f : 0.034f) * size;
    g->height[1] = 0.008f * size;
    g->edge = (sheet ? 0.08f : 0.016f) * size;
    g->frozen = cloud->kind == CLOUD_STORM ? 0.65f : 2.0f;
    g->base = cloud->base;
    g->thickness = cloud->thickness;
    g->extinction = cloud->extinction;
}

// ---- forms ----

static int16_t in_steps(const CloudGrid *g, float distance)
{
    float steps = distance / g->voxel * DISTANCE_STEPS;
    return (int16_t)lrintf(clampf(steps, FARTHEST, -FARTHEST - 1));
}

// Unites a ball with the nodes of slice z. reach: m outside of it that still get a distance.
static void unite(CloudGrid *g, const Puff *puff, int z, float reach)
{
    Vec3 c = vec3_scale(vec3_sub(puff->center, g->low), 1.0f / g->voxel);
    float wide = (puff->radius + reach) / g->voxel;
    float tall = (puff->radius / puff->flatness + reach) / g->voxel;
    int y0 = (int)fmaxf(ceilf(c.y - tall), 0.0f);
    int y1 = (int)fminf(floorf(c.y + tall), (float)g->count[1] - 1.0f);
    for (int x = (int)ceilf(c.x - wide); x <= (int)floorf(c.x + wide); x++) {
        if (!g->repeats && (x < 0 || x >= g->count[0])) {
            continue;
        }
        int16_t *column =
            g->distance + node_at(g, x & (NODES_ACROSS - 1), 0, z & (NODES_ACROSS - 1));
        float dx = (float)x - c.x, dz = (float)z - c.z;
        for (int y = y0; y <= y1; y++) {
            float dy = ((float)y - c.y) * puff->flatness;
            float far = g->voxel * sqrtf(dx * dx + dy * dy + dz * dz);
            int16_t inside = in_steps(g, (puff->radius - far) / puff->flatness);
            column[y] = column[y] > inside ? column[y] : inside;
        }
    }
}

static void fill_with_puffs(CloudGrid *g, const Puffs *puffs, float reach, const Run *run)
{
#pragma omp parallel for schedule(dynamic, 8) num_threads(run->threads)
    for (int slice = 0; slice < g->count[2]; slice++) {
        for (int64_t i = 0; i < puffs->count; i++) {
            const Puff *puff = &puffs->puff[i];
            float wide = (puff->radius + reach) / g->voxel;
            float c = (puff->center.z - g->low.z) / g->voxel;
            int z = slice; // the slice itself, or where it repeats near the ball
            if (g->repeats) {
                z += NODES_ACROSS * (int)lrintf((c - (float)slice) / NODES_ACROSS);
            }
            if (fabsf((float)z - c) <= wide) {
                unite(g, puff, z, reach);
            }
        }
    }
}

// Rolls of a sheet, about -1 .. 1, at a place in shares of the period.
static float rolls(const CloudGrid *g, float x, float z)
{
    float slow = billow_at(g->billow, vec3(x, 0.3f, z));
    return 0.7f * slow + 0.3f * billow_at(g->billow, vec3(4.0f * x, 0.7f, 4.0f * z));
}

static int compare_floats(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

// The height of rolls above which a share `cover` of the sheet lies.
static float rolls_cut(const CloudGrid *g, float cover)
{
    enum { SAMPLES = 64 };
    float value[SAMPLES * SAMPLES];
    for (int i = 0; i < SAMPLES * SAMPLES; i++) {
        int x = i % SAMPLES, z = i / SAMPLES;
        value[i] = rolls(g, (float)x / SAMPLES, (float)z / SAMPLES);
    }
    qsort(value, SAMPLES * SAMPLES, sizeof value[0], compare_floats);
    int index = (int)((1.0f - cover) * SAMPLES * SAMPLES);
    return cover >= 1.0f ? -2.0f : value[index < SAMPLES * SAMPLES ? index : SAMPLES * SAMPLES - 1];
}

static void fill_with_sheet(CloudGrid *g, const Cloud *cloud, const Run *run)
{
    float cut = rolls_cut(g, cloud->cover);
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < g->count[2]; z++) {
        for (int x = 0; x < g->count[0]; x++) {
            float roll = rolls(g, (float)x / NODES_ACROSS, (float)z / NODES_ACROSS);
            float rise = clampf((roll - cut) / 0.5f, -1.0f, 1.0f);
            float top =
                cloud->base + cloud->thickness * (rise > 0.0f ? 0.25f + 0.75f * rise : rise);
            for (int y = 0; y < g->count[1]; y++) {
                float altitude = g->low.y + g->voxel * (float)y;
                float inside =
                    fminf(top - altitude, altitude - cloud->base + 0.2f * cloud->thickness);
                g->distance[node_at(g, x, y, z)] = in_steps(g, inside);
            }
        }
    }
}

static bool fill_with_heaps(CloudGrid *g, const Cloud *cloud, float reach, uint64_t key,
                            const Run *run, Error *e)
{
    Puffs puffs = {0};
    float smallest = 0.8f * g->voxel;
    bool done = cloud->kind == CLOUD_STORM
                    ? puffs_grow_storm(&puffs, cloud, smallest, key, e)
                    : puffs_grow_cumulus(&puffs, cloud, g->voxel * NODES_ACROSS, smallest, key, e);
    if (done) {
        fill_with_puffs(g, &puffs, reach, run);
    }
    puffs_clear(&puffs);
    return done;
}

// ---- bounds ----

// The greatest distance of a brick's nodes, those that it shares with the next bricks included.
static float deepest(const CloudGrid *g, int bx, int by, int bz)
{
    int16_t most = FARTHEST;
    for (int k = 0; k <= BRICK; k++) {
        for (int i = 0; i <= BRICK; i++) {
            int x = bx * BRICK + i, z = bz * BRICK + k;
            x = g->repeats ? x & (NODES_ACROSS - 1) : (x < g->count[0] ? x : g->count[0] - 1);
            z = g->repeats ? z & (NODES_ACROSS - 1) : (z < g->count[2] ? z : g->count[2] - 1);
            const int16_t *column = g->distance + node_at(g, x, 0, z);
            for (int j = 0; j <= BRICK; j++) {
                int y = by * BRICK + j < g->count[1] ? by * BRICK + j : g->count[1] - 1;
                most = most > column[y] ? most : column[y];
            }
        }
    }
    return (float)most * g->voxel / DISTANCE_STEPS;
}

// Droplets grow as air rises: density at an altitude in shares of the thickness.
static float gain_at(float share)
{
    return 0.5f + clampf(share, 0.0f, 0.5f);
}

static void fill_bounds(CloudGrid *g, const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int bz = 0; bz < g->bricks[2]; bz++) {
        for (int bx = 0; bx < g->bricks[0]; bx++) {
            for (int by = 0; by < g->bricks[1]; by++) {
                float top = g->low.y + g->voxel * (float)(BRICK * (by + 1)) - g->base;
                float most = deepest(g, bx, by, bz) + g->height[0] + g->height[1];
                g->bound[((int64_t)bz * g->bricks[0] + bx) * g->bricks[1] + by] =
                    g->extinction * gain_at(top / g->thickness) *
                    clampf(most / g->edge, 0.0f, 1.0f);
            }
        }
    }
}

// All but what lies in memory. Returns how far billows reach, m.
static float describe(CloudGrid *g, const Cloud *cloud, const Billow *billow)
{
    set_roughness(g, cloud, billow);
    float reach = g->height[0] + g->height[1];
    lay_out(g, cloud, reach + g->edge);
    return reach;
}

static int64_t node_count(const CloudGrid *g)
{
    return (int64_t)g->count[0] * g->count[1] * g->count[2];
}

int64_t cloud_grid_bytes(const Cloud *cloud)
{
    CloudGrid grid;
    describe(&grid, cloud, NULL);
    return node_count(&grid) * (int64_t)sizeof *grid.distance;
}

bool cloud_grid_fill(CloudGrid *g, const Cloud *cloud, const Billow *billow, uint64_t key,
                     const Run *run, Error *e)
{
    float reach = describe(g, cloud, billow);
    int64_t nodes = node_count(g);
    if (!memory_check((double)cloud_grid_bytes(cloud), e, "clouds of %d x %d x %d voxels",
                      g->count[0], g->count[1], g->count[2])) {
        return false;
    }
    g->distance = memory_alloc(nodes, sizeof *g->distance, e);
    g->bound = memory_alloc(nodes / (BRICK * BRICK * BRICK), sizeof *g->bound, e);
    if (!g->distance || !g->bound) {
        return false;
    }
    for (int64_t i = 0; i < nodes; i++) {
        g->distance[i] = FARTHEST;
    }
    if (cloud->kind == CLOUD_STRATUS) {
        fill_with_sheet(g, cloud, run);
    } else if (!fill_with_heaps(g, cloud, reach + 2.0f * g->voxel, key, run, e)) {
        return false;
    }
    fill_bounds(g, run);
    return true;
}

void cloud_grid_clear(CloudGrid *g)
{
    free(g->distance);
    free(g->bound);
    g->distance = NULL;
    g->bound = NULL;
}

// ---- looking up ----

// Distance by trilinear interpolation, m; p in voxels from node 0.
static float distance_at(const CloudGrid *g, Vec3 p)
{
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    int x = (int)fx, y = (int)fy, z = (int)fz;
    if (y < 0 || y + 1 >= g->count[1]) {
        return -INFINITY;
    }
    if (!g->repeats && (x < 0 || z < 0 || x + 1 >= g->count[0] || z + 1 >= g->count[2])) {
        return -INFINITY;
    }
    const int wrap = NODES_ACROSS - 1;
    const int16_t *a = g->distance + node_at(g, x & wrap, y, z & wrap);
    const int16_t *b = g->distance + node_at(g, (x + 1) & wrap, y, z & wrap);
    const int16_t *c = g->distance + node_at(g, x & wrap, y, (z + 1) & wrap);
    const int16_t *d = g->distance + node_at(g, (x + 1) & wrap, y, (z + 1) & wrap);
    float u = p.x - fx, v = p.y - fy, w = p.z - fz;
    float near = lerpf(lerpf(a[0], a[1], v), lerpf(b[0], b[1], v), u);
    float far = lerpf(lerpf(c[0], c[1], v), lerpf(d[0], d[1], v), u);
    return lerpf(near, far, w) * g->voxel / DISTANCE_STEPS;
}

float cloud_grid_extinction(const CloudGrid *g, Vec3 p)
{
    float inside = distance_at(g, vec3_scale(vec3_sub(p, g->low), 1.0f / g->voxel));
    if (inside <= -(g->height[0] + g->height[1])) {
        return 0.0f;
    }
    if (inside < g->edge + g->height[0] + g->height[1]) {
        inside += g->height[0] * billow_at(g->billow, vec3_scale(p, 1.0f / g->period[0]));
        if (inside > -g->height[1] && inside < g->edge + g->height[1]) {
            inside += g->height[1] * billow_at(g->billow, vec3_scale(p, 1.0f / g->period[1]));
        }
    }
    float above = p.y - g->base; // condensation begins at one altitude, and gains with height
    inside = fminf(inside, above);
    float share = above / g->thickness;
    float ice = clampf((share - g->frozen) / 0.2f, 0.0f, 1.0f);
    return g->extinction * gain_at(share) *
           clampf(inside / (g->edge * (1.0f + 5.0f * ice)), 0.0f, 1.0f);
}
