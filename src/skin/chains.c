// Decomposes an out-tree into chains: from each fork along the thickest child.
#include "base/memory.h"
#include "skin/plan.h"

#include <stdlib.h>

static bool thick_enough(const SkinPlan *plan, int64_t node)
{
    int32_t parent = plan->tree->parent[node];
    return plan->tree->radius[node] >= plan->params.min_radius &&
           (parent < 0 || plan->chain_of[parent] != -1);
}

// Marks the nodes to skin with chain 0 (others -1) and finds each node's thickest child among them.
static void choose_nodes(SkinPlan *plan, int32_t *thickest_child)
{
    const OutTree *tree = plan->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        thickest_child[i] = -1;
        plan->chain_of[i] = thick_enough(plan, i) ? 0 : -1;
        int32_t parent = tree->parent[i];
        if (plan->chain_of[i] == 0 && parent >= 0) {
            int32_t rival = thickest_child[parent];
            if (rival < 0 || tree->radius[i] > tree->radius[rival]) {
                thickest_child[parent] = (int32_t)i;
            }
        }
    }
}

static bool add_chain(SkinPlan *plan, int64_t node, const int32_t *thickest_child, Error *e)
{
    if (!memory_reserve(&plan->chain, &plan->chain_capacity, plan->chain_count + 1,
                        sizeof(SkinChain), e)) {
        return false;
    }
    int32_t base = plan->tree->parent[node];
    int32_t number = (int32_t)plan->chain_count++;
    SkinChain *chain = &plan->chain[number];
    *chain = (SkinChain){.base = base,
                         .parent = base >= 0 ? plan->chain_of[base] : -1,
                         .first = plan->node_count,
                         .first_child = -1,
                         .next_sibling = -1};
    for (int64_t i = node; i >= 0; i = thickest_child[i]) {
        plan->chain_of[i] = number;
        plan->place[i] = (int32_t)plan->node_count;
        plan->node[plan->node_count++] = (int32_t)i;
    }
    chain->count = plan->node_count - chain->first;
    if (chain->parent >= 0) {
        SkinChain *parent = &plan->chain[chain->parent];
        chain->next_sibling = parent->first_child;
        parent->first_child = number;
    }
    return true;
}

static void measure_tree(SkinPlan *plan)
{
    const OutTree *tree = plan->tree;
    int32_t last = 1;
    for (int64_t i = 0; i < tree->count; i++) {
        last = tree->birth[i] > last ? tree->birth[i] : last;
    }
    plan->birth_scale = 1.0f / (float)last;
    if (tree->count > 0) {
        Aabb box = out_tree_bounds(tree);
        plan->least_radius = 1e-5f * vec3_distance(box.low, box.high);
    }
    if (plan->least_radius < 1e-6f) {
        plan->least_radius = 1e-6f;
    }
    plan->thickest = plan->least_radius;
    plan->thinnest = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        float radius = tree->radius[i];
        plan->thickest = radius > plan->thickest ? radius : plan->thickest;
        if (radius >= plan->params.min_radius && radius < plan->thinnest) {
            plan->thinnest = radius;
        }
    }
    plan->thinnest = fmaxf(plan->thinnest, plan->least_radius);
}

bool skin_plan_chains(SkinPlan *plan, Error *e)
{
    int64_t count = plan->tree->count;
    measure_tree(plan);
    plan->node = memory_alloc(count, sizeof(int32_t), e);
    plan->chain_of = memory_alloc(count, sizeof(int32_t), e);
    plan->place = memory_alloc_zero(count, sizeof(int32_t), e);
    int32_t *thickest_child = memory_alloc(count, sizeof(int32_t), e);
    bool good = plan->node && plan->chain_of && plan->place && thickest_child;
    if (good) {
        choose_nodes(plan, thickest_child);
    }
    for (int64_t i = 0; good && i < count; i++) {
        int32_t parent = plan->tree->parent[i];
        bool starts = parent < 0 || thickest_child[parent] != (int32_t)i;
        if (plan->chain_of[i] != -1 && starts) {
            good = add_chain(plan, i, thickest_child, e);
        }
    }
    free(thickest_child);
    return good;
}
