// One season of a plant.
#ifndef RAMIFY_GROW_LIGHT_SEASON_H
#define RAMIFY_GROW_LIGHT_SEASON_H

#include "grow/light/season_light.h"

// Catches the season's light, sheds what starves, and makes shoots of what the light gives.
bool plant_grow_season(Plant *plant, const LightParams *params, const LightSite *site,
                       const SeasonLight *light, int season, int threads, Error *e);

#endif
