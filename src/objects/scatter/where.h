// Conditions on maps of the land that the places of copies meet.
#ifndef RAMIFY_OBJECTS_SCATTER_WHERE_H
#define RAMIFY_OBJECTS_SCATTER_WHERE_H

#include "config/table.h"
#include "land/height_field.h"
#include "objects/common/surroundings.h"
#include "objects/scatter/scatter.h"
#include "shape/envelope.h"

// The maps that the conditions name, of one land.
typedef struct Where {
    HeightField **map; // one per condition
    int count;
} Where;

// The maps of the surface seen from above, or, if it is NULL, of the land under the disc of the
// parameters. Free with where_free, also on failure.
bool where_init(Where *where, const ScatteringParams *params, const ShapeSurface *surface,
                const Land *land, Error *e);
void where_free(Where *where);

// The share of copies that keep the place p: 1 where all conditions hold.
float where_share(const Where *where, const ScatteringParams *params, Vec3 p);

extern const Table where_table; // of one condition

#endif
