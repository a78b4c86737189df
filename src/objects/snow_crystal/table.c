// The keys of a snow crystal.
#include "config/load.h"
#include "objects/common/tables.h"
#include "objects/snow_crystal/column.h"

#include <stddef.h>

SnowCrystalParams snow_crystal_params_default(void)
{
    return (SnowCrystalParams){.size = 0.003f,
                               .thickness = 4e-5f,
                               .relief = 0.6f,
                               .cells = 300,
                               .detail = 1,
                               .gusts = 0.3f,
                               .weather = {.temperature = -15.0f, .supersaturation = 0.12f}};
}

#define TEMPERATURE_DOC                                                                           \
    "Temperature of the air. Crystals are columns from -3.5 down to -10, needles in much vapour " \
    "at "                                                                                         \
    "-5 to -7, and short columns below -22; they are flat between -10 and -22 and above -3.5"

static const Key WEATHER_KEYS[] = {
    {KEY_OF(SnowWeather, at, "at", KEY_FLOAT), .flags = KEY_REQUIRED, .high = 1,
     .doc = "Size of the crystal in this weather, as a share of the final one; weather between two "
            "entries is between theirs."},
    {KEY_OF(SnowWeather, temperature, "temperature", KEY_FLOAT), .flags = KEY_REQUIRED, .low = -40,
     .high = -0.5, .unit = "degrees Celsius", .doc = TEMPERATURE_DOC "."},
    {KEY_OF(SnowWeather, supersaturation, "supersaturation", KEY_FLOAT),
     .flags = KEY_REQUIRED | KEY_ABOVE, .high = 0.4, .unit = "g/m³",
     .doc = "Vapour of the air beyond its balance with ice."},
    {0},
};

static const Table weather_table = {.name = "snow_weather",
                                    .doc = "The air about a snow crystal at one size.",
                                    .size = sizeof(SnowWeather),
                                    .keys = WEATHER_KEYS};

static const Key CRYSTAL_KEYS[] = {
    {KEY_OF(SnowCrystalParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of its middle."},
    {KEY_OF(SnowCrystalParams, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Rotation about x, then y, then z; without it a flat crystal lies flat, a tip toward "
            "+X, and a column stands upright."},
    {KEY_OF(SnowCrystalParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e3,
     .unit = "m",
     .doc = "From tip to opposite tip of a flat crystal, and length of a column; of a capped one "
            "the caps' width: the column is as long as its share of the life."},
    {KEY_OF(SnowCrystalParams, thickness, "thickness", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e3,
     .unit = "m", .doc = "Thickness of a flat crystal or of caps in the middle, without ridges."},
    {KEY_OF(SnowCrystalParams, relief, "relief", KEY_FLOAT), .high = 1,
     .doc =
         "How far ridges and ribs stand out, relative to the thickness; of columns, how far their "
         "edges are worn."},
    {KEY_OF(SnowCrystalParams, rings, "rings", KEY_FLOAT), .high = 1,
     .doc =
         "Height of the ridges and grooves of its upper face that changes of the air leave along "
         "the outlines that "
         "a flat crystal had as it grew, relative to the thickness: 0.3 = as on most, 0 = none."},
    {KEY_OF(SnowCrystalParams, worn, "worn", KEY_FLOAT), .high = 1,
     .doc = "How far a flat crystal's edges, corners and gaps are rounded, as it sublimates: 0 = "
            "just grown, 1 = by three cells."},
    {KEY_OF(SnowCrystalParams, cells, "cells", KEY_INT), .low = 10, .high = 1500,
     .doc = "Cells of the lattice from the middle to a tip: finer branches, and time by its third "
            "power."},
    {KEY_OF(SnowCrystalParams, detail, "detail", KEY_INT), .low = 1, .high = 4,
     .doc = "Points of a flat crystal's surface to a cell, a side: with 2 and more, and some "
            "`rings` and `worn`, it is smooth in close-up."},
    {KEY_OF(SnowCrystalParams, noise, "noise", KEY_FLOAT), .high = 0.5,
     .doc = "Random variation of the vapour at the crystal, relative: 0 = six equal arms."},
    {KEY_OF(SnowCrystalParams, gusts, "gusts", KEY_FLOAT), .high = 1,
     .doc = "Variation of the supersaturation as it falls, relative; all arms meet the same, so "
            "that they "
            "branch alike."},
    {KEY_OF(SnowCrystalParams, weather.temperature, "temperature", KEY_FLOAT), .low = -40,
     .high = -0.5, .unit = "degrees Celsius",
     .doc = TEMPERATURE_DOC ", with the finest branches at -15."},
    {KEY_OF(SnowCrystalParams, weather.supersaturation, "supersaturation", KEY_FLOAT),
     .flags = KEY_ABOVE, .high = 0.4, .unit = "g/m³",
     .doc =
         "Vapour of the air beyond its balance with ice: at -15 degrees plates up to 0.04, "
         "sectored "
         "plates at 0.06, stars at 0.11, dendrites from 0.16 on; air in a cloud has up to 0.22."},
    {KEY_OF(SnowCrystalParams, life, "life", KEY_LIST),
     .count_offset = offsetof(SnowCrystalParams, life_count), .count = 64, .table = &weather_table,
     .doc = "Changing weather on its way through the cloud, in the order of `at`, in place of "
            "temperature and supersaturation. Where a column comes to weather of flat crystals, "
            "plates "
            "cap its ends."},
    {0},
};

// Plates cap columns, but columns that grow on plates are not made.
static bool check_order(const Mapping *mapping, const SnowCrystalParams *params)
{
    enum { LOOKS = 1024 };
    float flat = 0.0f; // temperature at which it last was
    for (int i = 0; i <= LOOKS; i++) {
        SnowWeather weather = snow_weather_at(params, (float)i / LOOKS);
        if (snow_is_flat(weather.temperature)) {
            flat = weather.temperature;
        } else if (flat < 0.0f) {
            return mapping_fail(mapping, "life",
                                " comes from %.3g degrees, where crystals are flat, to %.3g, where "
                                "they are columns; columns on plates are not made, only plates on "
                                "columns: let columns come first",
                                (double)flat, (double)weather.temperature);
        }
    }
    return true;
}

static bool crystal_check(const Mapping *mapping, void *given)
{
    const SnowCrystalParams *params = given;
    for (int i = 1; i < params->life_count; i++) {
        if (params->life[i].at <= params->life[i - 1].at) {
            return mapping_fail(mapping, "life", " must be in the order of at; %g comes after %g",
                                (double)params->life[i].at, (double)params->life[i - 1].at);
        }
    }
    return check_order(mapping, params);
}

static void crystal_defaults(void *out)
{
    *(SnowCrystalParams *)out = snow_crystal_params_default();
}

const Table snow_crystal_table = {
    .name = "snow_crystal",
    .doc =
        "A snow crystal, grown from vapour in the weather that Nakaya's diagram gives each habit: "
        "flat "
        "ones on a lattice (Gravner and Griffeath 2008), columns and needles by the ratio in which "
        "axis and width grow (Chen and Lamb 1994), columns that plates cap. Material: "
        "snow_crystal/ice.",
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
