#include "render/cloud/cloud_fill.h"

#include "base/random.h"
#include "render/cloud/anvil.h"
#include "render/cloud/ash_plume.h"
#include "render/cloud/heaps.h"
#include "render/cloud/profile.h"
#include "render/cloud/storm.h"

#include <stdlib.h>

static int16_t in_steps(const CloudGrid *g, float distance)
{
    float steps = distance / g->voxel * DISTANCE_STEPS;
    return (int16_t)(int)rintf(clampf(steps, FARTHEST, -FARTHEST - 1)); // vectorizes, unlike lrintf
}

static int16_t in_softness(float softness)
{
    return (int16_t)lrintf(clampf(softness, 0.0f, 1.0f) * SOFTEST);
}

// ---- balls ----

// How far outside of a ball nodes get a distance, m: as if it were as soft as patches may make it.
static float reach_of(const CloudGrid *g)
{
    return fmaxf(reach_at(&g->rough, 0.0f), reach_at(&g->rough, 1.0f)) + g->rough.spread +
           2.0f * g->voxel;
}

// Unites a ball with the nodes of slice z.
static void unite(CloudGrid *g, const Puff *puff, int z)
{
    Vec3 c = vec3_scale(vec3_sub(puff->center, g->low), 1.0f / g->voxel);
    float reach = reach_of(g), wide = (puff->radius + reach) / g->voxel;
    float tall = (puff->radius / puff->flatness + reach) / g->voxel;
    int16_t softness = in_softness(puff->softness);
    const int wrap = g->count[0] - 1;
    int y0 = (int)fmaxf(ceilf(c.y - tall), 0.0f);
    int y1 = (int)fminf(floorf(c.y + tall), (float)g->count[1] - 1.0f);
    for (int x = (int)ceilf(c.x - wide); x <= (int)floorf(c.x + wide); x++) {
        if (!g->repeats && (x < 0 || x >= g->count[0])) {
            continue;
        }
        CloudNode *column = g->node + cloud_grid_node(g, x & wrap, 0, z & wrap);
        float dx = (float)x - c.x, dz = (float)z - c.z;
        for (int y = y0; y <= y1; y++) {
            float dy = ((float)y - c.y) * puff->flatness;
            float far = g->voxel * sqrtf(dx * dx + dy * dy + dz * dz);
            int16_t inside = in_steps(g, (puff->radius - far) / puff->flatness);
            bool deeper = inside > column[y].distance; // stored in any case: this vectorizes
            column[y].distance = deeper ? inside : column[y].distance;
            column[y].softness = deeper ? softness : column[y].softness;
        }
    }
}

static void fill_with_puffs(CloudGrid *g, const Puffs *puffs, const Run *run)
{
#pragma omp parallel for schedule(dynamic, 8) num_threads(run->threads)
    for (int slice = 0; slice < g->count[2]; slice++) {
        for (int64_t i = 0; i < puffs->count; i++) {
            const Puff *puff = &puffs->puff[i];
            float wide = (puff->radius + reach_of(g)) / g->voxel;
            float c = (puff->center.z - g->low.z) / g->voxel;
            int z = slice; // the slice itself, or where it repeats near the ball
            if (g->repeats) {
                z += g->count[2] * (int)lrintf((c - (float)slice) / (float)g->count[2]);
            }
            if (fabsf((float)z - c) <= wide) {
                unite(g, puff, z);
            }
        }
    }
}

// Unites the anvil with the towers; where it is, and in their upper part, droplets are frozen.
static void add_anvil(CloudGrid *g, const Cloud *cloud, uint64_t key, const Run *run)
{
    Anvil anvil = anvil_of(cloud, g->detail, key);
    float margin = reach_of(g);
#pragma omp parallel for schedule(dynamic, 8) num_threads(run->threads)
    for (int z = 0; z < g->count[2]; z++) {
        for (int x = 0; x < g->count[0]; x++) {
            AnvilColumn c = anvil_column(&anvil, g->low.x + g->voxel * (float)x,
                                         g->low.z + g->voxel * (float)z);
            int64_t first = cloud_grid_node(g, x, 0, z);
            for (int y = 0; y < g->count[1]; y++) {
                float altitude = g->low.y + g->voxel * (float)y, deep = anvil_depth(&c, altitude);
                CloudNode *node = &g->node[first + y];
                float share = storm_freezing(&anvil.frame, altitude);
                if (deep > -margin && in_steps(g, deep) > node->distance) {
                    *node = (CloudNode){in_steps(g, deep), in_softness(c.softness)};
                    share = anvil_share(&anvil, &c, altitude);
                }
                g->ice[first + y] = (uint8_t)lrintf(clampf(share, 0.0f, 1.0f) * ICE_STEPS);
            }
        }
    }
}

