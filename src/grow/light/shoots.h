// Shoots of one season: where buds grow and how their axes turn.
#ifndef RAMIFY_GROW_LIGHT_SHOOTS_H
#define RAMIFY_GROW_LIGHT_SHOOTS_H

#include "grow/light/plant.h"
#include "grow/light/season_light.h"

// Makes shoots of all buds that get enough growth: a side bud at least 1 metamer, a terminal bud
// half of one. Needs plant_share_growth with this control. Shoots end at taken space, at the
// envelope, and where branches would sink below `low` internodes above the ground.
bool plant_make_shoots(Plant *plant, const LightParams *params, const LightSite *site,
                       const SeasonLight *light, int season, float control, float low, Error *e);

#endif
