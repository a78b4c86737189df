// Measures of badlands: how densely water cuts them, how steep their walls are, how much is wash.
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"

#include <math.h>

// A channel drains this much: less than any gully, more than the wall of a rill.
static const double CHANNEL = 50.0; // m^2

// km of channels by km^2; NaN on an error.
static bool drainage_density(const Landscape *land, double *density, Error *e)
{
    HeightField *field = landscape_heights(land, e);
    Drainage *drainage = field ? drainage_new(field, e) : NULL;
    double length = 0.0;
    for (int64_t i = 0; drainage && i < landscape_count(land); i++) {
        int64_t step = drainage->receiver[i] - i;
        step = step < 0 ? -step : step;
        if (drainage->area[i] >= CHANNEL && step != 0) {
            length += step == 1 || step == land->side ? 1.0 : sqrt(2.0);
        }
    }
    double side = (double)land->side - 1.0;
    *density = length / (side * side * land->cell) * 1e3;
    bool done = drainage;
    drainage_free(drainage);
    height_field_free(field);
    return done;
}

static double surface(const Landscape *land, int64_t i)
{
    return land->rock[i] + land->loose[i];
}

// Degrees: mean over inner samples without sediment. wash: the share of those with it.
static double wall_slope(const Landscape *land, double *wash)
{
    const double degree = 57.29577951308232, deep = 0.05;
    double sum = 0.0, walls = 0.0, all = 0.0;
    for (int row = 1; row < land->side - 1; row++) {
        for (int column = 1; column < land->side - 1; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double x = surface(land, i + 1) - surface(land, i - 1);
            double z = surface(land, i + land->side) - surface(land, i - land->side);
            all += 1.0;
            if (land->loose[i] < deep) {
                sum += atan(0.5 * sqrt(x * x + z * z) / land->cell) * degree;
                walls += 1.0;
            }
        }
    }
    *wash = (all - walls) / all;
    return sum / walls;
}

bool terrain_measure_badlands(const Terrain *terrain, MeasureList *list, Error *e)
{
    double density, wash, nan = (double)NAN, slope = wall_slope(terrain->evolved, &wash);
    return drainage_density(terrain->evolved, &density, e) &&
           measures_add(list, "drainage_density", density, "km/km2", nan, nan, e) &&
           measures_add(list, "wall_slope", slope, "degrees", nan, nan, e) &&
           measures_add(list, "wash_share", wash, "", nan, nan, e);
}
