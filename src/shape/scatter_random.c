#include "base/memory.h"
#include "shape/scatter.h"

#include <stdlib.h>

#define DRAWS_BEFORE_GIVING_UP (int64_t)(1 << 23) // draws without a point
// mean draws per point above which the region counts as empty
#define DRAWS_PER_POINT 100000

// Number of draws for the next round: about twice what is missing, so that few points take few
// draws. The points chosen do not depend on it.
static int64_t round_size(int64_t missing)
{
    int64_t size = missing < SCATTER_ROUND / 2 ? 2 * missing : SCATTER_ROUND;
    return size < 1024 ? 1024 : size;
}

bool scatter_random(const Scatter *scatter, PointSet *points, const Run *run, Error *e)
{
    int64_t wanted = scatter->params->count, drawn = 0;
    int64_t limit = DRAWS_BEFORE_GIVING_UP + DRAWS_PER_POINT * wanted;
    Draw *draws = memory_alloc(SCATTER_ROUND, sizeof *draws, e);
    bool done = draws;
    while (done && points->count < wanted) {
        int64_t size = round_size(wanted - points->count);
        scatter_draw_many(scatter, (uint64_t)drawn, size, draws, run);
        for (int64_t i = 0; done && i < size && points->count < wanted; i++) {
            if (draws[i].kept) {
                done = points_add(points, draws[i].position, draws[i].normal, draws[i].id, e);
            }
        }
        drawn += size;
        if (done && points->count < wanted &&
            (drawn >= limit || (points->count == 0 && drawn >= DRAWS_BEFORE_GIVING_UP))) {
            done = scatter_empty_error(scatter, drawn, e);
        }
        if (done && run_is_cancelled(run)) {
            done = run_cancel_error(e);
        }
        run_progress(run, "scatter", (double)points->count / (double)wanted);
    }
    free(draws);
    return done;
}
