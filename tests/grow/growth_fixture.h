// What the growth tests share: attractors without an envelope, and brute-force growth.
#ifndef RAMIFY_TESTS_GROWTH_FIXTURE_H
#define RAMIFY_TESTS_GROWTH_FIXTURE_H

#include "testing.h"

#include "base/random.h"
#include "grow/colonize.h"

#include <string.h>

static inline PointSet *points_empty(double measure, int dimension)
{
    PointSet *points = points_new(NULL);
    assert_non_null(points);
    points->measure = measure;
    points->dimension = dimension;
    return points;
}

static inline void points_put(PointSet *points, Vec3 p, Vec3 n)
{
    assert_true(points_add(points, p, n, (uint64_t)points->count, NULL));
}

// Uniform in the unit ball.
static inline PointSet *points_in_ball(int64_t count, uint64_t seed)
{
    PointSet *points = points_empty(4.18879, 3);
    for (uint64_t draw = 0; points->count < count; draw++) {
        uint64_t key = random_key(seed, draw);
        Vec3 p =
            vec3(random_range(random_key(key, 0), -1, 1), random_range(random_key(key, 1), -1, 1),
                 random_range(random_key(key, 2), -1, 1));
        if (vec3_dot(p, p) < 1.0f) {
            points_put(points, p, vec3(0, 1, 0));
        }
    }
    return points;
}

// Uniform on the unit sphere, normals outward.
static inline PointSet *points_on_sphere(int64_t count, uint64_t seed)
{
    PointSet *points = points_empty(12.56637, 2);
    for (int64_t i = 0; i < count; i++) {
        Vec3 p = random_direction(random_key(seed, (uint64_t)i));
        points_put(points, p, p);
    }
    return points;
}

// Uniform on the square [-1, 1] x [-1, 1] of the plane y = 0.
static inline PointSet *points_on_plane(int64_t count, uint64_t seed)
{
    PointSet *points = points_empty(4.0, 2);
    for (int64_t i = 0; i < count; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        points_put(points,
                   vec3(random_range(random_key(key, 0), -1, 1), 0,
                        random_range(random_key(key, 1), -1, 1)),
                   vec3(0, 1, 0));
    }
    return points;
}

static inline OutTree *tree_from(Vec3 root)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    assert_int_equal(out_tree_add_node(tree, root, -1, 0, 0, 77, NULL), 0);
    return tree;
}

static inline ColonizeParams params_auto(const PointSet *points, float step, float kill,
                                         float influence)
{
    ColonizeParams params = colonize_params_default();
    colonize_auto(&params, points_spacing(points), step, kill, influence);
    return params;
}

static inline GrowReport grow_with(OutTree *tree, const PointSet *points,
                                   const ColonizeParams *params, int threads)
{
    Run run = run_default();
    run.threads = threads;
    GrowReport report;
    Error e = {0};
    if (!colonize(tree, points, params, &run, &report, &e)) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, NULL));
    return report;
}

static inline void assert_same_tree(const OutTree *a, const OutTree *b)
{
    assert_int_equal(a->count, b->count);
    size_t n = (size_t)a->count;
    assert_memory_equal(a->position, b->position, n * sizeof *a->position);
    assert_memory_equal(a->parent, b->parent, n * sizeof *a->parent);
    assert_memory_equal(a->birth, b->birth, n * sizeof *a->birth);
    assert_memory_equal(a->colony, b->colony, n * sizeof *a->colony);
    assert_memory_equal(a->id, b->id, n * sizeof *a->id);
}

#endif
