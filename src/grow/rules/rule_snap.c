// The reached attractor itself becomes the node (Tanaka fig. 5-6).
#include "grow/rules/rule.h"

#include <string.h>

// Tests the angle limits: this rule cannot rotate a direction.
static bool is_angle_allowed(const Growth *growth, const Grower *grower, Vec3 unit)
{
    if (!grower->has_heading) {
        return true;
    }
    float cosine = vec3_dot(unit, grower->heading);
    bool lateral = growth->state[grower->node].children > 0;
    return cosine >= growth->limits.max_cos && (!lateral || cosine <= growth->limits.min_cos);
}

// Keeps the attractor of least cost: the distance, increased where it disagrees with the grower's
// lean.
static void pick(const Growth *growth, const Grower *grower, Vec3 unit, float distance,
                 int32_t attractor, Pull *pull)
{
    if (!is_angle_allowed(growth, grower, unit)) {
        return;
    }
    Vec3 lean = grower->lean;
    float cost = distance * (1.0f + vec3_length(lean) - vec3_dot(lean, unit));
    cost = cost > 0.0f ? cost : 0.0f;
    uint32_t bits;
    memcpy(&bits, &cost, sizeof bits);
    uint64_t key = (uint64_t)bits << 32 | (uint32_t)attractor;
    pull->pick = key < pull->pick ? key : pull->pick;
}

static bool make_child(const Growth *growth, const Grower *grower, const Pull *pull, Child *child)
{
    if (pull->pick == UINT64_MAX) {
        return false;
    }
    int64_t attractor = (int64_t)(pull->pick & 0xffffffffu);
    Vec3 p = growth->attractors->position[attractor];
    Vec3 d = vec3_normalize(vec3_sub(p, grower->position));
    child->normal = growth->params->on_surface
                        ? vec3_normalize(growth->attractors->normal[attractor])
                        : growth_unit_across(grower->normal, d);
    child->position = growth_add_field(growth, grower, p);
    return true;
}

static int make_children(const Growth *growth, const Grower *grower, const Pull *pull, Child *child)
{
    return growth_make_single(growth, grower, pull, child, make_child);
}

const Rule rule_snap = {.picks = true, .pull = pick, .make_children = make_children};
