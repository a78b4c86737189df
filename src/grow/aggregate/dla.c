#include "grow/aggregate/dla.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "grow/aggregate/dla_grid.h"

#include <stdlib.h>

enum { STREAM_ROOT_ID = 0 };        // of the seed; walk i uses stream i
enum { PARTICLES_PER_CHECK = 256 }; // particles between checks for cancellation

// Distance outside the cluster's bounding sphere at which walkers start, diameters. Any value is
// exact.
#define LAUNCH_GAP 2.0

typedef struct Cluster {
    const DlaParams *params;
    double (*position)[3]; // diameters
    int32_t *parent;
    int64_t count;
    double reach; // largest distance of a particle from the origin
    DlaGrid grid;
} Cluster;

// Random numbers of one walk, drawn in order.
typedef struct Draws {
    uint64_t key, number;
} Draws;

static double draw_unit(Draws *draws)
{
    return (double)(random_key(draws->key, draws->number++) >> 11) * (1.0 / 9007199254740992.0);
}

// Uniform direction on the unit circle (von Neumann 1951) or sphere (Marsaglia 1972).
static void draw_direction(Draws *draws, int dimension, double d[3])
{
    double x, y, s;
    do {
        x = 2.0 * draw_unit(draws) - 1.0;
        y = 2.0 * draw_unit(draws) - 1.0;
        s = x * x + y * y;
    } while (s >= 1.0 || s < 1e-12);
    if (dimension == 2) {
        d[0] = (x * x - y * y) / s;
        d[1] = 2.0 * x * y / s;
        d[2] = 0.0;
    } else {
        double f = 2.0 * sqrt(1.0 - s);
        d[0] = x * f;
        d[1] = y * f;
        d[2] = 1.0 - 2.0 * s;
    }
}