// The ash of a plume is the thinner the more air it has taken in.
static void thin_plume(CloudGrid *g, const Cloud *cloud, const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < g->count[2]; z++) {
        for (int x = 0; x < g->count[0]; x++) {
            int64_t first = cloud_grid_node(g, x, 0, z);
            for (int y = 0; y < g->count[1]; y++) {
                Vec3 p = vec3_madd(g->low, g->voxel, vec3((float)x, (float)y, (float)z));
                g->ice[first + y] = (uint8_t)lrintf(ash_plume_share(cloud, p) * ICE_STEPS);
            }
        }
    }
}

static bool grow_balls(Puffs *puffs, const CloudGrid *g, const Cloud *cloud, uint64_t key, Error *e)
{
    switch (cloud->kind) {
    case CLOUD_STORM:
        return storm_grow(puffs, cloud, key, e);
    case CLOUD_PLUME:
        return ash_plume_grow(puffs, cloud, key, e);
    default:
        return heaps_grow(puffs, cloud, g->voxel * (float)g->count[0], key, e);
    }
}

// Softer and firmer patches: eddies bring dry air to some places of a border and not to others.
static void add_patches(CloudGrid *g, const Cloud *cloud, const Run *run)
{
    const float often = 8.0f / (float)g->count[0], most = 0.8f; // periods of the detail a node
#pragma omp parallel for schedule(dynamic, 8) num_threads(run->threads)
    for (int z = 0; z < g->count[2]; z++) {
        for (int x = 0; x < g->count[0]; x++) {
            CloudNode *column = g->node + cloud_grid_node(g, x, 0, z);
            for (int y = 0; y < g->count[1]; y++) {
                if (column[y].distance == FARTHEST) {
                    continue;
                }
                Vec3 p = vec3((float)x, (float)y, (float)z);
                float wisp = detail_at(g->detail, vec3_scale(p, often)).wisp;
                float soft = (float)column[y].softness / SOFTEST;
                soft = puffs_worn(soft, most * cloud->softness * wisp);
                float inside = (float)column[y].distance * g->voxel / DISTANCE_STEPS;
                column[y] =
                    (CloudNode){in_steps(g, inside + soft * g->rough.spread), in_softness(soft)};
            }
        }
    }
}

static bool fill_with_heaps(CloudGrid *g, const Cloud *cloud, uint64_t key, const Run *run,
                            Error *e)
{
    Puffs puffs = {.floor = cloud->base, .smallest = 0.8f * g->voxel};
    bool done = grow_balls(&puffs, g, cloud, key, e);
    if (done) {
        fill_with_puffs(g, &puffs, run);
        if (cloud->kind == CLOUD_STORM) {
            add_anvil(g, cloud, random_key(key, 0xa11), run);
        } else if (cloud->kind == CLOUD_PLUME) {
            thin_plume(g, cloud, run);
        }
        add_patches(g, cloud, run);
    }
    puffs_clear(&puffs);
    return done;
}

// ---- a sheet ----

// Rolls of a sheet, about -1 .. 1, at a place in shares of the period.
static float rolls(const CloudGrid *g, float x, float z)
{
    Detail slow = detail_at(g->detail, vec3(x, 0.3f, z));
    Detail fast = detail_at(g->detail, vec3(3.0f * x, 0.7f, 3.0f * z));
    return 0.35f * slow.billow + 0.35f * slow.wisp + 0.3f * fast.billow;
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
    const float across = (float)g->count[0];
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < g->count[2]; z++) {
        for (int x = 0; x < g->count[0]; x++) {
            float roll = rolls(g, (float)x / across, (float)z / across);
            float rise = clampf((roll - cut) / 0.5f, -1.0f, 1.0f);
            float top =
                cloud->base + cloud->thickness * (rise > 0.0f ? 0.25f + 0.75f * rise : rise);
            int16_t softness = in_softness(0.6f - 0.5f * rise);
            for (int y = 0; y < g->count[1]; y++) {
                float altitude = g->low.y + g->voxel * (float)y;
                float inside =
                    fminf(top - altitude, altitude - cloud->base + 0.2f * cloud->thickness);
                g->node[cloud_grid_node(g, x, y, z)] = (CloudNode){in_steps(g, inside), softness};
            }
        }
    }
}

// ---- fog ----

