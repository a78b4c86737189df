// The hypsometric integral of drainage basins (Strahler 1952, who measures basins of third and
// fourth order): unlike that of a whole field, it does not depend on where the field is cut.
#ifndef RAMIFY_LAND_BASIN_HYPSOMETRY_H
#define RAMIFY_LAND_BASIN_HYPSOMETRY_H

#include "land/height_drainage.h"

// *integral: mean of (mean height - lowest) / (highest - lowest) over the basins of streams of
// Strahler order `rank` that join one of a higher order; NAN without any. Basins that reach the rim
// or missing samples are cut short and do not count. order: of drainage_orders.
bool basin_hypsometry(const HeightField *field, const Drainage *drainage, const uint8_t *order,
                      int rank, double *integral, Error *e);

#endif
