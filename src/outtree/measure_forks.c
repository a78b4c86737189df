#include "outtree/measure_forks.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { DIRECTION_REACH = 4 }; // steps over which a branch's direction is averaged
#define MAX_EXPONENT 32.0
#define MURRAY 3.0

typedef struct Mean {
    double count, sum, squares;
} Mean;

static void mean_add(Mean *mean, double x)
{
    mean->count += 1.0;
    mean->sum += x;
    mean->squares += x * x;
}

static double mean_of(const Mean *mean)
{
    return mean->count > 0.0 ? mean->sum / mean->count : (double)NAN;
}

static double mean_spread(const Mean *mean)
{
    double m = mean_of(mean);
    return mean->count > 1.0 ? sqrt(fmax(mean->squares / mean->count - m * m, 0.0)) : (double)NAN;
}

// ---- angles ----

static double degrees_between(Vec3 a, Vec3 b)
{
    return (double)(exact_acos(vec3_dot(a, b)) / RADIANS_PER_DEGREE);
}

static void measure_angles(const OutTree *tree, const Branching *b, int32_t node, Mean *side,
                           Mean *forward)
{
    Vec3 before = branching_direction_before(b, tree, node, DIRECTION_REACH);
    if (!(vec3_dot(before, before) > 0.5f)) {
        return;
    }
    int32_t main_child = branching_main_child(b, tree, node);
    for (int32_t c = b->first_child[node]; c >= 0; c = b->next_child[c]) {
        Vec3 after = branching_direction_after(b, tree, node, c, DIRECTION_REACH);
        if (vec3_dot(after, after) > 0.5f) {
            mean_add(c == main_child ? forward : side, degrees_between(before, after));
        }
    }
}

// ---- radii ----

// sum (r_child / r_parent)^e - 1
static double pipe_error(const OutTree *tree, const Branching *b, int32_t node, double exponent)
{
    double sum = -1.0, parent = (double)tree->radius[node];
    for (int32_t c = b->first_child[node]; c >= 0; c = b->next_child[c]) {
        sum += exact_exp(exponent * exact_log((double)tree->radius[c] / parent));
    }
    return sum;
}

static bool has_radii(const OutTree *tree, const Branching *b, int32_t node)
{
    bool positive = tree->radius[node] > 0.0f;
    for (int32_t c = b->first_child[node]; c >= 0; c = b->next_child[c]) {
        positive = positive && tree->radius[c] > 0.0f;
    }
    return positive;
}

// Exponent e at which the fork's pipe_error is zero; MAX_EXPONENT if a child is as thick as its
// parent, so that there is none.
static double solve_exponent(const OutTree *tree, const Branching *b, int32_t node)
{
    double low = 0.0, high = MAX_EXPONENT;
    for (int i = 0; i < 40; i++) {
        double middle = 0.5 * (low + high);
        if (pipe_error(tree, b, node, middle) > 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

static int compare_doubles(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double mean_pipe_error(const OutTree *tree, const Branching *b, double exponent)
{
    Mean mean = {0};
    for (int32_t i = 0; i < (int32_t)tree->count; i++) {
        if (b->children[i] > 1 && has_radii(tree, b, i)) {
            mean_add(&mean, fabs(pipe_error(tree, b, i, exponent)));
        }
    }
    return mean_of(&mean);
}

static bool measure_radii(const OutTree *tree, const Branching *b, ForkMeasures *out, Error *e)
{
    int64_t forks = 0, count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        forks += b->children[i] > 1;
    }
    double *exponent = memory_alloc(forks, sizeof *exponent, e);
    if (!exponent) {
        return false;
    }
    for (int32_t i = 0; i < (int32_t)tree->count; i++) {
        if (b->children[i] > 1 && has_radii(tree, b, i)) {
            exponent[count++] = solve_exponent(tree, b, i);
        }
    }
    qsort(exponent, (size_t)count, sizeof *exponent, compare_doubles);
    out->exponent =
        count > 0 ? 0.5 * (exponent[(count - 1) / 2] + exponent[count / 2]) : (double)NAN;
    out->pipe_residual = count > 0 ? mean_pipe_error(tree, b, out->exponent) : (double)NAN;
    out->murray_residual = count > 0 ? mean_pipe_error(tree, b, MURRAY) : (double)NAN;
    free(exponent);
    return true;
}

// ---- balance ----

static void measure_balance(const OutTree *tree, const Branching *b, int32_t node, Mean *asymmetry)
{
    double all = b->terminals[node];
    double largest = b->terminals[branching_main_child(b, tree, node)];
    if (all > 2.0) {
        mean_add(asymmetry, fabs(2.0 * largest - all) / (all - 2.0));
    }
}

bool measure_forks(const OutTree *tree, const Branching *b, ForkMeasures *out, Error *e)
{
    Mean side = {0}, forward = {0}, asymmetry = {0};
    for (int32_t i = 0; i < (int32_t)tree->count; i++) {
        if (b->children[i] > 1) {
            measure_angles(tree, b, i, &side, &forward);
            measure_balance(tree, b, i, &asymmetry);
        }
    }
    out->angle = mean_of(&side);
    out->angle_spread = mean_spread(&side);
    out->main_angle = mean_of(&forward);
    out->asymmetry = mean_of(&asymmetry);
    return measure_radii(tree, b, out, e);
}
