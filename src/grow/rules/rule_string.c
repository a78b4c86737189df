// Directions chosen by an L-system string; each owns the attractors nearest to it in angle
// (Horiuchi, steps a to f).
#include "base/exact_math.h"
#include "base/memory.h"
#include "grow/rules/rule.h"

#include <stdlib.h>

typedef struct State {
    float group_cos; // of half a group
    float *length;   // growth distance of each attractor, m
    float longest;   // m, the largest of them
    int32_t *place;  // per node: the string's direction it is at
    int64_t place_capacity;
} State;

static float distance_to_root(const Growth *growth, int64_t attractor)
{
    const OutTree *tree = growth->tree;
    float least = INFINITY;
    for (int64_t i = 0; i < growth->initial_count; i++) {
        if (tree->parent[i] < 0) {
            Vec3 d = vec3_sub(growth->attractors->position[attractor], tree->position[i]);
            float d2 = vec3_dot(d, d);
            least = d2 < least ? d2 : least;
        }
    }
    return sqrtf(least);
}

// Growth distance of each attractor (Horiuchi, step c): between the two given lengths, by its
// distance from the nearest root relative to the largest.
static bool set_lengths(const Growth *growth, State *state, float near, float far, Error *e)
{
    int64_t count = growth->attractors->count;
    float furthest = 0.0f;
    for (int64_t i = 0; i < count; i++) {
        if (!run_goes_on(growth->run, i, e)) {
            return false;
        }
        state->length[i] = distance_to_root(growth, i);
        furthest = state->length[i] > furthest ? state->length[i] : furthest;
    }
    for (int64_t i = 0; i < count; i++) {
        state->length[i] = lerpf(near, far, furthest > 0.0f ? state->length[i] / furthest : 0.0f);
    }
    return true;
}

static bool begin(Growth *growth, Error *e)
{
    const ColonizeParams *p = growth->params;
    if (!p->string || !(p->sector_angle > 0.0f && p->sector_angle <= 360.0f)) {
        return error_set(e, ERROR_INPUT,
                         "growth by a string needs one, and groups above 0 and up to 360 degrees");
    }
    State *state = growth->rule_state = memory_alloc_zero(1, sizeof *state, e);
    if (!state ||
        !(state->length = memory_alloc(growth->attractors->count, sizeof *state->length, e))) {
        return false;
    }
    float near = p->length_near > 0.0f ? p->length_near : p->step;
    float far = p->length_far > 0.0f ? p->length_far : p->step, half;
    exact_sincos(0.5f * p->sector_angle * RADIANS_PER_DEGREE, &half, &state->group_cos);
    state->longest = near > far ? near : far;
    growth->bins = p->string->most_followers;
    return set_lengths(growth, state, near, far, e);
}

static void end(Growth *growth)
{
    State *state = growth->rule_state;
    if (state) {
        free(state->length);
        free(state->place);
    }
    free(state);
}

// New nodes are at the string's start until `note` sets their direction.
static bool reserve(Growth *growth, int64_t from, int64_t count, Error *e)
{
    State *state = growth->rule_state;
    if (!memory_reserve(&state->place, &state->place_capacity, count, sizeof *state->place, e)) {
        return false;
    }
    for (int64_t i = from; i < count; i++) {
        state->place[i] = 0;
    }
    return true;
}

static void note(Growth *growth, int32_t parent, int64_t node, int direction)
{
    (void)parent;
    ((State *)growth->rule_state)->place[node] = direction;
}

// The direction that owns an attractor: the nearest in angle, within half a group.
static int bin(const Growth *growth, const Grower *grower, Vec3 unit)
{
    const State *state = growth->rule_state;
    const GrowString *string = growth->params->string;
    const GrowDirection *at = &string->direction[state->place[grower->node]];
    Vec3 local = growth_to_frame(grower, unit);
    float best = state->group_cos;
    int found = -1;
    for (int i = 0; i < at->followers; i++) {
        float cosine = vec3_dot(local, string->direction[at->first + i].heading);
        if (cosine > best) {
            best = cosine;
            found = i;
        }
    }
    return found;
}

static void add_length(const Growth *growth, const Grower *grower, Vec3 unit, float distance,
                       int32_t attractor, Pull *pull)
{
    (void)grower, (void)unit, (void)distance;
    const State *state = growth->rule_state;
    pull->length += (int64_t)(state->length[attractor] / state->longest * PULL_ONE);
}

// Grows along the mean of the attractors owned, by their mean growth distance (Horiuchi, step d).
static bool make_child(const Growth *growth, const Grower *grower, const Pull *pull,
                       const GrowDirection *direction, int place, Child *child)
{
    const State *state = growth->rule_state;
    Vec3 axis = growth_from_frame(grower, direction->heading);
    Vec3 d = vec3_lerp(growth_mean_direction(pull), axis, growth->params->regularity);
    d = vec3_dot(d, d) > 1e-12f ? vec3_normalize(d) : axis;
    float mean = (float)((double)pull->length / (double)pull->count) / PULL_ONE;
    float step = direction->length * mean * state->longest;
    if (!growth_make_child(growth, grower, pull, &d, step, place, child)) {
        return false;
    }
    if (!growth->params->on_surface) {
        Vec3 way = vec3_normalize(vec3_sub(child->position, grower->position));
        child->normal = growth_unit_across(growth_from_frame(grower, direction->normal), way);
    }
    return true;
}

// Each direction that owns attractors makes one child (Horiuchi, steps b-d).
static int make_children(const Growth *growth, const Grower *grower, const Pull *pull, Child *child)
{
    const State *state = growth->rule_state;
    const GrowString *string = growth->params->string;
    const GrowDirection *at = &string->direction[state->place[grower->node]];
    int limit = growth->params->max_children > 0 ? growth->params->max_children : at->followers;
    int count = 0;
    limit = growth_is_last_order(growth, grower->node) ? 1 : limit;
    for (int i = 0; i < at->followers && count < limit; i++) {
        uint64_t bud = out_tree_child_id(growth->tree->id[grower->node], -1 - i);
        if (pull[i].count > 0 && !(i > 0 && growth_is_suppressed(growth, bud)) &&
            make_child(growth, grower, &pull[i], &string->direction[at->first + i], count,
                       &child[count])) {
            child[count++].bin = at->first + i;
        }
    }
    return count;
}

const Rule rule_string = {.roots_head = true,
                          .once = true,
                          .begin = begin,
                          .end = end,
                          .reserve = reserve,
                          .note = note,
                          .bin = bin,
                          .pull = add_length,
                          .make_children = make_children};
