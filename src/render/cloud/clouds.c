#include "render/cloud/clouds.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/cloud/cloud_grid.h"
#include "render/cloud/walk.h"

#include <stdlib.h>

struct CloudSet {
    DetailNoise *detail;
    int count;
    CloudGrid grid[];
};

static void set_albedo(CloudGrid *grid, Vec3 a)
{
    grid->albedo = a;
    grid->scattered = a.x == a.y && a.y == a.z ? a.x : (a.x + a.y + a.z) / 3.0f;
}

CloudSet *clouds_new(const Cloud *cloud, int count, uint64_t seed, const Run *run, Error *e)
{
    CloudSet *clouds = memory_alloc_zero(1, sizeof *clouds + sizeof(CloudGrid) * (size_t)count, e);
    if (!clouds) {
        return NULL;
    }
    uint64_t key = random_key(seed, 0xc10d);
    clouds->detail = detail_new(key, run, e);
    bool done = clouds->detail;
    for (int i = 0; done && i < count; i++) {
        clouds->count++;
        uint64_t own = random_key(random_key(key, (uint64_t)i), (uint64_t)cloud[i].seed);
        done = cloud_grid_new(&clouds->grid[i], &cloud[i], clouds->detail, own, run, e) ||
               error_key(e, "clouds.%d", i);
        set_albedo(&clouds->grid[i], cloud[i].albedo);
    }
    if (!done) {
        clouds_free(clouds);
        return NULL;
    }
    return clouds;
}

void clouds_free(CloudSet *clouds)
{
    if (clouds) {
        for (int i = 0; i < clouds->count; i++) {
            cloud_grid_clear(&clouds->grid[i]);
        }
        detail_free(clouds->detail);
        free(clouds);
    }
}

int64_t clouds_bytes(const Cloud *cloud, int count)
{
    int64_t sum = 0;
    for (int i = 0; i < count; i++) {
        sum += cloud_grid_bytes(&cloud[i]);
    }
    return sum;
}

float clouds_extinction(const CloudSet *clouds, Vec3 p)
{
    float sum = 0.0f;
    for (int i = 0; i < clouds->count; i++) {
        sum += cloud_grid_extinction(&clouds->grid[i], p, true);
    }
    return sum;
}

float clouds_densest(const CloudSet *clouds)
{
    float most = 0.0f;
    for (int i = 0; i < clouds->count; i++) {
        most = fmaxf(most, clouds->grid[i].extinction);
    }
    return most;
}

float clouds_extinction_of(const CloudSet *clouds, int index, Vec3 p)
{
    return cloud_grid_extinction(&clouds->grid[index], p, true);
}

void clouds_samples_of(const CloudSet *clouds, int index, Aabb *box, float *distance)
{
    const CloudGrid *g = &clouds->grid[index];
    *distance = 0.5f * g->voxel; // half the coarse form's, as billows are about that wide
    Vec3 size =
        vec3_scale(vec3((float)g->count[0], (float)g->count[1], (float)g->count[2]), g->voxel);
    Vec3 low = g->low;
    if (g->repeats && !g->pooled) { // around the origin; fog in valleys begins with its land
        low.x -= 0.5f * size.x;
        low.z -= 0.5f * size.z;
    }
    *box = (Aabb){low, vec3_sub(vec3_add(low, size), vec3_splat(*distance))};
}

// ---- tracking ----

static float draw(uint64_t *key)
{
    *key += 0x9e3779b97f4a7c15ull;
    return random_unit(*key);
}

// What extinctions of a cloud count where scattering counts `scale` times.
static float scale_in(const CloudGrid *grid, float scale)
{
    return grid->scattered * scale + (1.0f - grid->scattered);
}

bool clouds_absorb(const CloudSet *clouds, int index)
{
    return clouds->grid[index].scattered < 1.0f;
}

Vec3 clouds_albedo(const CloudSet *clouds, int index, float scale)
{
    const CloudGrid *grid = &clouds->grid[index];
    Vec3 one = vec3_splat(1.0f);
    Vec3 lost = vec3_scale(vec3_sub(one, grid->albedo), 1.0f / scale_in(grid, scale));
    return vec3_max(vec3_sub(one, lost), vec3_splat(0.0f));
}

