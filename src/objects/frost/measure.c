// Measures of frost: the angle of its sides, their orders, the rotation of its spines.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/common/swept.h"
#include "objects/frost/frost.h"

#include <math.h>
#include <stdlib.h>

static double angle_between(Vec3 a, Vec3 b)
{
    return (double)(exact_atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b)) /
                    RADIANS_PER_DEGREE);
}

// Is the node the first of a side? A spine goes on by a birth of one more; in ferns every chain
// goes on by a node's first child, and sides are its others.
static bool may_be_side(const OutTree *tree, const FrostParams *params, int64_t node)
{
    int32_t parent = tree->parent[node], before = parent < 0 ? -1 : tree->parent[parent];
    if (before < 0) {
        return false;
    }
    return params->habit == FROST_FERNS ? tree->id[node] != out_tree_child_id(tree->id[parent], 0)
                                        : tree->birth[node] - tree->birth[parent] != 1;
}

// Degrees between the step to a side's node and the one before; 0 for other nodes.
static double turn_at(const OutTree *tree, const FrostParams *params, int64_t node)
{
    int32_t parent = tree->parent[node];
    return may_be_side(tree, params, node)
               ? angle_between(
                     vec3_sub(tree->position[node], tree->position[parent]),
                     vec3_sub(tree->position[parent], tree->position[tree->parent[parent]]))
               : 0.0;
}

// A branch of spines is a side if it leaves at more than half the angle of ice, the border between
// forward and sideways in the growth.
static bool measure_sides(const OutTree *tree, const FrostParams *params, MeasureList *list,
                          Error *e)
{
    int32_t *order = memory_alloc(tree->count, sizeof *order, e), highest = 0;
    double sum = 0.0, squares = 0.0, least = params->habit == FROST_FERNS ? 0.0 : 30.0;
    int64_t sides = 0;
    for (int64_t i = 0; order && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        double angle = turn_at(tree, params, i);
        order[i] = (parent < 0 ? 0 : order[parent]) + (angle > least);
        highest = order[i] > highest ? order[i] : highest;
        if (angle > least) {
            sum += angle;
            squares += angle * angle;
            sides++;
        }
    }
    bool done = order != NULL;
    free(order);
    bool ice = params->habit == FROST_SPINES;
    double mean = sides > 0 ? sum / (double)sides : NAN;
    double spread = sides > 0 ? sqrt(fmax(0.0, squares / (double)sides - mean * mean)) : NAN;
    return done && measures_add(list, "orders", (double)highest, "", NAN, NAN, e) &&
           measures_add(list, "side_angle", mean, "degrees", ice ? 57.0 : NAN, ice ? 63.0 : NAN,
                        e) &&
           measures_add(list, "side_angle_spread", spread, "degrees", NAN, NAN, e);
}

// Azimuth of p about a nucleus, radians: on a bubble about the axis through it, on a pane in its
// plane. False where it is undefined: near a bubble's poles.
static bool azimuth(const FrostParams *params, Vec3 nucleus, Vec3 p, float *out)
{
    if (params->surface == FROST_PANE) {
        *out = exact_atan2(p.y - nucleus.y, p.x - nucleus.x);
        return true;
    }
    Vec3 axis = vec3_normalize(vec3_sub(nucleus, params->position));
    Vec3 x = vec3_perpendicular(axis), y = vec3_cross(axis, x);
    Vec3 d = vec3_normalize(vec3_sub(p, params->position));
    *out = exact_atan2(vec3_dot(d, y), vec3_dot(d, x));
    return fabsf(vec3_dot(d, axis)) < 0.95f;
}

// Azimuth swept from `parent` to `node`, degrees.
static double step_swept(const OutTree *tree, const FrostParams *params, Vec3 nucleus,
                         int32_t parent, int64_t node)
{
    float from, to;
    if (!azimuth(params, nucleus, tree->position[parent], &from) ||
        !azimuth(params, nucleus, tree->position[node], &to)) {
        return 0.0;
    }
    float turn = to - from;
    turn += turn > PI_F ? -2.0f * PI_F : (turn < -PI_F ? 2.0f * PI_F : 0.0f);
    return (double)(turn / RADIANS_PER_DEGREE);
}

// Mean over nodes at least half as far along their path as the farthest.
static bool measure_swept(const OutTree *tree, const FrostParams *params, MeasureList *list,
                          Error *e)
{
    double *swept = memory_alloc_zero(tree->count, sizeof *swept, e);
    double *reach = memory_alloc_zero(tree->count, sizeof *reach, e), furthest = 0.0, sum = 0.0;
    int32_t *root = memory_alloc(tree->count, sizeof *root, e);
    int64_t count = 0;
    bool done = swept && reach && root;
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        root[i] = parent < 0 ? (int32_t)i : root[parent];
        if (parent >= 0 && tree->parent[parent] >= 0) {
            swept[i] = swept[parent] + step_swept(tree, params, tree->position[root[i]], parent, i);
            reach[i] =
                reach[parent] + (double)vec3_distance(tree->position[i], tree->position[parent]);
            furthest = reach[i] > furthest ? reach[i] : furthest;
        }
    }
    for (int64_t i = 0; done && i < tree->count; i++) {
        if (reach[i] > 0.5 * furthest) {
            sum += fabs(swept[i]);
            count++;
        }
    }
    free(swept);
    free(reach);
    free(root);
    return done && measures_add(list, "swept", count > 0 ? sum / (double)count : NAN, "degrees",
                                NAN, NAN, e);
}

// On a bubble the axis through the nucleus, on a pane the normal at it.
static SweptAxis nucleus_axis(const void *context, const OutTree *tree, int64_t base)
{
    const FrostParams *params = context;
    Vec3 nucleus = tree->position[base];
    return params->surface == FROST_PANE
               ? (SweptAxis){nucleus, vec3(0, 0, 1)}
               : (SweptAxis){params->position, vec3_normalize(vec3_sub(nucleus, params->position))};
}

static bool measure_spines(const OutTree *tree, const FrostParams *params, MeasureList *list,
                           Error *e)
{
    bool *is_spine = memory_alloc(tree->count, sizeof *is_spine, e);
    for (int64_t i = 0; is_spine && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool goes_on = params->habit == FROST_FERNS
                           ? parent < 0 || is_spine[parent]
                           : parent < 0 || tree->birth[i] - tree->birth[parent] == 1;
        is_spine[i] = goes_on && (params->habit == FROST_SPINES || parent < 0 ||
                                  tree->id[i] == out_tree_child_id(tree->id[parent], 0));
    }
    bool done =
        is_spine && swept_measure(tree, is_spine, nucleus_axis, params, "spine_swept", list, e);
    free(is_spine);
    return done;
}

bool frost_measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                   Error *e)
{
    (void)recipe;
    return measure_sides(grown->tree, params, list, e) &&
           measure_swept(grown->tree, params, list, e) &&
           measure_spines(grown->tree, params, list, e);
}
