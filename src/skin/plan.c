#include "skin/plan.h"

#include "base/memory.h"
#include "skin/girth.h"

#include <stdlib.h>

// Sets where the axis of `chain` leaves its parent's surface, given a sample of the axis.
static void note_exit(const SkinPlan *plan, SkinChain *chain, const SkinPoint *at, float on_parent)
{
    SkinPoint there = skin_axis_at(plan, chain->parent, on_parent);
    Vec3 apart = vec3_sub(at->position, there.position);
    float cosine = vec3_dot(at->tangent, there.tangent);
    Vec3 side = vec3_madd(apart, -vec3_dot(apart, there.tangent), there.tangent);
    if (vec3_length(side) < 0.1f * there.radius) {
        side = vec3_madd(at->tangent, -cosine, there.tangent);
    }
    side = vec3_normalize(side);
    chain->exit = at->along;
    chain->exit_on_parent = on_parent;
    chain->exit_side = vec3_dot(side, side) > 0.5f ? side : there.side;
    chain->exit_sine = sqrtf(clampf(1.0f - cosine * cosine, 0.0f, 1.0f));
    const SkinChain *parent = &plan->chain[chain->parent];
    chain->offset = parent->offset + on_parent - at->along;
}

// Follows a child's axis outward to where it leaves its parent's surface and on to where it is
// clear of it. A chain that never leaves stays hidden.
static void find_exit(const SkinPlan *plan, SkinChain *chain)
{
    const SkinPoint *axis = plan->point + chain->axis;
    int64_t near = skin_axis_sample(plan, chain->parent, chain->attach);
    bool out = false;
    for (int64_t i = 0; i < chain->samples; i++) {
        float on_parent = skin_axis_nearest(plan, chain->parent, axis[i].position, &near);
        SkinPoint there = skin_axis_at(plan, chain->parent, on_parent);
        Vec3 apart = vec3_sub(axis[i].position, there.position);
        float distance = vec3_length(apart);
        there.radius *= skin_girth_toward(plan, chain->parent, &there, apart);
        float lean = clampf(fabsf(vec3_dot(axis[i].tangent, there.tangent)), 0.5f, 1.0f);
        if (!out && distance >= 0.95f * there.radius) {
            out = true;
            note_exit(plan, chain, &axis[i], on_parent);
        }
        chain->start = axis[i].along;
        chain->visible |= out && distance > there.radius + 0.5f * axis[i].radius;
        if (chain->visible && distance >= there.radius + 0.9f * lean * axis[i].radius) {
            break;
        }
    }
}

// Assigns this chain's children their parents: children of a hidden chain, and those that start
// before their parent leaves its own, grow from the grandparent. Pushes the children on the stack.
static void settle_children(SkinPlan *plan, int32_t number, int32_t *stack, int64_t *height)
{
    const SkinChain *chain = &plan->chain[number];
    for (int32_t i = chain->first_child; i >= 0; i = plan->chain[i].next_sibling) {
        SkinChain *child = &plan->chain[i];
        bool inside = !chain->visible || child->attach < chain->exit;
        child->parent = number;
        if (chain->parent >= 0 && inside) {
            child->parent = chain->parent;
            child->attach = chain->attach;
        }
        stack[(*height)++] = i;
    }
}

static bool plan_from(SkinPlan *plan, int32_t root, int32_t **stack, int64_t *capacity, Error *e)
{
    int64_t height = 1;
    if (!memory_reserve(stack, capacity, plan->chain_count, sizeof(int32_t), e)) {
        return false;
    }
    (*stack)[0] = root;
    while (height > 0) {
        int32_t number = (*stack)[--height];
        // Each chain is on the stack at most once, and an axis adds at most one chain.
        if (!skin_plan_axis(plan, number, e) || !skin_girth_make(plan, number, e) ||
            !memory_reserve(stack, capacity, plan->chain_count, sizeof(int32_t), e)) {
            return false;
        }
        SkinChain *chain = &plan->chain[number];
        if (chain->parent >= 0) {
            find_exit(plan, chain);
        } else {
            chain->visible = true;
        }
        settle_children(plan, number, *stack, &height);
    }
    return true;
}

bool skin_plan_init(SkinPlan *plan, const OutTree *tree, const SkinParams *params, const Run *run,
                    Error *e)
{
    *plan = (SkinPlan){.tree = tree, .params = *params};
    int32_t *stack = NULL;
    int64_t capacity = 0;
    bool good = skin_plan_chains(plan, e);
    int64_t first_count = plan->chain_count; // axes add chains, but never roots
    for (int64_t i = 0; good && i < first_count; i++) {
        if (plan->chain[i].base < 0) {
            good = run_is_cancelled(run) ? run_cancel_error(e)
                                         : plan_from(plan, (int32_t)i, &stack, &capacity, e);
        }
    }
    free(stack);
    for (int64_t i = 0; good && i < plan->chain_count; i++) {
        if (plan->chain[i].visible && plan->chain[i].parent >= 0) {
            plan->chain[plan->chain[i].parent].has_children = true;
        }
    }
    return good;
}

void skin_plan_clear(SkinPlan *plan)
{
    free(plan->chain);
    free(plan->node);
    free(plan->chain_of);
    free(plan->place);
    free(plan->point);
    free(plan->girth);
    free(plan->raw);
}
