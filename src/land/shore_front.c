// The front as a distance: Shore.front is made m to where it is 0, by fast sweeping (Zhao 2005).
#include "land/shore_parts.h"

#include <math.h>

// The solution of |grad d| = 1 beside a and b along both axes.
static double eikonal(double a, double b, double cell)
{
    double low = a < b ? a : b, gap = a < b ? b - a : a - b;
    if (!(gap < cell)) {
        return low + cell;
    }
    return 0.5 * (a + b + sqrt(2.0 * cell * cell - gap * gap));
}

static double greater(double a, double b)
{
    return a > b ? a : b;
}

// m from a sample beside the front to it (Russo and Smereka 2000); -1 = not beside it.
static double beside(const double *f, int side, double cell, int column, int row)
{
    int64_t i = (int64_t)row * side + column;
    double here = f[i], west = column > 0 ? f[i - 1] : here;
    double east = column < side - 1 ? f[i + 1] : here;
    double north = row > 0 ? f[i - side] : here, south = row < side - 1 ? f[i + side] : here;
    bool wet = here <= 0.0;
    bool same = wet == (west <= 0.0) && wet == (east <= 0.0) && wet == (north <= 0.0) &&
                wet == (south <= 0.0);
    if (same) {
        return -1.0;
    }
    double x = greater(0.5 * fabs(east - west), greater(fabs(east - here), fabs(here - west)));
    double z = greater(0.5 * fabs(south - north), greater(fabs(south - here), fabs(here - north)));
    return fabs(here) * cell / sqrt(x * x + z * z);
}

static void relax(double *distance, int side, double cell, int column, int row)
{
    double *d = distance + (int64_t)row * side + column;
    double west = column > 0 ? d[-1] : INFINITY, east = column < side - 1 ? d[1] : INFINITY;
    double north = row > 0 ? d[-side] : INFINITY, south = row < side - 1 ? d[side] : INFINITY;
    double to = eikonal(west < east ? west : east, north < south ? north : south, cell);
    *d = to < *d ? to : *d;
}

void shore_measure_front(Shore *shore, const Landscape *land, double *room)
{
    const double never = 1e7;
    int side = land->side;
    for (int row = 0; row < side; row++) {
        for (int column = 0; column < side; column++) {
            double d = beside(shore->front, side, land->cell, column, row);
            room[(int64_t)row * side + column] = d < 0.0 ? never : d;
        }
    }
    for (int order = 0; order < 4; order++) {
        bool down = order < 2, right = order % 2 == 0;
        for (int r = 0; r < side; r++) {
            for (int c = 0; c < side; c++) {
                relax(room, side, land->cell, right ? c : side - 1 - c, down ? r : side - 1 - r);
            }
        }
    }
    for (int64_t i = 0; i < landscape_count(land); i++) {
        shore->front[i] = shore->front[i] > 0.0 ? room[i] : -room[i];
    }
}
