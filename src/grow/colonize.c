#include "base/memory.h"
#include "grow/report.h"
#include "grow/rules/rule.h"

#include "base/exact_math.h"

#include <stdlib.h>
#include <string.h>

// Least number of growers or cells worth sharing among threads.
enum { MIN_SHARED = 64 };

ColonizeParams colonize_params_default(void)
{
    return (ColonizeParams){.sector_angle = 60.0f, .seed = 1};
}

void colonize_auto(ColonizeParams *params, double spacing, float step, float kill, float influence)
{
    float *length[3] = {&params->step, &params->kill, &params->influence};
    const float multiple[3] = {step, kill, influence};
    for (int i = 0; i < 3; i++) {
        if (*length[i] == 0.0f) {
            *length[i] = (float)((double)multiple[i] * spacing);
        }
    }
}

static bool check_params(const OutTree *tree, const ColonizeParams *params, Error *e)
{
    const char *name[3] = {"step", "kill", "influence"};
    const float length[3] = {params->step, params->kill, params->influence};
    for (int i = 0; i < 3; i++) {
        if (!(length[i] >= 1e-12f && length[i] <= 1e12f)) {
            error_set(e, ERROR_INPUT, "%s is %g m; it must be at least 1e-12 and at most 1e12 m",
                      name[i], (double)length[i]);
            return error_key(e, "%s", name[i]);
        }
    }
    if (params->kill >= params->influence) {
        error_set(e, ERROR_INPUT,
                  "kill %.3g m is not below influence %.3g m, so nothing can grow; lower kill or "
                  "raise influence",
                  (double)params->kill, (double)params->influence);
        return error_key(e, "kill");
    }
    if (!vec3_finite(params->tropism) || !isfinite(params->noise) || params->noise < 0.0f ||
        !isfinite(params->field_weight)) {
        return error_set(e, ERROR_INPUT,
                         "noise, tropism and field_weight must be finite, and noise not negative");
    }
    if (tree->count < 1) {
        return error_set(e, ERROR_INPUT, "growth has no point to start from; give it a root");
    }
    for (int64_t i = 0; i < tree->count; i++) {
        if (!vec3_finite(tree->position[i]) || !vec3_finite(tree->normal[i])) {
            return error_set(e, ERROR_INPUT, "the growth's starting point %lld is not finite",
                             (long long)i);
        }
    }
    return true;
}

static void set_angle_limits(Growth *growth)
{
    const ColonizeParams *p = growth->params;
    growth->limits.min_cos = 2.0f; // off: no cosine exceeds it
    growth->limits.max_cos = -2.0f;
    if (p->min_angle > 0.0f) {
        exact_sincos(p->min_angle * RADIANS_PER_DEGREE, &growth->limits.min_sin,
                     &growth->limits.min_cos);
    }
    if (p->max_angle > 0.0f && p->max_angle < 180.0f) {
        exact_sincos(p->max_angle * RADIANS_PER_DEGREE, &growth->limits.max_sin,
                     &growth->limits.max_cos);
    }
    growth->limits.cone_cos = -2.0f;
    growth->limits.cone_axis = vec3_normalize(p->cone_axis);
    if (p->cone_angle > 0.0f && p->cone_angle < 180.0f) {
        exact_sincos(p->cone_angle * RADIANS_PER_DEGREE, &growth->limits.cone_sin,
                     &growth->limits.cone_cos);
    }
}

// Reserves the per-node state of nodes `from`..count-1, which may not exist yet.
static bool reserve_nodes(Growth *growth, int64_t from, int64_t count, Error *e)
{
    int64_t words = growth->changed.capacity;
    if (!memory_reserve(&growth->state, &growth->state_capacity, count, sizeof *growth->state, e) ||
        !memory_reserve(&growth->slot, &growth->slot_capacity, count, sizeof *growth->slot, e) ||
        !memory_reserve(&growth->changed.word, &growth->changed.capacity, count / 64 + 1,
                        sizeof *growth->changed.word, e)) {
        return false;
    }
    memset(growth->changed.word + words, 0,
           (size_t)(growth->changed.capacity - words) * sizeof *growth->changed.word);
    for (int64_t i = from; i < count; i++) {
        growth->state[i] = (NodeState){.first_child = -1};
        growth->slot[i] = -1;
    }
    return !growth->rule->reserve || growth->rule->reserve(growth, from, count, e);
}

