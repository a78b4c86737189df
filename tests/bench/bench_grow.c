// Growth's figures of speed and size:
//
//     bench_grow [YARDSTICK [MOST]]
//
// YARDSTICK is a program that prints "time=SECONDS" for growth toward as many attractors in a unit
// sphere as its first argument says; it is run in turn with ours, and the least time of each
// counts. MOST: attractors of the largest growth, default 10,000,000.
#include "base/memory.h"
#include "base/random.h"
#include "grow/colonize.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5 };

typedef struct Work {
    const char *name;
    bool cube; // W3: unit cube, root in the middle of its floor; else unit sphere, root at the
               // bottom
    float step, kill, influence; // in mean spacings
    int max_children;
} Work;

static const Work sphere = {"unit sphere", false, 0.5f, 1.5f, 6.0f, 0};
static const Work cube = {"W3, unit cube", true, 0.5f, 1.0f, 4.0f, 3};

static PointSet *attractors(const Work *work, int64_t count)
{
    PointSet *points = points_new(NULL);
    points->measure = work->cube ? 1.0 : 4.18879;
    points->dimension = 3;
    for (uint64_t draw = 0; points->count < count; draw++) {
        uint64_t key = random_key(42, draw);
        Vec3 p = vec3(random_unit(random_key(key, 0)), random_unit(random_key(key, 1)),
                      random_unit(random_key(key, 2)));
        Vec3 ball = vec3_sub(vec3_scale(p, 2.0f), vec3_splat(1.0f));
        if (!work->cube && vec3_dot(ball, ball) >= 1.0f) {
            continue;
        }
        if (!points_add(points, work->cube ? p : ball, vec3(0, 1, 0), draw, NULL)) {
            exit(1);
        }
    }
    return points;
}

// Seconds that growth takes; the points are made before the clock starts.
static double grow(const Work *work, const PointSet *points, int threads, GrowReport *report)
{
    OutTree *tree = out_tree_new(NULL);
    out_tree_add_node(tree, work->cube ? vec3(0.5f, 0, 0.5f) : vec3(0, -1, 0), -1, 0, 0, 1, NULL);
    ColonizeParams params = colonize_params_default();
    params.max_children = work->max_children;
    colonize_auto(&params, points_spacing(points), work->step, work->kill, work->influence);
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    double start = run_seconds();
    if (!colonize(tree, points, &params, &run, report, &e)) {
        fprintf(stderr, "%s\n", e.message);
        exit(1);
    }
    double seconds = run_seconds() - start;
    out_tree_free(tree);
    return seconds;
}

static double yardstick_seconds(const char *program, int64_t count)
{
    char line[512];
    snprintf(line, sizeof line, "%s %lld", program, (long long)count);
    FILE *pipe = popen(line, "r"); // NOLINT(cert-env33-c): a benchmark's own argument
    double seconds = NAN;
    while (pipe && fgets(line, sizeof line, pipe)) {
        const char *at = strstr(line, "time=");
        seconds = at ? strtod(at + 5, NULL) : seconds;
    }
    if (pipe) {
        pclose(pipe);
    }
    return seconds;
}

static double least(double a, double b)
{
    return b < a ? b : a;
}

static void compare_threads(const char *yardstick)
{
    const int64_t count = 1000000;
    PointSet *points = attractors(&sphere, count);
    double one = INFINITY, two = INFINITY, other = INFINITY;
    GrowReport report;
    for (int round = 0; round < ROUNDS; round++) {
        one = least(one, grow(&sphere, points, 1, &report));
        two = least(two, grow(&sphere, points, 2, &report));
        other = yardstick ? least(other, yardstick_seconds(yardstick, count)) : other;
    }
    printf("growth, 1,000,000 attractors in a unit sphere: %lld nodes, %lld steps\n",
           (long long)report.new_nodes, (long long)report.steps);
    if (yardstick) {
        printf("  1 thread / yardstick            %6.2f   (at most 0.7; %.3f s and %.3f s)\n",
               one / other, one, other);
    }
    printf("  1 thread / 2 threads            %6.2f   (at least 1.7; %.3f s and %.3f s)\n",
           one / two, one, two);
    points_free(points);
}

// Least-squares slope of log(seconds) over log(attractors).
static void fit_exponent(void)
{
    const int64_t counts[] = {10000, 100000, 1000000, 4000000};
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    printf("growth, 1 thread, by attractors:");
    for (int i = 0; i < 4; i++) {
        PointSet *points = attractors(&sphere, counts[i]);
        GrowReport report;
        double seconds = INFINITY;
        for (int round = 0; round < ROUNDS - i; round++) {
            seconds = least(seconds, grow(&sphere, points, 1, &report));
        }
        points_free(points);
        double x = log((double)counts[i]), y = log(seconds);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
        printf(" %.4f s", seconds);
    }
    printf("\n  exponent, 10,000 to 4,000,000   %6.2f   (at most 1.1)\n",
           (4 * sxy - sx * sy) / (4 * sxx - sx * sx));
}

static void count_nodes(void)
{
    const int64_t counts[] = {10000, 100000, 1000000};
    const double peers = 66037.0; // mean of two independent programs at 100,000
    for (int i = 0; i < 3; i++) {
        PointSet *points = attractors(&cube, counts[i]);
        GrowReport report;
        double seconds = grow(&cube, points, 1, &report);
        points_free(points);
        printf("%s, %lld attractors: %lld nodes in %lld steps, %.3f s", cube.name,
               (long long)counts[i], (long long)report.new_nodes, (long long)report.steps, seconds);
        if (counts[i] == 100000) {
            printf("; nodes / peers' %.4f (within 0.01 of 1)", (double)report.new_nodes / peers);
        }
        printf("\n");
    }
}

// The largest growth, once, and the memory that this program has needed by then.
static void grow_most(const char *yardstick, int64_t count)
{
    PointSet *points = attractors(&sphere, count);
    GrowReport report;
    double one = grow(&sphere, points, 1, &report);
    points_free(points);
    printf("growth, %lld attractors, 1 thread: %lld nodes, %.2f s\n", (long long)count,
           (long long)report.new_nodes, one);
    if (yardstick) {
        double other = yardstick_seconds(yardstick, count);
        printf("  1 thread / yardstick            %6.2f   (at most 0.7; yardstick %.2f s)\n",
               one / other, other);
    }
    double bytes = (double)memory_peak();
    printf("  memory                          %6.2f GB, %.0f bytes an attractor (at most 120)\n",
           bytes * 1e-9, bytes / (double)count);
}

int main(int argc, char **argv)
{
    const char *yardstick = argc > 1 && argv[1][0] ? argv[1] : NULL;
    compare_threads(yardstick);
    fit_exponent();
    count_nodes();
    grow_most(yardstick, argc > 2 ? strtoll(argv[2], NULL, 10) : 10000000);
    return 0;
}
