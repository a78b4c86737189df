#include "grow/report.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>

enum { MAX_WARNINGS = 4 };

void grow_report_format(const GrowReport *report, const ColonizeParams *params, char *text,
                        int size)
{
    size_t n = size > 0 ? (size_t)size : 0;
    long long steps = report->steps, nodes = report->new_nodes, left = report->attractors_left;
    switch (report->stop) {
    case STOP_OUT_OF_REACH:
        if (isfinite(report->nearest)) {
            snprintf(
                text, n,
                "no attractor in reach of root %d: influence %.3g m, nearest attractor %.3g m; "
                "raise growth.levels[].influence",
                report->root, (double)report->influence, (double)report->nearest);
        } else {
            snprintf(text, n,
                     "there are no attractors to grow toward; raise growth.levels[].attractors");
        }
        break;
    case STOP_MAX_STEPS:
        snprintf(text, n,
                 "stopped after %lld steps: %lld new nodes, %lld attractors left; raise "
                 "growth.max_steps %lld to grow on",
                 steps, nodes, left, (long long)params->max_steps);
        break;
    case STOP_MAX_NODES:
        snprintf(text, n,
                 "stopped after %lld steps: %lld new nodes, %lld attractors left; raise "
                 "growth.max_nodes %lld to grow on",
                 steps, nodes, left, (long long)params->max_nodes);
        break;
    case STOP_NO_PULL:
        snprintf(text, n,
                 "grown until no attractor pulls: %lld new nodes in %lld steps, %lld attractors "
                 "left",
                 nodes, steps, left);
        break;
    }
}

static int32_t root_of(const OutTree *tree, int64_t node)
{
    while (tree->parent[node] >= 0) {
        node = tree->parent[node];
    }
    return (int32_t)node;
}

static float nearest_to(Vec3 p, const PointSet *attractors)
{
    float best = INFINITY;
    for (int64_t a = 0; a < attractors->count; a++) {
        Vec3 v = vec3_sub(attractors->position[a], p);
        float d = vec3_dot(v, v);
        best = d < best ? d : best;
    }
    return sqrtf(best);
}

bool reach_measure(const OutTree *tree, const PointSet *attractors, GrowReport *report,
                   const Run *run, Error *e)
{
    report->nearest = INFINITY;
    report->root = 0;
    int64_t node = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (run_is_cancelled(run)) { // each node looks at all attractors
            return run_cancel_error(e);
        }
        float d = nearest_to(tree->position[i], attractors);
        if (d < report->nearest) {
            report->nearest = d;
            node = i;
        }
    }
    report->root = root_of(tree, node);
    return true;
}

static float nearest_node(const OutTree *tree, Vec3 p)
{
    float best = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 v = vec3_sub(tree->position[i], p);
        float d = vec3_dot(v, v);
        best = d < best ? d : best;
    }
    return sqrtf(best);
}

// Counts the attractors without a nearest node; measures every stride-th of them (0 = none).
static int64_t visit_unreached(const OutTree *tree, const AttractorGrid *grid, int64_t stride,
                               GrowReport *report)
{
    int64_t count = 0;
    for (int64_t c = 0; c < grid->cell_count; c++) {
        for (int32_t i = 0; i < grid->cells[c].count; i++) {
            int64_t b = grid->cells[c].first_block + i / LANES;
            const AttractorBlock *block = &grid->block[b];
            int lane = i % LANES;
            if (block->nearest[lane] >= 0) {
                continue;
            }
            if (stride > 0 && count % stride == 0) {
                float d = nearest_node(tree, vec3(block->x[lane], block->y[lane], block->z[lane]));
                report->nearest = d < report->nearest ? d : report->nearest;
                report->furthest = d > report->furthest ? d : report->furthest;
            }
            count++;
        }
    }
    return count;
}

void reach_measure_left(const OutTree *tree, const AttractorGrid *grid, int64_t attractors,
                        GrowReport *report)
{
    enum { MAX_MEASURED = 256 };
    report->unreached = visit_unreached(tree, grid, 0, report);
    if (report->unreached > 0 && 10 * report->unreached >= attractors) {
        report->nearest = INFINITY;
        visit_unreached(tree, grid, 1 + report->unreached / MAX_MEASURED, report);
    }
}

// Per node the root of its tree; per root whether an attractor pulls any node of its tree.
static void find_roots(const OutTree *tree, const NodeBits *pulled, int32_t *root, bool *is_pulled)
{
    for (int64_t i = 0; i < tree->count; i++) { // parents come first
        root[i] = tree->parent[i] < 0 ? (int32_t)i : root[tree->parent[i]];
        is_pulled[root[i]] |= pulled->word[i >> 6] >> (i & 63) & 1;
    }
}

// For roots that nothing pulls: distance of their trees from the nearest attractor, m.
static bool measure_unpulled(const OutTree *tree, const PointSet *attractors, const int32_t *root,
                             const bool *is_pulled, float *nearest, const Run *run, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        nearest[i] = INFINITY;
        if (run_is_cancelled(run)) { // each node looks at all attractors
            return run_cancel_error(e);
        }
        if (!is_pulled[root[i]]) {
            float d = nearest_to(tree->position[i], attractors);
            nearest[root[i]] = d < nearest[root[i]] ? d : nearest[root[i]];
        }
    }
    return true;
}

static void warn_of_root(int32_t root, float nearest, const ColonizeParams *params, const Run *run)
{
    GrowReport report = {.stop = STOP_OUT_OF_REACH,
                         .nearest = nearest,
                         .root = root,
                         .influence = params->influence};
    char text[256];
    grow_report_format(&report, params, text, sizeof text);
    run_warn(run, "%s", text);
}

bool reach_warn(const OutTree *tree, const ColonizeParams *params, const PointSet *attractors,
                const NodeBits *pulled, const Run *run, Error *e)
{
    if (!run->warn) {
        return true;
    }
    int32_t *root = memory_alloc(tree->count, sizeof *root, e);
    bool *is_pulled = memory_alloc_zero(tree->count, sizeof *is_pulled, e);
    float *nearest = memory_alloc(tree->count, sizeof *nearest, e);
    bool done = root && is_pulled && nearest;
    if (done) {
        find_roots(tree, pulled, root, is_pulled);
        done = measure_unpulled(tree, attractors, root, is_pulled, nearest, run, e);
    }
    int warnings = 0;
    for (int32_t i = 0; done && i < tree->count && warnings < MAX_WARNINGS; i++) {
        if (root[i] == i && !is_pulled[i] && nearest[i] >= params->influence) {
            warn_of_root(i, nearest[i], params, run);
            warnings++;
        }
    }
    free(root);
    free(is_pulled);
    free(nearest);
    return done;
}