static void count_child(Growth *growth, int32_t parent, int32_t child, int bin)
{
    NodeState *state = &growth->state[parent];
    const Rule *rule = growth->rule;
    bool side = rule->is_side ? rule->is_side(bin) : state->children > 0;
    growth->state[child].order = state->order + (side && growth->tree->parent[parent] >= 0);
    if (state->children++ == 0) {
        state->first_child = child;
    }
}

// Initialises the state from the existing tree: counts children and marks their bins as taken.
static bool begin(Growth *growth, Error *e)
{
    const OutTree *tree = growth->tree;
    if (!reserve_nodes(growth, 0, tree->count, e)) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (parent >= 0 && growth->state[parent].first_child < 0) {
            growth->state[parent].first_child = (int32_t)i; // defines a root's heading
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            int bin = growth->rule->seat ? growth->rule->seat(growth, i) : 0;
            count_child(growth, tree->parent[i], (int32_t)i, bin);
        }
    }
    for (int64_t i = 0; growth->params->new_orders && i < tree->count; i++) {
        growth->state[i].order = 0;
    }
    return true;
}

// A node that grew while its attractors stayed the same would make the same child again: they no
// longer pull it. (A node only ever loses attractors, so this is permanent.)
static void drop_fruitless(Growth *growth)
{
    for (int64_t i = 0; i < growth->grew_count; i++) {
        int32_t node = growth->grew[i];
        if (growth->rule->once || !(growth->changed.word[node >> 6] >> (node & 63) & 1)) {
            growth->state[node].stalled = true;
        }
    }
}

static bool may_grow(const Growth *growth, int64_t node)
{
    int limit = growth->params->max_children;
    if (growth->rule->once && growth->state[node].children > 0) {
        return false;
    }
    return !growth->state[node].stalled && (limit <= 0 || growth->state[node].children < limit);
}

// Turns the changed nodes that may grow into growers, in index order, and clears the marks.
static bool choose_growers(Growth *growth, Error *e)
{
    growth->grower_count = 0;
    int64_t words = (growth->tree->count + 63) / 64;
    for (int64_t w = 0; w < words; w++) {
        for (uint64_t bits = growth->changed.word[w]; bits; bits &= bits - 1) {
            int64_t node = w * 64 + __builtin_ctzll(bits);
            if (!may_grow(growth, node)) {
                continue;
            }
            if (!memory_reserve(&growth->grower, &growth->grower_capacity, growth->grower_count + 1,
                                sizeof *growth->grower, e)) {
                return false;
            }
            growth->slot[node] = (int32_t)growth->grower_count;
            growth->grower[growth->grower_count++] = (Grower){.node = (int32_t)node};
        }
        growth->changed.word[w] = 0;
    }
    int64_t count = growth->grower_count, children = count * growth->bins;
    return memory_reserve(&growth->pull, &growth->pull_capacity, children * growth->threads,
                          sizeof *growth->pull, e) &&
           memory_reserve(&growth->child, &growth->child_capacity, children, sizeof *growth->child,
                          e) &&
           memory_reserve(&growth->child_count, &growth->child_count_capacity, count,
                          sizeof *growth->child_count, e) &&
           memory_reserve(&growth->grew, &growth->grew_capacity, count, sizeof *growth->grew, e);
}

// Turns children out of taken space and drops those that cannot; returns how many remain.
static int keep_free(const Growth *growth, const Grower *grower, Child *child, int count)
{
    const Room *room = growth->params->room;
    Vec3 normal = growth->params->on_surface ? grower->normal : vec3(0, 0, 0);
    int kept = 0;
    for (int i = 0; i < count; i++) {
        if (!room || room_give_way(room, grower->position, normal, &child[i].position)) {
            child[kept++] = child[i];
        }
    }
    return kept;
}

static void prepare_grower(Growth *growth, int64_t i)
{
    if (!run_is_cancelled(growth->run)) { // a field may list many lines of nuclei
        growth_prepare(growth, &growth->grower[i]);
    }
}

static void make_children_of(Growth *growth, int64_t i)
{
    const Grower *grower = &growth->grower[i];
    Child *child = &growth->child[i * growth->bins];
    int count = growth_make_children(growth, grower, &growth->pull[i * growth->bins], child);
    growth->child_count[i] = keep_free(growth, grower, child, count);
}