bool clouds_scatter(const CloudSet *clouds, int index, float scale, float u, Vec3 *weight)
{
    Vec3 albedo = clouds_albedo(clouds, index, scale);
    float most = vec3_largest(albedo);
    *weight = vec3_scale(vec3_mul(*weight, albedo), 1.0f / fmaxf(most, 1e-6f));
    return u < most;
}

// Decomposition tracking (Kutz et al., "Spectral and Decomposition Tracking", SIGGRAPH 2017): what
// a cell has at least collides without a look at the field.
static float collide(const CloudGrid *grid, const CloudRay *ray, float scale, uint64_t *key)
{
    Walk walk;
    if (!walk_begin(&walk, grid, ray, false)) {
        return INFINITY;
    }
    float depth = -logf(1.0f - draw(key)); // to the next tentative collision
    do {
        float bound = walk.most * scale, t = walk.near;
        while (depth < (walk.far - t) * bound) {
            t += depth / bound;
            float level = walk.most * draw(key);
            Vec3 p = vec3_madd(ray->origin, t, ray->direction);
            if (level < walk.least || cloud_grid_exceeds(grid, p, !ray->blurred, level)) {
                return t;
            }
            depth = -logf(1.0f - draw(key));
        }
        depth -= (walk.far - t) * bound;
    } while (walk_on(&walk));
    return INFINITY;
}

// Plays for what is nearly lost: the share becomes 0 or 1.
static float play(float share, uint64_t *key)
{
    return share >= 0.2f ? share : (draw(key) < share ? 1.0f : 0.0f);
}

// Residual ratio tracking: what a cell has at least dims in closed form.
static float pass(const CloudGrid *grid, const CloudRay *ray, float scale, uint64_t *key)
{
    Walk walk;
    if (!walk_begin(&walk, grid, ray, false)) {
        return 1.0f;
    }
    float share = 1.0f, depth = -logf(1.0f - draw(key));
    do {
        float rest = walk.most - walk.least, bound = rest * scale, t = walk.near;
        if (walk.least > 0.0f) {
            share = play(share * expf(-scale * walk.least * (walk.far - t)), key);
        }
        while (share > 0.0f && depth < (walk.far - t) * bound) {
            t += depth / bound;
            Vec3 p = vec3_madd(ray->origin, t, ray->direction);
            float more = cloud_grid_extinction(grid, p, !ray->blurred) - walk.least;
            share = play(share * (1.0f - clampf(more / rest, 0.0f, 1.0f)), key);
            depth = -logf(1.0f - draw(key));
        }
        depth -= (walk.far - t) * bound;
    } while (share > 0.0f && walk_on(&walk));
    return share;
}

// An estimate of the optical depth: what a cell has at least is exact, the rest is looked up at a
// random place of each step. `most` and beyond is as good as infinite.
static float estimate_depth(const CloudGrid *grid, const CloudRay *ray, float scale, float most,
                            uint64_t *key)
{
    const float finest = 0.125f; // depth of a step
    Walk walk;
    if (!walk_begin(&walk, grid, ray, false)) {
        return 0.0f;
    }
    float depth = 0.0f;
    do {
        float length = scale * (walk.far - walk.near), rest = walk.most - walk.least;
        int steps = rest > 0.0f ? 1 + (int)fminf(length * rest / finest, most / finest) : 0;
        depth += length * walk.least;
        for (int k = 0; k < steps; k++) {
            float at = lerpf(walk.near, walk.far, ((float)k + draw(key)) / (float)steps);
            Vec3 p = vec3_madd(ray->origin, at, ray->direction);
            float more = cloud_grid_extinction(grid, p, !ray->blurred) - walk.least;
            depth += length / (float)steps * clampf(more, 0.0f, rest);
        }
    } while (depth < most && walk_on(&walk));
    return depth;
}

static float estimate_depths(const CloudSet *clouds, const CloudRay *ray, float scale, float most,
                             uint64_t *key)
{
    float depth = 0.0f;
    for (int i = 0; i < clouds->count && depth < most; i++) {
        depth += estimate_depth(&clouds->grid[i], ray, scale_in(&clouds->grid[i], scale),
                                most - depth, key);
    }
    return depth;
}

