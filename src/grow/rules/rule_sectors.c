// Pulls are binned by angle about the heading; at most one child grows from each sector over a
// node's life.
#include "base/memory.h"
#include "grow/rules/rule.h"
#include "grow/rules/sectors.h"

#include <stdlib.h>
#include <string.h>

typedef struct State {
    SectorTable table;
    uint64_t *used; // per node: bits of the sectors that have their child
    int64_t used_capacity;
} State;

static bool begin(Growth *growth, Error *e)
{
    const ColonizeParams *params = growth->params;
    State *state = growth->rule_state = memory_alloc_zero(1, sizeof *state, e);
    if (!state || !sectors_init(&state->table, params->sector_angle, params->on_surface, e)) {
        return false;
    }
    growth->bins = state->table.count;
    return true;
}

static void end(Growth *growth)
{
    State *state = growth->rule_state;
    if (state) {
        free(state->used);
    }
    free(state);
}

static bool reserve(Growth *growth, int64_t from, int64_t count, Error *e)
{
    State *state = growth->rule_state;
    if (!memory_reserve(&state->used, &state->used_capacity, count, sizeof *state->used, e)) {
        return false;
    }
    memset(state->used + from, 0, (size_t)(count - from) * sizeof *state->used);
    return true;
}

static void use(Growth *growth, int32_t parent, int64_t node, int sector)
{
    (void)node;
    ((State *)growth->rule_state)->used[parent] |= 1ull << sector;
}

static int seat(Growth *growth, int64_t node)
{
    const State *state = growth->rule_state;
    const OutTree *tree = growth->tree;
    Grower parent = {.node = tree->parent[node]};
    growth_prepare(growth, &parent);
    Vec3 d = vec3_sub(tree->position[node], parent.position);
    int sector = sectors_find(&state->table, growth_to_frame(&parent, d));
    use(growth, parent.node, node, sector);
    return sector;
}

static bool is_side(int sector)
{
    return sector > 0;
}

static int bin(const Growth *growth, const Grower *grower, Vec3 unit)
{
    const State *state = growth->rule_state;
    return grower->has_heading ? sectors_find(&state->table, growth_to_frame(grower, unit)) : 0;
}

static bool make_mean_child(const Growth *growth, const Grower *grower, const Pull *pull,
                            Child *child)
{
    return growth_make_child(growth, grower, pull, NULL, growth->params->step, 0, child);
}

// Whether the sector can never grow a child, whatever pulls.
static bool is_closed(const Growth *growth, const Grower *grower, int sector)
{
    const State *state = growth->rule_state;
    uint64_t bud = out_tree_child_id(growth->tree->id[grower->node], -1 - sector);
    bool beyond = state->table.axis[sector].x < growth->limits.max_cos - 1e-6f;
    bool barred = sector > 0 &&
                  (growth_is_last_order(growth, grower->node) || growth_is_suppressed(growth, bud));
    return beyond || barred || (state->used[grower->node] >> sector & 1);
}

static int make_children(const Growth *growth, const Grower *grower, const Pull *pull, Child *child)
{
    if (!grower->has_heading) {
        return growth_make_single(growth, grower, pull, child, make_mean_child);
    }
    const ColonizeParams *params = growth->params;
    const SectorTable *table = &((State *)growth->rule_state)->table;
    int count = 0, limit = params->max_children > 0
                               ? params->max_children - growth->state[grower->node].children
                               : table->count;
    for (int s = 0; s < table->count && count < limit; s++) {
        if (pull[s].count == 0 || is_closed(growth, grower, s)) {
            continue;
        }
        Vec3 axis = growth_from_frame(grower, table->axis[s]);
        if (growth_make_child(growth, grower, &pull[s], params->sector_axis ? &axis : NULL,
                              params->step, count, &child[count])) {
            child[count++].bin = s;
        }
    }
    return count;
}

const Rule rule_sectors = {.roots_head = true,
                           .begin = begin,
                           .end = end,
                           .reserve = reserve,
                           .seat = seat,
                           .note = use,
                           .is_side = is_side,
                           .bin = bin,
                           .make_children = make_children};