static void make_children(Growth *growth)
{
    int64_t growers = growth->grower_count;
    bool shared = growers >= MIN_SHARED && growth->grid.active_count >= MIN_SHARED;
    int threads = shared ? growth->grid.slab_count : 1;
    bool early = growth_sums_need_frames(growth); // else no thread waits for the frames
#pragma omp parallel num_threads(threads) if (threads > 1)
    {
        if (early) {
#pragma omp for schedule(static)
            for (int64_t i = 0; i < growers; i++) {
                prepare_grower(growth, i);
            }
        }
#pragma omp for schedule(static, 1)
        for (int part = 0; part < threads; part++) {
            growth_sum_part(growth, part, threads);
        }
#pragma omp for schedule(dynamic, MIN_SHARED)
        for (int64_t i = 0; i < growers; i++) {
            if (!early) {
                prepare_grower(growth, i);
            }
            if (!run_is_cancelled(growth->run)) {
                growth_merge_pulls(growth, i, threads);
                make_children_of(growth, i);
            }
        }
    }
}

static bool add_child(Growth *growth, int32_t parent, const Child *child, int32_t birth, Error *e)
{
    OutTree *tree = growth->tree;
    uint64_t id = out_tree_child_id(tree->id[parent], growth->state[parent].children);
    int64_t node =
        out_tree_add_node(tree, child->position, parent, birth, tree->colony[parent], id, e);
    if (node < 0) {
        return false;
    }
    tree->normal[node] = child->normal;
    count_child(growth, parent, (int32_t)node, child->bin);
    if (growth->rule->note) {
        growth->rule->note(growth, parent, node, child->bin);
    }
    return true;
}

// Adds this step's children to the tree; false with *full set when max_nodes is reached.
static bool add_children(Growth *growth, int32_t birth, bool *full, Error *e)
{
    int64_t max_nodes = growth->params->max_nodes, first = growth->tree->count, count = first;
    growth->grew_count = 0;
    for (int64_t i = 0; i < growth->grower_count; i++) {
        count += growth->child_count[i];
    }
    if (!reserve_nodes(growth, first, count, e)) {
        return false;
    }
    for (int64_t i = 0; i < growth->grower_count; i++) {
        int32_t node = growth->grower[i].node;
        growth->slot[node] = -1;
        for (int j = 0; j < growth->child_count[i] && !*full; j++) {
            *full = max_nodes > 0 && growth->tree->count >= max_nodes;
            if (!*full &&
                !add_child(growth, node, &growth->child[i * growth->bins + j], birth, e)) {
                return false;
            }
        }
        if (growth->child_count[i] > 0) {
            growth->grew[growth->grew_count++] = node;
        }
    }
    return true;
}

// After the first search: reports attractors and roots out of reach.
static bool check_reach(const Growth *growth, const Run *run, GrowReport *report, Error *e)
{
    bool killed = growth->grid.alive < growth->attractors->count;
    if (growth->grid.active_count == 0 && !killed) {
        report->stop = STOP_OUT_OF_REACH;
        return reach_measure(growth->tree, growth->attractors, report, run, e);
    }
    return reach_warn(growth->tree, growth->params, growth->attractors, &growth->changed, run, e);
}

// Tells rivals the nodes from `seen` on, waits for this growth's turn, and lets the attractors see
// all new nodes.
static bool update_attractors(Growth *growth, int64_t seen, Error *e)
{
    const Room *room = growth->params->room;
    NewNodes nodes = {.tree = growth->tree, .first = seen};
    if (room && room->meet &&
        !room->meet(room->user, growth->tree, seen, &nodes.rival, &nodes.rival_count, e)) {
        return false;
    }
    attractor_grid_update(&growth->grid, &nodes, growth->run, growth->threads, &growth->changed);
    return !run_is_cancelled(growth->run) || run_cancel_error(e);
}

