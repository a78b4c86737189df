// Measures of corals: thickness of branches, distance between them, seam between colonies.
#include "objects/coral/coral.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

// Is `ancestor` within a few nodes above node?
static bool descends(const OutTree *tree, int64_t node, int64_t ancestor)
{
    for (int i = 0; i < 4 && node > ancestor; i++) {
        node = tree->parent[node];
    }
    return node == ancestor;
}

bool coral_measure(const OutTree *tree, CoralMeasures *m, Error *e)
{
    bool *bears = memory_alloc_zero(tree->count, sizeof *bears, e);
    if (!bears) {
        return false;
    }
    double thickness = 0.0, spacing = 0.0, seam = INFINITY;
    int64_t above = 0, tips = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            bears[tree->parent[i]] = true;
            thickness += 2.0 * (double)tree->radius[i];
            above++;
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        double nearest = INFINITY;
        for (int64_t k = 0; k < tree->count; k++) {
            double d = (double)vec3_distance(tree->position[i], tree->position[k]);
            if (tree->colony[i] != tree->colony[k]) {
                seam = d < seam ? d : seam;
            }
            if (!bears[i] && !bears[k] && i != k && !descends(tree, i, k)) {
                nearest = d < nearest ? d : nearest;
            }
        }
        if (isfinite(nearest)) {
            spacing += nearest;
            tips++;
        }
    }
    free(bears);
    *m = (CoralMeasures){.branch_thickness = above ? thickness / (double)above : (double)NAN,
                         .branch_spacing = tips ? spacing / (double)tips : (double)NAN,
                         .seam = isfinite(seam) ? seam : (double)NAN};
    return true;
}
