// Ferns of frost: plumes along the spines, over what is not clear. Private to the frost's files.
#ifndef RAMIFY_OBJECTS_FROST_FERNS_H
#define RAMIFY_OBJECTS_FROST_FERNS_H

#include "objects/frost/frost.h"

// Grows the ferns into whole->tree. See frost_grow.
bool ferns_grow(const FrostParams *params, const Recipe *recipe, Grown *whole, Error *e);

#endif
