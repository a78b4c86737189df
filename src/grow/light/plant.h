// A plant that grows by light: its metamers, living and dead. Lengths in internodes; the foot of
// the stem is the origin.
#ifndef RAMIFY_GROW_LIGHT_PLANT_H
#define RAMIFY_GROW_LIGHT_PLANT_H

#include "grow/light/light.h"

enum { PLANT_ALIVE = -1 };

typedef struct Metamer {
    Vec3 position;  // of the upper end
    Vec3 direction; // unit, from the parent
    Vec3 side;      // unit, across: to the first side bud
    uint64_t id;
    int32_t parent;  // -1 = a root; always of lower index
    int32_t next;    // that continues the axis; -1 = none
    int32_t lateral; // the first of the side shoots; -1 = none
    int32_t sibling; // the next side shoot of the same parent; -1 = none
    int32_t season;  // the first in which it has leaves
    int32_t birth;
    int32_t died;  // season; PLANT_ALIVE
    int32_t order; // 0 = stem
    uint32_t buds; // one bit for each living side bud
    bool terminal; // it has the axis's bud
    float vigor;   // of the side branch that begins here: weight of its light at the fork
    float light;   // 0..1 on its leaves; 0 without leaves
    float claim;   // 0..1: share of its light that growth is made of
    float income;  // light of it and all above it
    float claims;  // the same of the light that counts
    float growth;  // metamers that it and all above it may make; shared out downward up
    int32_t leafy; // metamers with leaves, of it and all above it
    int32_t size;  // all living ones
} Metamer;

typedef struct Plant {
    Metamer *metamer;
    int64_t count, capacity;
    int32_t *living; // indices of the living metamers, ascending: each season visits these alone
    int64_t living_count, living_capacity;
} Plant;

// The metamers of a start tree. Ends get a terminal bud; nodes between, above the roots and `bole`
// internodes, side buds.
bool plant_init(Plant *plant, const OutTree *start, const LightParams *params,
                const LightSite *site, Error *e);
void plant_clear(Plant *plant);

// Appends a metamer on `parent`, along the axis or (side >= 0) from side bud number `side`. Returns
// its index, or -1 and e.
int64_t plant_add(Plant *plant, int32_t parent, int side, Vec3 position, Vec3 direction, Error *e);

// Does the metamer have leaves in this season? The last one of an axis, whose bud lives, always.
static inline bool metamer_has_leaves(const Metamer *m, int season, int leaf_seasons)
{
    return m->died == PLANT_ALIVE && m->parent >= 0 &&
           (m->terminal || season - m->season < leaf_seasons);
}

// Drops those that died from the list of the living.
void plant_bury(Plant *plant);

// The box of the living metamers.
Aabb plant_bounds(const Plant *plant);

// The out-tree of the living metamers and of stubs of those that died, with radii.
OutTree *plant_out_tree(const Plant *plant, const LightParams *params, const LightSite *site,
                        Error *e);

#endif
