// A snow crystal, by the weather that it fell through: a plate, sectored plate, star or dendrite,
// which is flat; a column or needle; or a column that plates cap.
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
    float size;      // m, from tip to tip of a plate, or the length of a column: the largest
    float thickness; // m, of a plate: mean, in the middle
    float relief;    // height of its ridges, 0 .. 1
    float rings;     // height of the ridges along its former outlines, 0 .. 1
    float worn;      // rounding of its edges, 0 .. 1
    int cells;       // of the lattice from the middle to a tip
    int detail;      // points of the surface to a cell
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

// How many times as fast as its width a column's length grows, on a logarithmic scale: 1 = it stays
// as it is. 1 .. 2.2, for weather in which crystals are columns.
float snow_growth_ratio(const SnowWeather *weather);

// Share of the final size up to which the crystal is a column: 0 = it is flat, 1 = nothing caps it.
float snow_column_until(const SnowCrystalParams *params);

// The column: a hexagonal prism about the axis Y. {0} of a flat crystal.
typedef struct SnowColumn {
    float length, width; // m; the width from corner to opposite corner
    float hollow;        // 0 = solid .. 1 = funnels from both ends meet in the middle
    float until;         // see snow_column_until
} SnowColumn;

SnowColumn snow_column(const SnowCrystalParams *params);

// Closed surface of a column of length > 0, with flat faces, about the origin. The caller frees it.
Mesh *snow_column_mesh(const SnowCrystalParams *params, const SnowColumn *column, uint64_t seed,
                       Error *e);

// Place of the weather on the way from solid plates (0) over sectored plates (1), stars with plates
// at their tips (2) and stellar dendrites (3) to fernlike dendrites (4): Nakaya's diagram of
// habits, after Libbrecht, The physics of snow crystals (2005).
float snow_habit(const SnowWeather *weather);

// Rates of growth of a habit, 0 .. 4.
SnowfakeRates snow_habit_rates(float habit);

// Grows the cells of a flat crystal, or of a column's caps. Free with snowfake_clear, on success
// only.
bool snow_crystal_grow(const SnowCrystalParams *params, uint64_t seed, const Run *run,
                       Snowfake *fake, Error *e);

// Closed surface with normals, flat about the plane y = 0, a tip toward +X. The caller frees it.
Mesh *snow_crystal_mesh(const SnowCrystalParams *params, const Snowfake *fake, uint64_t seed,
                        Error *e);

// Share of the hexagon about the crystal that it covers: 1 = a plate.
double snowfake_fill(const Snowfake *fake);

// Share of its cells that are missing after a turn by 60 degrees.
double snowfake_asymmetry(const Snowfake *fake);

#endif
