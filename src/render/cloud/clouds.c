#include "render/cloud/clouds.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/cloud/cloud_grid.h"

#include <stdlib.h>

struct CloudSet {
    DetailNoise *detail;
    int count;
    CloudGrid grid[];
};

// m: no cloud is seen beyond, where the Earth's curve has hidden it.
static const float REACH = 90000.0f;

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
        done = cloud_grid_new(&clouds->grid[i], &cloud[i], clouds->detail, own, run, e);
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

// ---- a walk through the bricks that a ray meets (Amanatides and Woo 1987) ----

typedef struct Walk {
    const CloudGrid *grid;
    int brick[3], step[3];
    float next[3], delta[3]; // m along the ray: to the next border, and between borders
    float near, far;         // m: of the brick
    float end;
    float bound; // 1/m: of the brick
} Walk;

static inline float coordinate(Vec3 v, int axis)
{
    return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

// The part of the ray within the grid; false if there is none.
static bool clip(const CloudGrid *g, const CloudRay *ray, float *near, float *far)
{
    *near = 0.0f;
    *far = fminf(ray->far, REACH);
    for (int axis = 0; axis < 3; axis++) {
        if (g->repeats && axis != 1) {
            continue;
        }
        float low = coordinate(g->low, axis), d = coordinate(ray->direction, axis);
        float high = low + g->voxel * (float)g->count[axis], o = coordinate(ray->origin, axis);
        if (d == 0.0f) {
            if (o < low || o > high) {
                return false;
            }
            continue;
        }
        float a = (low - o) / d, b = (high - o) / d;
        *near = fmaxf(*near, fminf(a, b));
        *far = fminf(*far, fmaxf(a, b));
    }
    return *near < *far;
}

static void enter(Walk *w)
{
    const CloudGrid *g = w->grid;
    int x = w->brick[0], z = w->brick[2];
    if (g->repeats) {
        x &= g->bricks[0] - 1;
        z &= g->bricks[2] - 1;
    }
    w->far = fminf(fminf(w->next[0], fminf(w->next[1], w->next[2])), w->end);
    bool inside = (unsigned)x < (unsigned)g->bricks[0] && (unsigned)z < (unsigned)g->bricks[2] &&
                  (unsigned)w->brick[1] < (unsigned)g->bricks[1];
    w->bound =
        inside ? g->bound[((int64_t)z * g->bricks[0] + x) * g->bricks[1] + w->brick[1]] : 0.0f;
}

static bool walk_begin(Walk *w, const CloudGrid *g, const CloudRay *ray)
{
    w->grid = g;
    if (!clip(g, ray, &w->near, &w->end)) {
        return false;
    }
    float side = g->voxel * BRICK;
    for (int axis = 0; axis < 3; axis++) {
        float d = coordinate(ray->direction, axis);
        float o = coordinate(ray->origin, axis) - coordinate(g->low, axis);
        w->brick[axis] = (int)floorf((o + w->near * d) / side);
        w->step[axis] = d < 0.0f ? -1 : 1;
        w->delta[axis] = d != 0.0f ? side / fabsf(d) : INFINITY;
        float border = side * (float)(w->brick[axis] + (d < 0.0f ? 0 : 1));
        w->next[axis] = d != 0.0f ? fmaxf((border - o) / d, w->near) : INFINITY;
    }
    enter(w);
    return true;
}

static bool walk_on(Walk *w)
{
    if (w->far >= w->end) {
        return false;
    }
    int axis = w->next[0] < w->next[1] ? 0 : 1;
    axis = w->next[2] < w->next[axis] ? 2 : axis;
    w->near = w->far;
    w->brick[axis] += w->step[axis];
    w->next[axis] += w->delta[axis];
    enter(w);
    return true;
}

// ---- tracking ----

static float draw(uint64_t *key)
{
    *key += 0x9e3779b97f4a7c15ull;
    return random_unit(*key);
}

// Tentative collisions with a grid along a ray, as frequent as its bricks' bounds say.
typedef struct Flight {
    const CloudRay *ray;
    float scale;
    uint64_t *key;
    Walk walk;
    float t, bound; // m, 1/m: of the last collision
} Flight;

static bool flight_begin(Flight *f, const CloudGrid *grid, const CloudRay *ray, float scale,
                         uint64_t *key)
{
    *f = (Flight){.ray = ray, .scale = scale, .key = key};
    bool meets = walk_begin(&f->walk, grid, ray);
    f->t = f->walk.near;
    return meets;
}

// Goes on to the next one; false when there is none.
static bool flight_on(Flight *f)
{
    float depth = -logf(1.0f - draw(f->key));
    do {
        f->bound = f->walk.bound * f->scale;
        f->t = fmaxf(f->t, f->walk.near);
        float left = (f->walk.far - f->t) * f->bound;
        if (depth < left) {
            f->t += depth / f->bound;
            return true;
        }
        depth -= left;
    } while (walk_on(&f->walk));
    return false;
}

// The probability that the tentative collision is a true one.
static float flight_truth(const Flight *f)
{
    Vec3 p = vec3_madd(f->ray->origin, f->t, f->ray->direction);
    return fminf(f->scale * cloud_grid_extinction(f->walk.grid, p, !f->ray->blurred) / f->bound,
                 1.0f);
}

static float collide(const CloudGrid *grid, const CloudRay *ray, float scale, uint64_t *key)
{
    Flight flight;
    bool flies = flight_begin(&flight, grid, ray, scale, key);
    while (flies && flight_on(&flight)) {
        if (draw(key) < flight_truth(&flight)) {
            return flight.t;
        }
    }
    return INFINITY;
}

// Ratio tracking; what is nearly lost is played for.
static float pass(const CloudGrid *grid, const CloudRay *ray, float scale, uint64_t *key)
{
    Flight flight;
    bool flies = flight_begin(&flight, grid, ray, scale, key);
    float share = 1.0f;
    while (flies && flight_on(&flight)) {
        share *= 1.0f - flight_truth(&flight);
        if (share < 0.2f) {
            if (draw(key) >= share) {
                return 0.0f;
            }
            share = 1.0f;
        }
    }
    return share;
}

float clouds_collide(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key)
{
    CloudRay rest = *ray;
    float nearest = INFINITY;
    for (int i = 0; i < clouds->count; i++) {
        float t = collide(&clouds->grid[i], &rest, scale, key);
        if (t < nearest) {
            nearest = rest.far = t;
        }
    }
    return nearest;
}

float clouds_pass(const CloudSet *clouds, const CloudRay *ray, float scale, uint64_t *key)
{
    float share = 1.0f;
    for (int i = 0; i < clouds->count && share > 0.0f; i++) {
        share *= pass(&clouds->grid[i], ray, scale, key);
    }
    return share;
}

// ---- what a camera sees of them ----

// Dims the share *left of light that has come so far, and adds what is lost times its distance.
static void see(const CloudGrid *grid, const CloudRay *ray, float *left, float *moment)
{
    Walk walk;
    bool more = walk_begin(&walk, grid, ray);
    for (; more && *left > 0.02f; more = walk_on(&walk)) {
        if (walk.bound <= 0.0f) {
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

Vec3 clouds_slope(const CloudSet *clouds, Vec3 p)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < clouds->count; i++) {
        const CloudGrid *g = &clouds->grid[i];
        float h = 0.5f * g->voxel;
        Vec3 x = vec3(h, 0, 0), y = vec3(0, h, 0), z = vec3(0, 0, h);
        Vec3 change =
            vec3(cloud_grid_smooth(g, vec3_add(p, x)) - cloud_grid_smooth(g, vec3_sub(p, x)),
                 cloud_grid_smooth(g, vec3_add(p, y)) - cloud_grid_smooth(g, vec3_sub(p, y)),
                 cloud_grid_smooth(g, vec3_add(p, z)) - cloud_grid_smooth(g, vec3_sub(p, z)));
        sum = vec3_madd(sum, 0.5f / h * g->rough.edge[1] / fmaxf(g->extinction, 1e-9f), change);
    }
    return sum;
}
