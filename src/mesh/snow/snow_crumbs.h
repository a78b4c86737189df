// Crumbs: what snow remains on needles and twigs beside the pillows, and at their rims.
#ifndef RAMIFY_MESH_SNOW_SNOW_CRUMBS_H
#define RAMIFY_MESH_SNOW_SNOW_CRUMBS_H

#include "mesh/snow/snow_bed.h"

// Adds crumbs on the bearers of the bed that lie on top and outside of its outline. Their sizes and
// gaps depend on the seed and the bearers' order.
bool snow_add_crumbs(SnowCrumbs *crumbs, const SnowBed *bed, const SnowBearer *bearer,
                     int64_t count, const SnowParams *params, const SnowReach *reach, uint64_t seed,
                     Error *e);

#endif
