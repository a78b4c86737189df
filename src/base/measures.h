// Named numbers about a result: what `ramify measure` prints and scenes are held to.
#ifndef RAMIFY_BASE_MEASURES_H
#define RAMIFY_BASE_MEASURES_H

#include "base/error.h"

#include <stdint.h>

typedef struct Measure {
    char name[48];    // words joined by _ ("radius_exponent"): the key in JSON and of targets
    double value;     // NAN = there is too little to measure
    const char *unit; // "" = a plain number; static text
    double low, high; // nature's range as far as it is known; NAN = none. low <= high
} Measure;

typedef struct MeasureList {
    Measure *item; // owned
    int64_t count, capacity;
} MeasureList;

// Appends a measure. low and high may be NAN.
bool measures_add(MeasureList *list, const char *name, double value, const char *unit, double low,
                  double high, Error *e);

// The measure of this name; NULL when there is none.
const Measure *measures_find(const MeasureList *list, const char *name);

// Gives the measure of this name nature's range (NAN = none), when the list has it.
void measures_set_range(MeasureList *list, const char *name, double low, double high);

void measures_clear(MeasureList *list);

#endif
