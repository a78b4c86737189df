// What is around a plant that grows by light: obstacles, which light does not pass, and the leaves
// of rivals.
#ifndef RAMIFY_GROW_LIGHT_AROUND_H
#define RAMIFY_GROW_LIGHT_AROUND_H

#include "grow/light/plant.h"
#include "grow/light/shade_grid.h"

typedef struct Leaf {
    Vec3 position; // internodes
    int32_t season;
} Leaf;

// Cells that obstacles take, found once.
typedef struct TakenMap {
    int size[3];
    Vec3 low;    // internodes
    float cell;  // internodes
    bool *taken; // NULL = there are no obstacles
} TakenMap;

typedef struct Around {
    const LightSite *site;
    TakenMap map;
    OutTree *shown; // the plant's metamers as rivals see them
    int64_t told;   // of shown: the rivals know these
    Leaf *leaf;     // of rivals, if it does not share its light with them
    int64_t leaf_count, leaf_capacity;
    Vec3 *own_leaf; // m: given to the shared grid
    int64_t own_capacity;
} Around;

bool around_init(Around *around, const LightSite *site, int threads, Error *e);
void around_clear(Around *around);

// Shows the rivals the plant's new metamers, waits for its turn and notes their new leaves. Those
// of more than leaf_seasons seasons are dropped once there are younger ones.
bool around_meet(Around *around, const Plant *plant, int season, int leaf_seasons, Error *e);

// Does the plant read its light from the grid that it shares with its rivals?
bool around_shares_light(const Around *around);

// Gives that grid the plant's leaves. cell: internodes, edge of the voxels.
bool around_give_leaves(Around *around, const Plant *plant, const LightParams *params, float cell,
                        int season, Error *e);

// How far the grid must reach beyond the plant, internodes: 0 if it grows alone.
float around_margin(const Around *around, Aabb plant);

// Adds the shade of obstacles and rivals to a grid.
void around_shade(const Around *around, float leaf_area, ShadeGrid *grid);

#endif
