// Measures of a frost flower: its size, its sides.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/frost_flower/frost_flower.h"

#include <stdlib.h>

// Degrees between the step to a node and the one before.
static double turn_at(const OutTree *tree, int64_t node)
{
    int32_t parent = tree->parent[node], before = tree->parent[parent];
    Vec3 a = vec3_sub(tree->position[node], tree->position[parent]);
    Vec3 b = vec3_sub(tree->position[parent], tree->position[before]);
    return (double)(exact_atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b)) /
                    RADIANS_PER_DEGREE);
}

bool frost_flower_measure(const void *params, const Grown *grown, const Recipe *recipe,
                          MeasureList *list, Error *e)
{
    (void)params, (void)recipe;
    const OutTree *tree = grown->tree;
    int32_t *order = memory_alloc(tree->count, sizeof *order, e), highest = 0;
    double sum = 0.0;
    int64_t sides = 0;
    for (int64_t i = 0; order && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        bool side = parent >= 0 && tree->parent[parent] >= 0 &&
                    tree->id[i] != out_tree_child_id(tree->id[parent], 0);
        order[i] = parent < 0 ? 0 : order[parent] + (side ? 1 : 0);
        highest = order[i] > highest ? order[i] : highest;
        sum += side ? turn_at(tree, i) : 0.0;
        sides += side;
    }
    bool done = order != NULL;
    free(order);
    return done &&
           measures_add(list, "side_angle", sides > 0 ? sum / (double)sides : NAN, "degrees", NAN,
                        NAN, e) &&
           measures_add(list, "orders", (double)highest, "", NAN, NAN, e) &&
           measures_add(list, "sides", (double)sides, "", NAN, NAN, e);
}