// Iterates until nothing grows or a limit is reached.
static bool grow(Growth *growth, const Run *run, GrowReport *report, Error *e)
{
    const ColonizeParams *params = growth->params;
    double attractors = (double)growth->attractors->count + 1.0;
    int64_t seen = 0;
    bool full = false;
    for (;;) {
        growth->grid.now = params->first_step + (int32_t)report->steps;
        if (!update_attractors(growth, seen, e)) {
            return false;
        }
        seen = growth->tree->count;
        if (report->steps == 0 && !check_reach(growth, run, report, e)) {
            return false;
        }
        if (full || (params->max_steps > 0 && report->steps >= params->max_steps)) {
            report->stop = full ? STOP_MAX_NODES : STOP_MAX_STEPS;
            return true;
        }
        run_progress(run, "grow", 1.0 - (double)growth->grid.alive / attractors);
        drop_fruitless(growth);
        if (!choose_growers(growth, e)) {
            return false;
        }
        make_children(growth);
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        int64_t birth = params->first_step + report->steps + 1;
        if (!add_children(growth, (int32_t)birth, &full, e)) {
            return false;
        }
        if (growth->tree->count == seen) {
            report->stop = full ? STOP_MAX_NODES : report->stop;
            return true;
        }
        report->steps++;
    }
}

static void free_growth(Growth *growth)
{
    attractor_grid_free(&growth->grid);
    if (growth->rule->end) {
        growth->rule->end(growth);
    }
    free(growth->state);
    free(growth->slot);
    free(growth->changed.word);
    free(growth->grower);
    free(growth->pull);
    free(growth->child);
    free(growth->child_count);
    free(growth->grew);
}

static bool record_attractors(Growth *growth, Error *e)
{
    const ColonizeParams *params = growth->params;
    AttractorLog *log = params->log;
    if (!log) {
        return true;
    }
    int64_t first = log->count;
    if (!attractor_log_add(log, growth->attractors, params->kill, params->influence,
                           params->first_step, e)) {
        return false;
    }
    growth->grid.removed = log->removed + first;
    return true;
}

static bool prepare(Growth *growth, Error *e)
{
    const ColonizeParams *params = growth->params;
    if (!check_params(growth->tree, params, e)) {
        return false;
    }
    set_angle_limits(growth);
    growth->bins = 1;
    if (growth->rule->begin && !growth->rule->begin(growth, e)) {
        return false;
    }
    return begin(growth, e) &&
           (growth->attractors->count == 0 ||
            (attractor_grid_init(&growth->grid, growth->attractors, params->influence, params->kill,
                                 growth->run, e) &&
             record_attractors(growth, e)));
}

static const Rule *rule_of(GrowRule rule)
{
#define RULE_ENTRY(NAME, VALUE, DOC) [VALUE] = &rule_##NAME,
    static const Rule *const rules[] = {GROWTH_RULES(RULE_ENTRY)};
#undef RULE_ENTRY
    return rules[rule];
}

static int clamp_threads(int threads)
{
    return threads < 1 ? 1 : (threads > ATTRACTOR_MAX_SLABS ? ATTRACTOR_MAX_SLABS : threads);
}

// Grows toward the attractors, all of which the room allows.
static bool colonize_allowed(OutTree *tree, const PointSet *attractors,
                             const ColonizeParams *params, const Run *run, GrowReport *report,
                             Error *e)
{
    Growth growth = {.tree = tree,
                     .attractors = attractors,
                     .params = params,
                     .rule = rule_of(params->rule),
                     .initial_count = tree->count,
                     .run = run,
                     .threads = clamp_threads(run->threads)};
    int64_t before = tree->count;
    bool grown = prepare(&growth, e);
    if (grown && attractors->count == 0) {
        report->stop = STOP_OUT_OF_REACH;
        report->nearest = INFINITY;
    } else if (grown) {
        grown = grow(&growth, run, report, e);
        if (grown && report->stop == STOP_NO_PULL) {
            reach_measure_left(tree, &growth.grid, attractors->count, report);
        }
    }
    report->new_nodes = tree->count - before;
    report->attractors_left = growth.grid.alive;
    free_growth(&growth);
    return grown;
}

bool colonize(OutTree *tree, const PointSet *attractors, const ColonizeParams *params,
              const Run *run, GrowReport *report, Error *e)
{
    GrowReport mine = {.stop = STOP_NO_PULL, .influence = params->influence};
    PointSet *allowed = params->room ? room_allowed_points(params->room, attractors, run, e) : NULL;
    bool grown = (allowed || !params->room) &&
                 colonize_allowed(tree, allowed ? allowed : attractors, params, run, &mine, e);
    points_free(allowed);
    if (report) {
        *report = mine;
    }
    return grown;
}