static double length_of(const double p[3])
{
    return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

static void launch(Draws *draws, int dimension, double radius, double p[3])
{
    draw_direction(draws, dimension, p);
    for (int i = 0; i < 3; i++) {
        p[i] *= radius;
    }
}

// A walker at distance r outside the circle first returns to it at an angle phi from its position,
// distributed by the Poisson kernel: tan(phi/2) = (r - R)/(r + R) tan(theta), theta uniform.
static void return_to_circle(Draws *draws, double radius, double r, double p[3])
{
    double d[3];
    draw_direction(draws, 2, d);
    double k = (r - radius) / (r + radius), c2 = d[0] * d[0], s2 = k * k * d[1] * d[1];
    double cosine = (c2 - s2) / (c2 + s2), sine = 2.0 * k * d[0] * d[1] / (c2 + s2);
    double x = p[0] / r * radius, y = p[1] / r * radius;
    p[0] = cosine * x - sine * y;
    p[1] = sine * x + cosine * y;
}

// In space a walker never returns with probability 1 - R/r; a new one starts then. Otherwise the
// cosine of the angle is distributed by the Poisson kernel, whose integral has a closed inverse.
static void return_to_sphere(Draws *draws, double radius, double r, double p[3])
{
    if (draw_unit(draws) * r >= radius) {
        launch(draws, 3, radius, p);
        return;
    }
    double far = 1.0 / (r + radius), near = 1.0 / (r - radius);
    double q = far + draw_unit(draws) * (near - far);
    double mu = (r * r + radius * radius - 1.0 / (q * q)) / (2.0 * r * radius);
    mu = mu < -1.0 ? -1.0 : (mu > 1.0 ? 1.0 : mu);
    double side[3], along = 0.0, length;
    do { // a direction perpendicular to p, uniform
        draw_direction(draws, 3, side);
        along = (side[0] * p[0] + side[1] * p[1] + side[2] * p[2]) / (r * r);
        for (int i = 0; i < 3; i++) {
            side[i] -= along * p[i];
        }
        length = length_of(side);
    } while (length < 1e-3);
    double across = sqrt(1.0 - mu * mu) / length;
    for (int i = 0; i < 3; i++) {
        p[i] = radius * (mu * p[i] / r + across * side[i]);
    }
}

// Walks until contact: sets p to the position and returns the particle touched.
static int32_t walk(Cluster *cluster, Draws *draws, double p[3])
{
    int dimension = cluster->params->dimension;
    double radius = cluster->reach + LAUNCH_GAP, least = (double)cluster->params->least_step;
    launch(draws, dimension, radius, p);
    for (;;) {
        double r = length_of(p), direction[3], touch;
        if (r > radius + LAUNCH_GAP) {
            (dimension == 2 ? return_to_circle : return_to_sphere)(draws, radius, r, p);
            continue;
        }
        int32_t nearest;
        double free = dla_grid_distance(&cluster->grid, p, &nearest) - 1.0;
        draw_direction(draws, dimension, direction);
        if (free < least) {
            int32_t hit = dla_grid_contact(&cluster->grid, p, direction, least, &touch);
            free = touch;
            nearest = hit;
        } else {
            nearest = -1;
        }
        for (int i = 0; i < 3; i++) {
            p[i] += free * direction[i];
        }
        if (nearest >= 0) {
            return nearest;
        }
    }
}

// Ensures that the grid covers every position a walker may reach before it is returned.
static bool fit_grid(Cluster *cluster, Error *e)
{
    double needed = cluster->reach + 2.0 * LAUNCH_GAP + 4.0;
    if (cluster->grid.levels > 0 && needed < cluster->grid.half) {
        return true;
    }
    dla_grid_free(&cluster->grid);
    if (!dla_grid_init(&cluster->grid, cluster->params->dimension, 1.2 * needed,
                       cluster->params->count, (const double(*)[3])cluster->position, e)) {
        return false;
    }
    for (int64_t i = 0; i < cluster->count; i++) {
        dla_grid_add(&cluster->grid, (int32_t)i);
    }
    return true;
}

static bool aggregate(Cluster *cluster, const Run *run, Error *e)
{
    const DlaParams *params = cluster->params;
    while (cluster->count < params->count) {
        int64_t i = cluster->count;
        if (i % PARTICLES_PER_CHECK == 0) {
            run_progress(run, "aggregate", (double)i / (double)params->count);
            if (run_is_cancelled(run)) {
                return run_cancel_error(e);
            }
        }
        if (!fit_grid(cluster, e)) {
            return false;
        }
        Draws draws = {.key = random_key(params->seed, (uint64_t)i)};
        cluster->parent[i] = walk(cluster, &draws, cluster->position[i]);
        double r = length_of(cluster->position[i]);
        cluster->reach = r > cluster->reach ? r : cluster->reach;
        cluster->count++;
        dla_grid_add(&cluster->grid, (int32_t)i);
    }
    return true;
}

static OutTree *cluster_tree(const Cluster *cluster, Error *e)
{
    OutTree *tree = out_tree_new(e);
    double scale = (double)cluster->params->diameter;
    int32_t *children = memory_alloc_zero(cluster->count, sizeof *children, e);
    bool done = tree && children && out_tree_reserve(tree, cluster->count, e);
    for (int64_t i = 0; done && i < cluster->count; i++) {
        const double *p = cluster->position[i];
        int32_t parent = cluster->parent[i];
        uint64_t id = parent < 0 ? random_key(cluster->params->seed, STREAM_ROOT_ID)
                                 : out_tree_child_id(tree->id[parent], children[parent]++);
        Vec3 at = vec3((float)(p[0] * scale), (float)(p[1] * scale), (float)(p[2] * scale));
        done = out_tree_add_node(tree, at, parent, (int32_t)i, 0, id, e) >= 0;
        if (done) {
            tree->radius[i] = 0.5f * cluster->params->diameter;
            tree->normal[i] = vec3(0, 0, 1);
        }
    }
    free(children);
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

DlaParams dla_params_default(void)
{
    return (DlaParams){
        .dimension = 2, .count = 10000, .diameter = 1.0f, .least_step = 0.25f, .seed = 1};
}

static bool check_params(const DlaParams *params, Error *e)
{
    if (params->dimension != 2 && params->dimension != 3) {
        return error_set(e, ERROR_INPUT, "aggregation in %d dimensions; it must be 2 or 3",
                         params->dimension);
    }
    if (params->count < 1 || params->count > INT32_MAX) {
        return error_set(e, ERROR_INPUT, "%lld particles; it must be 1 to 2147483647",
                         (long long)params->count);
    }
    if (!(params->diameter > 0.0f) || !isfinite(params->diameter)) {
        return error_set(e, ERROR_INPUT, "particles of %g m; their diameter must be above 0",
                         (double)params->diameter);
    }
    if (!(params->least_step >= 0.001f) || !(params->least_step <= 1.0f)) {
        return error_set(e, ERROR_INPUT, "a least step of %g diameters; it must be 0.001 to 1",
                         (double)params->least_step);
    }
    return true;
}

OutTree *dla_grow(const DlaParams *params, const Run *run, Error *e)
{
    if (!check_params(params, e)) {
        return NULL;
    }
    Cluster cluster = {.params = params, .count = 1};
    cluster.position = memory_alloc_zero(params->count, sizeof *cluster.position, e);
    cluster.parent = memory_alloc(params->count, sizeof *cluster.parent, e);
    OutTree *tree = NULL;
    if (cluster.position && cluster.parent) {
        cluster.parent[0] = -1;
        tree = aggregate(&cluster, run, e) ? cluster_tree(&cluster, e) : NULL;
    }
    dla_grid_free(&cluster.grid);
    free(cluster.position);
    free(cluster.parent);
    return tree;
}

double dla_dimension(const OutTree *cluster)
{
    if (cluster->count < 128) {
        return 0.0;
    }
    double sum[3] = {0}, squares = 0.0, sx = 0, sy = 0, sxx = 0, sxy = 0, points = 0;
    double next = (double)cluster->count / 64.0;
    for (int64_t i = 0; i < cluster->count; i++) {
        Vec3 p = cluster->position[i];
        sum[0] += (double)p.x, sum[1] += (double)p.y, sum[2] += (double)p.z;
        squares +=
            (double)p.x * (double)p.x + (double)p.y * (double)p.y + (double)p.z * (double)p.z;
        double n = (double)(i + 1);
        if (n >= next) {
            double mean2 = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / (n * n);
            double x = 0.5 * exact_log(squares / n - mean2), y = exact_log(n);
            sx += x, sy += y, sxx += x * x, sxy += x * y, points += 1.0;
            next *= 1.0905077; // 2^(1/8)
        }
    }
    return (points * sxy - sx * sy) / (points * sxx - sx * sx);
}
