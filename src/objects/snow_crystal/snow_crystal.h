// A flat snow crystal: plate, sectored plate, star or dendrite, by the weather that it fell
// through.
#ifndef RAMIFY_OBJECTS_SNOW_CRYSTAL_SNOW_CRYSTAL_H
#define RAMIFY_OBJECTS_SNOW_CRYSTAL_SNOW_CRYSTAL_H

#include "base/mesh.h"
#include "grow/aggregate/snowfake.h"

// The air about the crystal when it had a part of its size.
typedef struct SnowWeather {
    float at;              // share of the final size, 0 .. 1
    float temperature;     // degrees Celsius
    float supersaturation; // g/m^3 of vapour more than ice is in balance with
} SnowWeather;

typedef struct SnowCrystalParams {
    Vec3 position;   // m, of its middle
    Vec3 rotation;   // degrees
    float size;      // m, from tip to tip
    float thickness; // m, mean, in the middle
    float relief;    // height of its ridges, 0 .. 1
    int cells;       // of the lattice from the middle to a tip
    float noise;     // relative variation of the vapour
    float gusts;     // relative variation of the supersaturation in its life, the same for all arms
    SnowWeather weather;
    SnowWeather *life; // in the order of `at`; NULL = weather all the time
    int life_count;
} SnowCrystalParams;

extern const struct Table snow_crystal_table;

SnowCrystalParams snow_crystal_params_default(void);

// Whether crystals are flat at this temperature (degrees Celsius); otherwise they are columns and
// needles.
bool snow_is_flat(float temperature);

// Place of the weather on the way from solid plates (0) over sectored plates (1), stars with plates
// at their tips (2) and stellar dendrites (3) to fernlike dendrites (4): Nakaya's diagram of
// habits, after Libbrecht, The physics of snow crystals (2005).
float snow_habit(const SnowWeather *weather);

// Rates of growth of a habit, 0 .. 4.
SnowfakeRates snow_habit_rates(float habit);

// Grows the crystal's cells. Free with snowfake_clear, on success only.
bool snow_crystal_grow(const SnowCrystalParams *params, uint64_t seed, const Run *run,
                       Snowfake *fake, Error *e);

// Closed surface with normals, flat about the plane y = 0, a tip toward +X. The caller frees it.
Mesh *snow_crystal_mesh(const SnowCrystalParams *params, const Snowfake *fake, Error *e);

// Share of the hexagon about the crystal that it covers: 1 = a plate.
double snowfake_fill(const Snowfake *fake);

// Share of its cells that are missing after a turn by 60 degrees.
double snowfake_asymmetry(const Snowfake *fake);

#endif
