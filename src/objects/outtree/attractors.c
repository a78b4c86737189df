// The attractors of a grown out-tree: at the time of growth that is seen, carried along, exported.
#include "base/memory.h"
#include "objects/outtree/outtree.h"

#include <stdlib.h>

void outtree_free_attractors(void *log)
{
    if (log) {
        attractor_log_clear(log);
    }
    free(log);
}

// Moves the attractors left as the nodes were: as roots of an out-tree of their own.
static bool carry_attractors(const Carrier *carrier, AttractorLog *log, Error *e)
{
    OutTree *points = out_tree_new(e);
    bool done = points && out_tree_reserve(points, log->count, e);
    for (int64_t i = 0; done && i < log->count; i++) {
        done = out_tree_add_node(points, log->position[i], -1, 0, 0, (uint64_t)i, e) >= 0;
    }
    done = done && carrier->carry(carrier->user, points, e);
    for (int64_t i = 0; done && i < log->count; i++) {
        log->position[i] = points->position[i];
    }
    out_tree_free(points);
    return done;
}

bool outtree_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e)
{
    (void)params;
    AttractorLog *then = memory_alloc_zero(1, sizeof *then, e);
    grown->state = then;
    grown->free_state = outtree_free_attractors;
    return then && attractor_log_at(whole->state, out_tree_last_birth(grown->tree), then, e) &&
           (!recipe->carrier || then->count == 0 || carry_attractors(recipe->carrier, then, e));
}

bool outtree_points(const Grown *grown, PointSet *points, Error *e)
{
    const AttractorLog *log = grown->state;
    bool done = true;
    for (int64_t i = 0; done && i < log->count; i++) {
        done = points_add(points, log->position[i], log->normal[i], (uint64_t)i, e);
    }
    return done;
}
