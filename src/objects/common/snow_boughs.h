// Snow that lies as pillows on the boughs of a plant with sprays.
#ifndef RAMIFY_OBJECTS_COMMON_SNOW_BOUGHS_H
#define RAMIFY_OBJECTS_COMMON_SNOW_BOUGHS_H

#include "mesh/snow/snow.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

// The pillows on what the object has instanced since the geometry's part `first`, a spray by the
// bough of `tree` that bears it. Free the mesh, which is empty where nothing bears snow; NULL with
// e on failure. *crumbs, initialized to {0}: those beside the pillows; free its list.
Mesh *snow_on_boughs(const OutTree *tree, const SnowParams *params, const SnowReach *reach,
                     int64_t first, const Placing *placing, SnowCrumbs *crumbs, Error *e);

#endif
