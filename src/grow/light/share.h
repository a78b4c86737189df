// Light summed from the tips to the base of a plant, and the growth that it makes shared out from
// the base to the buds.
#ifndef RAMIFY_GROW_LIGHT_SHARE_H
#define RAMIFY_GROW_LIGHT_SHARE_H

#include "grow/light/plant.h"

// Sums light and counts leaves: fills income and leafy of all metamers.
void plant_sum_light(Plant *plant, int season, int leaf_seasons);

// Fills growth: a root gets vigor times its income. At every fork the axis gets the share
// c A / (c A + (1 - c) B), with the light A of what follows on it, B of all side branches and
// buds, and apical control c; side branches share the rest by their light.
void plant_share_growth(Plant *plant, float vigor, float control);

// Light of a metamer's terminal bud and of each of its side buds: together not more than the
// metamer's own.
float metamer_terminal_light(const Metamer *m);
float metamer_bud_light(const Metamer *m);

// Growth that the metamer's terminal bud gets; *each_bud: each of its side buds.
float metamer_bud_growth(const Plant *plant, const Metamer *m, float control, float *each_bud);

#endif
