// Named measures of a result: printed by measure commands and compared with targets.
#ifndef RAMIFY_BASE_MEASURES_H
#define RAMIFY_BASE_MEASURES_H

#include "base/error.h"

#include <stdint.h>

typedef struct Measure {
    char name[48];    // words joined by _ ("radius_exponent"): the key in JSON and of targets
    double value;     // NAN = not measurable
    const char *unit; // "" = a plain number; static text
    double low, high; // range found in nature, low <= high; NAN = unknown
} Measure;

typedef struct MeasureList {
    Measure *item; // owned
    int64_t count, capacity;
} MeasureList;

// Appends a measure. low and high may be NAN.
bool measures_add(MeasureList *list, const char *name, double value, const char *unit, double low,
                  double high, Error *e);

// The measure with this name; NULL if there is none.
const Measure *measures_find(const MeasureList *list, const char *name);

// Sets the natural range (NAN = none) of the measure with this name, if the list has it.
void measures_set_range(MeasureList *list, const char *name, double low, double high);

void measures_clear(MeasureList *list);

#endif
