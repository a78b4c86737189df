#include "land/dunes_measure.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "land/dunes_parts.h"

#include <stdlib.h>

#define FACE 0.466 // tan 25 degrees: slip faces are steeper
#define DEGREES 57.29577951308232

typedef struct Brink {
    double height, length, slip; // of no height: none
    double rise, run;            // m, of the middle half of the windward side
} Brink;

// Tangent of the slope at a sample.
static double slope_at(const Dunes *dunes, int64_t i)
{
    int64_t mask = dunes->side - 1, x = i % dunes->side, z = i / dunes->side;
    const double *h = dunes->sand;
    double dx = h[z * dunes->side + ((x + 1) & mask)] - h[z * dunes->side + ((x - 1) & mask)];
    double dz = h[((z + 1) & mask) * dunes->side + x] - h[((z - 1) & mask) * dunes->side + x];
    return sqrt(dx * dx + dz * dz) / (2.0 * dunes->cell);
}

// Follows the wind through a sample both ways, if that is a brink.
static Brink look_at(const Dunes *dunes, const Crossing *c, int line, int place)
{
    const double *h = dunes->sand;
    double here = h[crossing_index(c, line, place)], last = here, slopes = 0.0;
    double fall = here - crossing_at(c, h, line + 1, place + c->drift);
    double rise = here - crossing_at(c, h, line - 1, place - c->drift);
    int down = 1, faces = 0;
    if (fall < FACE * c->length || rise < -0.1 * c->length) {
        return (Brink){0};
    }
    for (; down < c->side; down++) { // the kinks at both ends do not count
        double way = place + down * c->drift, next = crossing_at(c, h, line + down, way);
        if (last - next < 0.3 * FACE * c->length) {
            break;
        }
        double slope = slope_at(dunes, crossing_index(c, line + down, (int64_t)floor(way + 0.5)));
        bool inside = down > 1 && slope > FACE;
        slopes += inside ? slope : 0.0;
        faces += inside;
        last = next;
    }
    Brink b = {.height = here - last};
    double crest = here, foot = here;
    int at_foot = 0;
    for (int up = 1; up < c->side; up++) { // over the crest, small bumps and all, to the lowest
        double next = crossing_at(c, h, line - up, place - up * c->drift);
        if (next >= crest && foot >= crest) {
            crest = foot = next;
            at_foot = up;
        } else if (next < foot) {
            foot = next;
            at_foot = up;
        } else if (next > foot + 0.15 * b.height) {
            break;
        }
    }
    double quarter = foot + 0.25 * (crest - foot), high = crest - 0.25 * (crest - foot);
    for (int up = at_foot; up >= 0; up--) { // the middle half of the rise
        double next = crossing_at(c, h, line - up, place - up * c->drift);
        if (next > high && b.run > 0.0) {
            break;
        }
        b.run += next > quarter ? c->length : 0.0;
    }
    b.rise = high - quarter;
    b.length = (at_foot + down) * c->length;
    b.slip = faces > 2 ? slopes / faces : 0.0;
    return b;
}

bool dunes_measure(const Dunes *dunes, const DuneWind *wind, DuneMeasures *measures, Error *e)
{
    Crossing crossing = crossing_of(dunes, wind);
    int64_t count = dunes_count(dunes), sloped = 0;
    Brink *brink = memory_alloc(count, sizeof *brink, e);
    double highest = 0.0, slip = 0.0, windward = 0.0, mean = 0.0;
    *measures = (DuneMeasures){0};
    for (int64_t i = 0; brink && i < count; i++) {
        brink[i] = look_at(dunes, &crossing, (int)(i / dunes->side), (int)(i % dunes->side));
        highest = brink[i].height > highest ? brink[i].height : highest;
        mean += dunes->sand[i] / (double)count;
    }
    for (int64_t i = 0; brink && i < count; i++) {
        measures->covered += dunes->sand[i] > 0.01 * mean ? 1.0 / (double)count : 0.0;
        if (brink[i].height <= 0.0 || brink[i].height < highest / 3.0) {
            continue;
        }
        measures->brinks++;
        measures->height += brink[i].height;
        measures->length += brink[i].length;
        windward += (double)exact_atan2((float)brink[i].rise, (float)brink[i].run) * DEGREES;
        slip += (double)exact_atan2((float)brink[i].slip, 1.0f) * DEGREES;
        sloped += brink[i].slip > 0.0;
    }
    double brinks = measures->brinks > 0 ? (double)measures->brinks : (double)NAN;
    measures->height /= brinks;
    measures->length /= brinks;
    measures->windward = windward / brinks;
    measures->slip = sloped > 0 ? slip / (double)sloped : (double)NAN;
    free(brink);
    return brink;
}
