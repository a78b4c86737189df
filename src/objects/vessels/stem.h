// Initial vessels of growth: stems that enter an organ, the great vessels of a body.
#ifndef RAMIFY_OBJECTS_VESSELS_STEM_H
#define RAMIFY_OBJECTS_VESSELS_STEM_H

#include "objects/vessels/vessels.h"

// Plants the stem of colony into the empty tree: a root outside the organ, nodes into it. reach: m,
// the cube root of the organ's volume. The stems of both colonies run side by side.
bool vessels_plant_stem(OutTree *tree, const VesselsParams *params, const Envelope *envelope,
                        int32_t colony, float root_radius, float reach, uint64_t seed, Error *e);

// Plants the great vessels of colony that the user has placed (VesselsParams.great) into the empty
// tree; plants none if there are none of that colony. reach: as above. Births increase from the
// root on.
bool vessels_plant_placed(OutTree *tree, const VesselsParams *params, int32_t colony, float reach,
                          uint64_t seed, Error *e);

// Plants the great arteries or veins of the body that is the envelope's first shape. Births
// increase from the heart on.
bool vessels_plant_great(OutTree *tree, const Shape *body, int32_t colony, uint64_t seed, Error *e);

// Radius (m) of a body's aorta.
float vessels_aorta_radius(const Shape *body);

#endif
