// Death of branches for want of light.
#ifndef RAMIFY_GROW_LIGHT_SHED_H
#define RAMIFY_GROW_LIGHT_SHED_H

#include "grow/light/plant.h"

// Kills every side branch whose leaves catch less than light_need on average, or that has none, and
// the stem's branches within `bole` internodes of the ground; side buds that lost their leaves die,
// too. Needs plant_sum_light; income of what is below is not corrected. Returns the number of
// branches.
int64_t plant_shed(Plant *plant, const LightParams *params, int season, float bole);

#endif
