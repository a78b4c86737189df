#include "objects/common/thinning.h"

#include <math.h>
#include <stdbool.h>

static double cost_of(const ThinnedLeaves *kind, bool by_faces)
{
    return by_faces ? kind->faces : 1.0;
}

// The factor on area / sqrt(cost) that gives each kind's number, if those that it would give more
// than all keep all.
static double factor_for(const ThinnedLeaves *kind, int kinds, double most, bool by_faces)
{
    double factor = INFINITY;
    for (int round = 0; round <= kinds; round++) { // each round but the last fills a kind or more
        double left = most, wanted = 0.0;
        for (int i = 0; i < kinds; i++) {
            double cost = cost_of(&kind[i], by_faces), rank = kind[i].area / sqrt(cost);
            if (round > 0 && factor * rank >= (double)kind[i].count) {
                left -= cost * (double)kind[i].count;
            } else {
                wanted += cost * rank;
            }
        }
        if (!(wanted > 0.0)) {
            return INFINITY;
        }
        double next = fmax(left, 0.0) / wanted;
        if (next == factor) {
            break;
        }
        factor = next;
    }
    return factor;
}

static void limit(ThinnedLeaves *kind, int kinds, double most, bool by_faces)
{
    double all = 0.0;
    for (int i = 0; i < kinds; i++) {
        all += cost_of(&kind[i], by_faces) * (double)kind[i].count;
    }
    if (all <= most) {
        return;
    }
    double factor = factor_for(kind, kinds, most, by_faces);
    for (int i = 0; i < kinds; i++) {
        double kept = factor * kind[i].area / sqrt(cost_of(&kind[i], by_faces));
        double share = kind[i].count > 0 ? kept / (double)kind[i].count : 1.0;
        kind[i].share = fmin(kind[i].share, share);
    }
}

void thinning_shares(ThinnedLeaves *kind, int kinds, double most_leaves, double most_faces)
{
    for (int i = 0; i < kinds; i++) {
        kind[i].share = 1.0;
    }
    limit(kind, kinds, most_leaves, false);
    limit(kind, kinds, most_faces, true);
}
