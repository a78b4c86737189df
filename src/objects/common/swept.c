#include "objects/common/swept.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

// A node's path from its base.
typedef struct Path {
    SweptAxis axis;
    Vec3 arm;      // from the axis to the node, perpendicular to it
    double length; // m
    double swept;  // degrees
    bool goes_on;
} Path;

static Vec3 arm_of(const SweptAxis *axis, Vec3 p)
{
    Vec3 v = vec3_sub(p, axis->center);
    return vec3_madd(v, -vec3_dot(v, axis->direction), axis->direction);
}

static double angle_between(Vec3 a, Vec3 b, Vec3 axis)
{
    float across = vec3_dot(axis, vec3_cross(a, b));
    return (double)(exact_atan2(across, vec3_dot(a, b)) / RADIANS_PER_DEGREE);
}

static bool is_base(const OutTree *tree, const bool *is_in, int64_t i)
{
    return tree->parent[i] < 0 || !is_in[tree->parent[i]];
}

static void find_arms(const OutTree *tree, const bool *is_in, SweptAxisOf *axis_of,
                      const void *context, Path *path)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (is_in[i]) {
            path[i].axis =
                is_base(tree, is_in, i) ? axis_of(context, tree, i) : path[tree->parent[i]].axis;
            path[i].arm = arm_of(&path[i].axis, tree->position[i]);
        }
    }
}

static float longest_arm(const OutTree *tree, const Path *path)
{
    float longest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        float length = vec3_length(path[i].arm);
        longest = length > longest ? length : longest;
    }
    return longest;
}

// Returns the length of the longest path.
static double follow(const OutTree *tree, const bool *is_in, Path *path)
{
    float least = 0.1f * longest_arm(tree, path);
    double longest = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (!is_in[i] || is_base(tree, is_in, i)) {
            continue;
        }
        int32_t parent = tree->parent[i];
        Path *from = &path[parent];
        bool is_near = vec3_length(from->arm) < least || vec3_length(path[i].arm) < least;
        from->goes_on = true;
        path[i].length =
            from->length + (double)vec3_distance(tree->position[parent], tree->position[i]);
        path[i].swept =
            from->swept +
            (is_near ? 0.0 : angle_between(from->arm, path[i].arm, path[i].axis.direction));
        longest = path[i].length > longest ? path[i].length : longest;
    }
    return longest;
}

bool swept_measure(const OutTree *tree, const bool *is_in, SweptAxisOf *axis_of,
                   const void *context, const char *name, MeasureList *list, Error *e)
{
    Path *path = memory_alloc_zero(tree->count, sizeof *path, e);
    if (!path) {
        return false;
    }
    find_arms(tree, is_in, axis_of, context, path);
    double longest = follow(tree, is_in, path), sum = 0.0;
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (is_in[i] && !path[i].goes_on && longest > 0.0 && path[i].length >= 0.5 * longest) {
            sum += path[i].swept;
            count++;
        }
    }
    free(path);
    return measures_add(list, name, count > 0 ? sum / (double)count : NAN, "degrees", NAN, NAN, e);
}
