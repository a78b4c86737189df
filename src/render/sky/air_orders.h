// Fills the table of light scattered more than once.
#ifndef RAMIFY_RENDER_SKY_AIR_ORDERS_H
#define RAMIFY_RENDER_SKY_AIR_ORDERS_H

#include "base/error.h"
#include "base/run.h"
#include "render/sky/air_glow.h"

// Light scattered once and twice is found with the true phase functions in every direction, as
// Bruneton and Neyret 2008 do order by order; all further orders by a geometric series, for each
// is to the one before as that is to its own. By run->threads threads. False: out of memory.
// sine: of the sun's elevation near the ground; see air_glow_set_suns.
bool air_orders_fill(AirGlow *glow, const AirModel *model, double sine, const Run *run, Error *e);

#endif
