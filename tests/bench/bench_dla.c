// Colonization against diffusion-limited aggregation, the papers' claim that theirs is the faster:
// nodes per second of both for plane clusters of as many nodes over as large a disc, on one thread.
#include "base/random.h"
#include "grow/aggregate/dla.h"
#include "grow/colonize.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void stop(const Error *e)
{
    fprintf(stderr, "%s\n", e->message);
    exit(1);
}

// As many attractors over a disc as make about `wanted` nodes: a step of 0.5 spacings makes 0.69 of
// them an attractor.
static OutTree *colonize_disc(int64_t wanted, float radius, double *seconds)
{
    Error e = {0};
    Run run = run_default();
    int64_t count = (int64_t)((double)wanted / 0.69);
    PointSet *points = points_new(&e);
    points->dimension = 2;
    points->measure = M_PI * (double)radius * (double)radius;
    for (uint64_t draw = 0; points->count < count; draw++) {
        uint64_t key = random_key(7, draw);
        Vec3 p = vec3(random_range(random_key(key, 0), -1, 1),
                      random_range(random_key(key, 1), -1, 1), 0);
        if (vec3_dot(p, p) < 1.0f &&
            !points_add(points, vec3_scale(p, radius), vec3(0, 0, 1), draw, &e)) {
            stop(&e);
        }
    }
    OutTree *tree = out_tree_new(&e);
    out_tree_add_node(tree, vec3(0, 0, 0), -1, 0, 0, 1, &e);
    ColonizeParams params = colonize_params_default();
    colonize_auto(&params, points_spacing(points), 0.5f, 1.5f, 6.0f);
    double start = run_seconds();
    if (!colonize(tree, points, &params, &run, NULL, &e)) {
        stop(&e);
    }
    *seconds = run_seconds() - start;
    points_free(points);
    return tree;
}

int main(void)
{
    const int64_t counts[] = {10000, 100000, 1000000};
    Error e = {0};
    Run run = run_default();
    for (int i = 0; i < 3; i++) {
        DlaParams params = dla_params_default();
        params.count = counts[i];
        double start = run_seconds(), seconds;
        OutTree *cluster = dla_grow(&params, &run, &e);
        double dla_seconds = run_seconds() - start;
        if (!cluster) {
            stop(&e);
        }
        Aabb box = out_tree_bounds(cluster);
        OutTree *tree = colonize_disc(counts[i], 0.5f * (box.high.x - box.low.x), &seconds);
        double aggregated = (double)counts[i] / dla_seconds;
        double colonized = (double)tree->count / seconds;
        printf("plane, %lld particles: aggregation %.3f s, %.3g nodes/s, dimension %.3f; "
               "colonization %lld nodes in %.3f s, %.3g nodes/s: %.1f times as fast\n",
               (long long)counts[i], dla_seconds, aggregated, dla_dimension(cluster),
               (long long)tree->count, seconds, colonized, colonized / aggregated);
        out_tree_free(cluster);
        out_tree_free(tree);
    }
    return 0;
}
