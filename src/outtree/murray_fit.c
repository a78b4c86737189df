// Measures how well a tree obeys Murray's laws.
#include "base/exact_math.h"
#include "base/memory.h"
#include "outtree/murray.h"

#include <stdlib.h>

#define DEGREES_PER_RADIAN 57.29577951308232

static double angle_between(Vec3 a, Vec3 b)
{
    return DEGREES_PER_RADIAN * (double)exact_acos(vec3_dot(vec3_normalize(a), vec3_normalize(b)));
}

static int compare_float(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return x < y ? -1 : (x > y);
}

static double largest_residual(const OutTree *tree, MurrayLaw law, double *outflow)
{
    double worst = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            outflow[tree->parent[i]] += murray_flow(law, (double)tree->radius[i]);
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        double in = murray_flow(law, (double)tree->radius[i]);
        double residual = outflow[i] > 0.0 ? fabs(in - outflow[i]) / in : 0.0;
        worst = residual > worst ? residual : worst;
    }
    return worst;
}

// Errors of the angle between daughters, degrees, one per fork; returns how many.
static int64_t angle_errors(const OutTree *tree, const int32_t *child, float *error,
                            double *side_angle)
{
    int64_t forks = 0, sides = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t a = child[3 * i], b = child[3 * i + 1];
        if (a < 0 || b < 0 || child[3 * i + 2] >= 0) {
            continue;
        }
        Vec3 da = vec3_sub(tree->position[a], tree->position[i]);
        Vec3 db = vec3_sub(tree->position[b], tree->position[i]);
        MurrayAngles law = murray_angles((double)tree->radius[i], (double)tree->radius[a],
                                         (double)tree->radius[b]);
        double wanted = DEGREES_PER_RADIAN * (double)exact_acos((float)law.cosine_between);
        error[forks++] = (float)fabs(angle_between(da, db) - wanted);
        if (tree->parent[i] >= 0) {
            Vec3 mother = vec3_sub(tree->position[i], tree->position[tree->parent[i]]);
            *side_angle += angle_between(da, mother) + angle_between(db, mother);
            sides += 2;
        }
    }
    *side_angle = sides > 0 ? *side_angle / (double)sides : (double)NAN;
    return forks;
}

static void find_children(const OutTree *tree, int32_t *child)
{
    for (int64_t i = 0; i < 3 * tree->count; i++) {
        child[i] = -1;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        for (int k = 0; tree->parent[i] >= 0 && k < 3; k++) {
            int32_t *place = &child[3 * (int64_t)tree->parent[i] + k];
            if (*place < 0) {
                *place = (int32_t)i;
                break;
            }
        }
    }
}

bool out_tree_murray_fit(const OutTree *tree, MurrayLaw law, MurrayFit *fit, Error *e)
{
    double *outflow = memory_alloc_zero(tree->count, sizeof *outflow, e);
    int32_t *child = memory_alloc(tree->count, 3 * sizeof *child, e);
    float *error = memory_alloc(tree->count, sizeof *error, e);
    bool done = outflow && child && error;
    if (done) {
        *fit = (MurrayFit){.residual = largest_residual(tree, law, outflow)};
        find_children(tree, child);
        fit->forks = angle_errors(tree, child, error, &fit->side_angle);
        qsort(error, (size_t)fit->forks, sizeof *error, compare_float);
        int64_t exact = 0;
        while (exact < fit->forks && error[exact] < 0.5f) {
            exact++;
        }
        fit->angle_median = fit->forks > 0 ? (double)error[fit->forks / 2] : (double)NAN;
        fit->angle_exact = fit->forks > 0 ? (double)exact / (double)fit->forks : (double)NAN;
    }
    free(outflow);
    free(child);
    free(error);
    return done;
}
