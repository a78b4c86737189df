// How long the sun shines on each place of a height field, in the shade of the land itself.
#ifndef RAMIFY_LAND_SUN_HOURS_H
#define RAMIFY_LAND_SUN_HOURS_H

#include "base/run.h"
#include "land/height_field.h"

// Mean hours a day in which the middle of the sun stands above the horizon of each sample, NAN
// where there is no land. latitude: degrees, north positive; day: of the year, 1 = 1 January; 0 =
// the year's mean. Beyond its rim the land is as if nothing rose there. No refraction. hours: of
// all samples. ERROR_MEMORY, or cancelled.
bool sun_hours(const HeightField *field, float latitude, int day, float *hours, const Run *run,
               Error *e);

#endif
