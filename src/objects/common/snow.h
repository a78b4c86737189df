// Snow that has settled on a plant: cushions on its branches and on its sprays of needles.
#ifndef RAMIFY_OBJECTS_COMMON_SNOW_H
#define RAMIFY_OBJECTS_COMMON_SNOW_H

#include "mesh/snow/snow.h"
#include "objects/common/branches.h"
#include "objects/common/recipe.h"

extern const struct Table snow_table; // of SnowParams

SnowParams snow_params_default(void); // none

// Adds the snow on the branches of an out-tree and on the instances that the object has added since
// the geometry's part `first`, such as leaves. Colonies from bare_from on bear none; -1 = all do.
bool snow_add(const OutTree *tree, const SkinningParams *skin, const SnowParams *params,
              int32_t bare_from, int64_t first, const Placing *placing, int role, Error *e);

#endif
