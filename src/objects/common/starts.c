#include "objects/common/starts.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

static int64_t farthest_along(const PointSet *points, Vec3 direction)
{
    int64_t best = 0;
    for (int64_t i = 1; i < points->count; i++) {
        if (vec3_dot(points->position[i], direction) >
            vec3_dot(points->position[best], direction)) {
            best = i;
        }
    }
    return best;
}

// Lowers gap[i], the distance of point i from all starts, to that from `at`. Returns the point with
// the largest gap.
static int64_t narrow_gaps(float *gap, const PointSet *points, Vec3 at)
{
    int64_t best = 0;
    for (int64_t i = 0; i < points->count; i++) {
        float distance = vec3_distance(points->position[i], at);
        gap[i] = distance < gap[i] ? distance : gap[i];
        best = gap[i] > gap[best] ? i : best;
    }
    return best;
}

bool starts_spread(OutTree *tree, const PointSet *points, Vec3 direction, int count, uint64_t seed,
                   const Run *run, Error *e)
{
    float *gap = memory_alloc(points->count, sizeof *gap, e);
    bool done = gap;
    int64_t next = farthest_along(points, direction);
    int32_t colony = 0;
    for (int64_t i = 0; done && i < points->count; i++) {
        gap[i] = INFINITY;
    }
    for (int64_t i = 0; done && i < tree->count; i++) {
        next = narrow_gaps(gap, points, tree->position[i]);
        colony = tree->colony[i] >= colony ? tree->colony[i] + 1 : colony;
        done = run_goes_on(run, 0, e);
    }
    for (int c = 0; done && c < count && gap[next] > 0.0f; c++, colony++) {
        Vec3 at = points->position[next];
        int64_t node =
            out_tree_add_node(tree, at, -1, 0, colony, random_key(seed, (uint64_t)colony), e);
        done = node >= 0 && run_goes_on(run, 0, e);
        if (done) {
            tree->normal[node] = points->normal[next];
            next = narrow_gaps(gap, points, at);
        }
    }
    free(gap);
    return done;
}
