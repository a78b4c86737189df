#include "outtree/radii.h"

#include "base/exact_math.h"

#include <stddef.h>

// Fills radius with the number of tips below each node; returns the largest.
static float sum_tips(OutTree *tree)
{
    float thickest = 1.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        tree->radius[i] = 0.0f;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        if (tree->radius[i] == 0.0f) {
            tree->radius[i] = 1.0f;
        }
        if (tree->parent[i] >= 0) {
            tree->radius[tree->parent[i]] += tree->radius[i];
        } else if (tree->radius[i] > thickest) {
            thickest = tree->radius[i];
        }
    }
    return thickest;
}

// Fills radius with the number of nodes on the longest path to a tip.
static float count_steps_to_tip(OutTree *tree)
{
    float longest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        tree->radius[i] = 0.0f;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        float steps = tree->radius[i] + 1.0f;
        if (tree->parent[i] < 0) {
            longest = steps - 1.0f > longest ? steps - 1.0f : longest;
        } else if (tree->radius[tree->parent[i]] < steps) {
            tree->radius[tree->parent[i]] = steps;
        }
    }
    return longest;
}

// Without branches the pipe model does not apply: tapers linearly from root to tip.
static void taper_unbranched(OutTree *tree, float tip_radius, float root_radius)
{
    float longest = count_steps_to_tip(tree);
    for (int64_t i = 0; i < tree->count; i++) {
        float t = longest > 0.0f ? tree->radius[i] / longest : 1.0f;
        tree->radius[i] = lerpf(tip_radius, root_radius, t);
    }
}

void out_tree_pipe_radii(OutTree *tree, float exponent, float tip_radius, float root_radius)
{
    float thickest = sum_tips(tree);
    double power = 1.0 / (double)exponent;
    if (root_radius > 0.0f) {
        if (thickest <= 1.0f) {
            taper_unbranched(tree, tip_radius, root_radius);
            return;
        }
        power = exact_log((double)root_radius / (double)tip_radius) / exact_log((double)thickest);
    }
    // Consecutive nodes of a branch have equal sums, so the last result is reused.
    float last_sum = 1.0f, last_radius = tip_radius;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->radius[i] != last_sum) {
            last_sum = tree->radius[i];
            last_radius = tip_radius * (float)exact_exp(power * exact_log((double)last_sum));
        }
        tree->radius[i] = last_radius;
    }
}

void out_tree_birth_radii(OutTree *tree, float tip_radius, float root_radius)
{
    int32_t first = INT32_MAX, last = INT32_MIN;
    for (int64_t i = 0; i < tree->count; i++) {
        first = tree->birth[i] < first ? tree->birth[i] : first;
        last = tree->birth[i] > last ? tree->birth[i] : last;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        float age = last > first ? (float)((double)(last - tree->birth[i]) / (last - first)) : 1.0f;
        float radius = lerpf(tip_radius, root_radius, age);
        int32_t parent = tree->parent[i];
        tree->radius[i] =
            parent >= 0 && tree->radius[parent] < radius ? tree->radius[parent] : radius;
    }
}

// Distance along the branches from node i to its root, or `far` if larger. Only nodes nearer than
// `far` pay for the walk.
static float distance_to_root(const OutTree *tree, int64_t i, float far)
{
    float distance = 0.0f;
    for (int64_t parent = tree->parent[i]; parent >= 0 && distance < far;
         parent = tree->parent[i]) {
        distance += vec3_distance(tree->position[i], tree->position[parent]);
        i = parent;
    }
    return distance < far ? distance : far;
}

void out_tree_root_flare(OutTree *tree, float flare, float ground, float height)
{
    if (flare <= 0.0f || height <= 0.0f) {
        return;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        float above = distance_to_root(tree, i, ground + height) - ground;
        float left = 1.0f - clampf(above / height, 0.0f, 1.0f);
        tree->radius[i] *= 1.0f + flare * left * left;
    }
}
