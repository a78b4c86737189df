// Measures of braided rivers, for targets.
#include "land/braid_measure.h"
#include "objects/terrain/internal.h"

#include <math.h>

// Ranges in nature: Egozi and Ashmore 2008; Kelly 2006 of bars.
bool terrain_measure_braided(const Terrain *terrain, MeasureList *list, Error *e)
{
    BraidMeasures m;
    double nan = (double)NAN;
    return braid_measure(terrain->braid, terrain->level, &m, e) &&
           measures_add(list, "threads", m.threads, "", 3, 10, e) &&
           measures_add(list, "active_threads", m.active, "", 1, 5, e) &&
           measures_add(list, "bar_ratio", m.bar_ratio, "", 3, 5, e) &&
           measures_add(list, "trunk_share", m.trunk_share, "", nan, nan, e) &&
           measures_add(list, "trunk_width", m.trunk_width, "", nan, nan, e) &&
           measures_add(list, "wet_share", m.wet, "", nan, nan, e) &&
           measures_add(list, "river_slope", m.fall, "", 0.001, 0.03, e);
}