// Height of the top over the base in shares of the thickness, at a place in shares of the period;
// negative in holes. The top swells and sinks like a sea; toward holes it slopes down.
static float fog_top(const CloudGrid *g, float cut, float x, float z, float *softness)
{
    Detail swell = detail_at(g->detail, vec3(x, 0.9f, z));
    Detail ripple = detail_at(g->detail, vec3(2.0f * x, 0.1f, 4.0f * z));
    float rise = clampf((rolls(g, x, z) - cut) / 0.35f, -1.0f, 1.0f);
    float left = 1.0f - rise;
    float bank = rise > 0.0f ? 1.0f - left * left * left : rise;
    float waves = clampf(0.6f * swell.wisp + 0.4f * ripple.wisp, -1.0f, 1.0f);
    *softness = clampf(0.5f + 0.6f * swell.billow, 0.2f, 0.85f); // patches of wisps, and of heads
    *softness = rise > 0.0f ? lerpf(0.9f, *softness, rise) : 0.9f;
    return bank > 0.0f ? bank * (0.85f + 0.15f * waves) : bank;
}

// Places of swells and holes from places in shares of the period: by whole numbers, so that the
// pattern still fits the period. Wind draws it out along its way.
typedef struct Drawn {
    float x[2], z[2];
} Drawn;

static Drawn drawn_out(const CloudGrid *g, const Cloud *cloud)
{
    float across = fmaxf(rintf(g->voxel * (float)g->count[0] / (16.0f * cloud->size)), 1.0f);
    if (cloud->drift <= 0.0f) {
        float often = g->pooled ? across : 1.0f;
        return (Drawn){{often, 0.0f}, {0.0f, often}};
    }
    float wind = cloud->wind * RADIANS_PER_DEGREE, s = sinf(wind), c = cosf(wind);
    float narrow = 1.0f + 3.0f * cloud->drift; // how much longer than wide swells become
    float along = (g->pooled ? across : 1.0f) * (narrow > 2.0f ? 0.5f * narrow : 1.0f);
    float aside = along * narrow;
    Drawn d = {{rintf(along * s), rintf(along * c)}, {rintf(aside * c), -rintf(aside * s)}};
    if (d.x[0] * d.z[1] == d.x[1] * d.z[0]) { // rounded to waves in one direction
        d.x[fabsf(s) > fabsf(c) ? 0 : 1] += 1.0f;
    }
    return d;
}

// Altitude of the level that the fog lies on, at a node.
static float floor_at(const CloudFloor *floor, float voxel, int x, int z)
{
    float at[2] = {voxel * (float)x / floor->cell, voxel * (float)z / floor->cell};
    float last = (float)(floor->side - 1);
    int low[2];
    for (int i = 0; i < 2; i++) { // the period holds the square, then its mirror image
        at[i] = at[i] > last ? 2.0f * last - at[i] : at[i];
        low[i] = (int)clampf(at[i], 0.0f, last - 1.0f);
        at[i] -= (float)low[i];
    }
    const float *near = floor->height + (int64_t)low[1] * floor->side + low[0];
    const float *far = near + floor->side;
    return lerpf(lerpf(near[0], near[1], at[0]), lerpf(far[0], far[1], at[0]), at[1]);
}

static void fill_with_fog(CloudGrid *g, const Cloud *cloud, const Run *run)
{
    float cut = rolls_cut(g, cloud->cover);
    Drawn d = drawn_out(g, cloud);
    const float across = (float)g->count[0];
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < g->count[2]; z++) {
        for (int x = 0; x < g->count[0]; x++) {
            float u = (float)x / across, v = (float)z / across, soft;
            float share = fog_top(g, cut, d.x[0] * u + d.x[1] * v, d.z[0] * u + d.z[1] * v, &soft);
            float floor = g->pooled ? floor_at(cloud->floor, g->voxel, x, z) : cloud->base;
            float top = floor + cloud->thickness * share;
            for (int y = 0; y < g->count[1]; y++) {
                float inside = top - (g->low.y + g->voxel * (float)y);
                float deep = clampf(2.0f * inside / cloud->thickness, 0.0f, 1.0f);
                g->node[cloud_grid_node(g, x, y, z)] =
                    (CloudNode){in_steps(g, inside), in_softness(soft * (1.0f - deep))};
            }
        }
    }
}

bool cloud_fill(CloudGrid *g, const Cloud *cloud, uint64_t key, const Run *run, Error *e)
{
    if (cloud->kind == CLOUD_STRATUS) {
        fill_with_sheet(g, cloud, run);
        return true;
    }
    if (cloud->kind == CLOUD_FOG) {
        fill_with_fog(g, cloud, run);
        return true;
    }
    return fill_with_heaps(g, cloud, key, run, e);
}
