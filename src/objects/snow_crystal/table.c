// The keys of a snow crystal.
#include "config/load.h"
#include "objects/common/tables.h"
#include "objects/snow_crystal/snow_crystal.h"

#include <stddef.h>

SnowCrystalParams snow_crystal_params_default(void)
{
    return (SnowCrystalParams){.size = 0.003f,
                               .thickness = 4e-5f,
                               .relief = 0.6f,
                               .cells = 300,
                               .gusts = 0.3f,
                               .weather = {.temperature = -15.0f, .supersaturation = 0.12f}};
}

#define TEMPERATURE_DOC \
    "Temperature of the air. Crystals are flat from -3.5 up and from -10 down; between, columns "

static const Key WEATHER_KEYS[] = {
    {KEY_OF(SnowWeather, at, "at", KEY_FLOAT), .flags = KEY_REQUIRED, .high = 1,
     .doc = "Size of the crystal in this weather, as a share of the final one; weather between two "
            "entries is between theirs."},
    {KEY_OF(SnowWeather, temperature, "temperature", KEY_FLOAT), .flags = KEY_REQUIRED, .low = -25,
     .high = -0.5, .unit = "degrees Celsius",
     .doc = TEMPERATURE_DOC "and needles grow, which are not made."},
    {KEY_OF(SnowWeather, supersaturation, "supersaturation", KEY_FLOAT),
     .flags = KEY_REQUIRED | KEY_ABOVE, .high = 0.4, .unit = "g/m³",
     .doc = "Vapour of the air beyond its balance with ice."},
    {0},
};

static bool check_flat(const Mapping *mapping, float temperature)
{
    return snow_is_flat(temperature) ||
           mapping_fail(
               mapping, "temperature",
               " is %g degrees; between -10 and -3.5 crystals are columns and needles, which "
               "snow_crystal does not make",
               (double)temperature);
}

static bool weather_check(const Mapping *mapping, void *given)
{
    return check_flat(mapping, ((const SnowWeather *)given)->temperature);
}

static const Table weather_table = {.name = "snow_weather",
                                    .doc = "The air about a snow crystal at one size.",
                                    .size = sizeof(SnowWeather),
                                    .keys = WEATHER_KEYS,
                                    .check = weather_check};

static const Key CRYSTAL_KEYS[] = {
    {KEY_OF(SnowCrystalParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of its middle."},
    {KEY_OF(SnowCrystalParams, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Rotation about x, then y, then z; without it the crystal lies flat, a tip toward +X."},
    {KEY_OF(SnowCrystalParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e3,
     .unit = "m", .doc = "From tip to opposite tip."},
    {KEY_OF(SnowCrystalParams, thickness, "thickness", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e3,
     .unit = "m", .doc = "Thickness in the middle, without ridges."},
    {KEY_OF(SnowCrystalParams, relief, "relief", KEY_FLOAT), .high = 1,
     .doc = "How far ridges and ribs stand out, relative to the thickness."},
    {KEY_OF(SnowCrystalParams, cells, "cells", KEY_INT), .low = 10, .high = 1500,
     .doc = "Cells of the lattice from the middle to a tip: finer branches, and time by its third "
            "power."},
    {KEY_OF(SnowCrystalParams, noise, "noise", KEY_FLOAT), .high = 0.5,
     .doc = "Random variation of the vapour at the crystal, relative: 0 = six equal arms."},
    {KEY_OF(SnowCrystalParams, gusts, "gusts", KEY_FLOAT), .high = 1,
     .doc = "Variation of the supersaturation as it falls, relative; all arms meet the same, so "
            "that they "
            "branch alike."},
    {KEY_OF(SnowCrystalParams, weather.temperature, "temperature", KEY_FLOAT), .low = -25,
     .high = -0.5, .unit = "degrees Celsius",
     .doc = TEMPERATURE_DOC "and needles grow, which are not made. Branches are finest at -15."},
    {KEY_OF(SnowCrystalParams, weather.supersaturation, "supersaturation", KEY_FLOAT),
     .flags = KEY_ABOVE, .high = 0.4, .unit = "g/m³",
     .doc =
         "Vapour of the air beyond its balance with ice: at -15 degrees plates up to 0.04, "
         "sectored "
         "plates at 0.06, stars at 0.11, dendrites from 0.16 on; air in a cloud has up to 0.22."},
    {KEY_OF(SnowCrystalParams, life, "life", KEY_LIST),
     .count_offset = offsetof(SnowCrystalParams, life_count), .count = 64, .table = &weather_table,
     .doc = "Changing weather on its way through the cloud, in the order of `at`, in place of "
            "temperature and supersaturation."},
    {0},
};

static bool crystal_check(const Mapping *mapping, void *given)
{
    const SnowCrystalParams *params = given;
    for (int i = 1; i < params->life_count; i++) {
        if (params->life[i].at <= params->life[i - 1].at) {
            return mapping_fail(mapping, "life", " must be in the order of at; %g comes after %g",
                                (double)params->life[i].at, (double)params->life[i - 1].at);
        }
    }
    return check_flat(mapping, params->weather.temperature);
}

static void crystal_defaults(void *out)
{
    *(SnowCrystalParams *)out = snow_crystal_params_default();
}

const Table snow_crystal_table = {
    .name = "snow_crystal",
    .doc =
        "A flat snow crystal, grown from vapour (Gravner and Griffeath 2008) in the weather that "
        "Nakaya's diagram gives each habit. Material: snow_crystal/ice.",
    .example = "objects:\n"
               "  - name: flake\n"
               "    snow_crystal:\n"
               "      life:\n"
               "        - {at: 0.2, temperature: -12, supersaturation: 0.05}\n"
               "        - {at: 0.4, temperature: -15, supersaturation: 0.18}\n"
               "        - {at: 1, temperature: -14, supersaturation: 0.1}\n",
    .size = sizeof(SnowCrystalParams),
    .keys = CRYSTAL_KEYS,
    .defaults = crystal_defaults,
    .check = crystal_check};
