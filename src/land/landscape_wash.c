// What water leaves on the floors of valleys.
#include "land/landscape_parts.h"

#include <math.h>

bool landscape_lay_wash(Landscape *land, const LandscapeWash *wash, const Run *run, Error *e)
{
    const double hectare = 1e4;
    if (!landscape_find_route(land, wash->seed, run, e)) {
        return false;
    }
    const Routing *route = land->route;
    double own = land->cell * land->cell;
    for (int64_t k = 0; k < route->count; k++) {
        int32_t i = route->order[k], to = route->receiver[i];
        if (to == i) {
            continue;
        }
        int32_t step = to > i ? to - i : i - to;
        double length = step == 1 || step == land->side ? land->cell : sqrt(2.0) * land->cell;
        double area = route->area[i];
        double slope =
            area > wash->least_area ? wash->slope * sqrt(sqrt(hectare / area)) : wash->across;
        double level = land->rock[to] + land->loose[to] + slope * length;
        double laid = level - (land->rock[i] + land->loose[i]);
        if (laid > 0.0) {
            land->loose[i] += laid;
            land->outflow -= laid * own;
        }
    }
    return true;
}
