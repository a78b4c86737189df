// The column of a snow crystal, and the weather of its life. Private to the crystal's files.
#ifndef RAMIFY_OBJECTS_SNOW_CRYSTAL_COLUMN_H
#define RAMIFY_OBJECTS_SNOW_CRYSTAL_COLUMN_H

#include "objects/snow_crystal/snow_crystal.h"

// The weather when it had the share `at` of its final size.
SnowWeather snow_weather_at(const SnowCrystalParams *params, float at);

// Variation of the air's moisture at that size, about -1 .. 1.
float snow_gust(float at, uint64_t seed);

#endif
