// Attractors that the buds of a plant reach for beside light (Palubicki et al. 2009: space
// colonization tells a bud's free space, and with it its environment's quality and the best
// direction). Each draws the nearest metamer with buds in its reach; one that a metamer comes near
// is taken. Where growth is made of light and shared, the light of a metamer that is not drawn
// counts less; whether a branch starves depends on light alone.
#ifndef RAMIFY_GROW_LIGHT_ATTRACTORS_H
#define RAMIFY_GROW_LIGHT_ATTRACTORS_H

#include "grow/light/plant.h"

typedef struct Attractors {
    const LightAttractors *params; // NULL = there are none
    Vec3 *position;                // internodes, of those that are left
    int64_t count;
    bool found;        // one has drawn a bud
    Vec3 *mean;        // per metamer: of the attractors that it is drawn by, internodes
    int32_t *drawn_by; // per metamer: their number
    int64_t mean_capacity, drawn_capacity, metamers;
} Attractors;

bool attractors_init(Attractors *attractors, const LightSite *site, Error *e);
void attractors_clear(Attractors *attractors);

// Removes the attractors that the plant has reached, allots the others to its metamers with leaves
// and buds and sets these metamers' claims. The result does not depend on the number of threads.
bool attractors_draw(Attractors *attractors, Plant *plant, int season, int leaf_seasons,
                     int threads, Error *e);

// Turn from `at`, on a shoot that begins at metamer number `base`, toward what draws that: of
// length LightAttractors.pull, or 0.
Vec3 attractors_pull(const Attractors *attractors, int64_t base, Vec3 at);

#endif
