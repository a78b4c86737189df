#include "grow/report.h"

#include <stdio.h>

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

void reach_measure(const OutTree *tree, const PointSet *attractors, GrowReport *report)
{
    report->nearest = INFINITY;
    report->root = 0;
    int64_t node = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        float d = nearest_to(tree->position[i], attractors);
        if (d < report->nearest) {
            report->nearest = d;
            node = i;
        }
    }
    report->root = root_of(tree, node);
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

// Counts the attractors without a nearest node; every stride-th of them is measured, none at 0.
static int64_t visit_unreached(const OutTree *tree, const AttractorGrid *grid, int64_t stride,
                               GrowReport *report)
{
    int64_t count = 0;
    for (int64_t c = 0; c < grid->cell_count; c++) {
        for (int32_t i = 0; i < grid->cells[c].count; i++) {
            int64_t b = grid->cells[c].first_block + i / BLOCK_LANES;
            const AttractorBlock *block = &grid->block[b];
            int lane = i % BLOCK_LANES;
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
    enum { MOST_MEASURED = 256 };
    report->unreached = visit_unreached(tree, grid, 0, report);
    if (report->unreached > 0 && 10 * report->unreached >= attractors) {
        report->nearest = INFINITY;
        visit_unreached(tree, grid, 1 + report->unreached / MOST_MEASURED, report);
    }
}

// Whether an attractor pulls any node of the tree that begins at `root`.
static bool is_pulled(const OutTree *tree, int32_t root, const NodeBits *pulled)
{
    for (int64_t i = root; i < tree->count; i++) {
        if ((pulled->word[i >> 6] >> (i & 63) & 1) && root_of(tree, i) == root) {
            return true;
        }
    }
    return false;
}

void reach_warn(const OutTree *tree, const ColonizeParams *params, const PointSet *attractors,
                const NodeBits *pulled, const Run *run)
{
    if (!run->warn) {
        return;
    }
    int warnings = 0;
    for (int32_t root = 0; root < tree->count && warnings < MAX_WARNINGS; root++) {
        if (tree->parent[root] >= 0 || is_pulled(tree, root, pulled)) {
            continue;
        }
        float best = INFINITY;
        for (int64_t i = root; i < tree->count; i++) {
            if (root_of(tree, i) == root) {
                float d = nearest_to(tree->position[i], attractors);
                best = d < best ? d : best;
            }
        }
        if (best >= params->influence) {
            GrowReport report = {.stop = STOP_OUT_OF_REACH,
                                 .nearest = best,
                                 .root = root,
                                 .influence = params->influence};
            char text[256];
            grow_report_format(&report, params, text, sizeof text);
            run_warn(run, "%s", text);
            warnings++;
        }
    }
}
