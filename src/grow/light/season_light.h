// The light of a season about one plant: on a grid of its own, or on the one that it shares with
// its rivals.
#ifndef RAMIFY_GROW_LIGHT_SEASON_LIGHT_H
#define RAMIFY_GROW_LIGHT_SEASON_LIGHT_H

#include "grow/light/around.h"

#define SEASON_LIGHT_CELL 1.5f // internodes, of the voxels

typedef struct SeasonLight {
    const LightSite *site;
    ShadeGrid *grid;                     // NULL = it is shared
    const struct LightStand *stand;      // where; NULL = by the site's room
    const struct Attractors *attractors; // that draw the plant's buds; NULL = none
} SeasonLight;

// Lets the plant meet its rivals and carries light through all leaves. Free with
// season_light_clear.
bool season_light_init(SeasonLight *light, const Plant *plant, const LightParams *params,
                       Around *around, int season, const Run *run, Error *e);
void season_light_clear(SeasonLight *light);

// As shade_grid_light and shade_grid_brightest. p: internodes.
float season_light_at(const SeasonLight *light, Vec3 p);
Vec3 season_light_brightest(const SeasonLight *light, Vec3 p);

#endif