// With independent estimates of the depth D: exp(-D) = exp(-p) sum over k of (p - D)^k / k!, where
// p is one of them and each power takes others; roulette ends the sum (Kettunen et al., "An
// Unbiased Ray-Marching Transmittance Estimator", SIGGRAPH 2021).
float clouds_clear(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key)
{
    enum { CERTAIN = 2 };
    const float most = 40.0f, survival = 0.5f;
    float pivot = estimate_depths(clouds, ray, scale, most, key);
    if (pivot <= 0.0f || pivot >= most) {
        return pivot <= 0.0f ? 1.0f : 0.0f;
    }
    float sum = 1.0f, term = 1.0f;
    for (int k = 1; term != 0.0f && (k <= CERTAIN || draw(key) < survival); k++) {
        float depth = estimate_depths(clouds, ray, scale, most, key);
        term *= (pivot - depth) / ((float)k * (k <= CERTAIN ? 1.0f : survival));
        sum += term;
    }
    return expf(-pivot) * sum;
}

float clouds_collide_with(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key,
                          int *which)
{
    CloudRay rest = *ray;
    float nearest = INFINITY;
    *which = 0;
    for (int i = 0; i < clouds->count; i++) {
        float t = collide(&clouds->grid[i], &rest, scale_in(&clouds->grid[i], scale), key);
        if (t < nearest) {
            nearest = rest.far = t;
            *which = i;
        }
    }
    return nearest;
}

float clouds_collide(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key)
{
    int which;
    return clouds_collide_with(clouds, ray, scale, key, &which);
}

float clouds_pass(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key)
{
    float share = 1.0f;
    for (int i = 0; i < clouds->count && share > 0.0f; i++) {
        share *= pass(&clouds->grid[i], ray, scale_in(&clouds->grid[i], scale), key);
    }
    return share;
}

// ---- what a camera sees of them ----

// Dims the share *left of light that has come so far, and adds what is lost times its distance.
static void see(const CloudGrid *grid, const CloudRay *ray, float *left, float *moment)
{
    Walk walk;
    bool more = walk_begin(&walk, grid, ray, true);
    for (; more && *left > 0.02f; more = walk_on(&walk)) {
        if (walk.most <= 0.0f) {
            continue;
        }
        float step = fmaxf(0.4f * grid->voxel, 0.004f * walk.near);
        int steps = (int)((walk.far - walk.near) / step) + 1;
        step = (walk.far - walk.near) / (float)steps;
        for (int i = 0; i < steps; i++) {
            float t = walk.near + step * ((float)i + 0.5f);
            float extinction = cloud_grid_smooth(grid, vec3_madd(ray->origin, t, ray->direction));
            float lost = *left * (1.0f - expf(-step * extinction));
            *left -= lost;
            *moment += lost * t;
        }
    }
}

float clouds_seen(const CloudSet *clouds, const CloudRay *ray, float *distance)
{
    float left = 1.0f, moment = 0.0f;
    for (int i = 0; i < clouds->count; i++) {
        see(&clouds->grid[i], ray, &left, &moment);
    }
    *distance = left < 1.0f ? moment / (1.0f - left) : INFINITY;
    return 1.0f - left;
}

// m: over which light in a cloud is even, since droplets scatter it forward: half the way on which
// it forgets its direction, 1 / (0.14 extinction). Forms that are smaller do not show.
static float slope_step(const CloudGrid *g)
{
    float blur = 0.5f / (0.14f * fmaxf(g->extinction, 1e-9f));
    return clampf(blur, 0.5f * g->voxel, 2.0f * g->voxel);
}

Vec3 clouds_slope(const CloudSet *clouds, Vec3 p)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < clouds->count; i++) {
        const CloudGrid *g = &clouds->grid[i];
        float h = slope_step(g);
        Vec3 x = vec3(h, 0, 0), y = vec3(0, h, 0), z = vec3(0, 0, h);
        Vec3 change =
            vec3(cloud_grid_smooth(g, vec3_add(p, x)) - cloud_grid_smooth(g, vec3_sub(p, x)),
                 cloud_grid_smooth(g, vec3_add(p, y)) - cloud_grid_smooth(g, vec3_sub(p, y)),
                 cloud_grid_smooth(g, vec3_add(p, z)) - cloud_grid_smooth(g, vec3_sub(p, z)));
        sum = vec3_madd(sum, 0.5f / h * g->rough.edge[1] / fmaxf(g->extinction, 1e-9f), change);
    }
    return sum;
}
