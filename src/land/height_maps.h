// Maps of a height field: one value per sample, for materials, scattering and other programs.
#ifndef RAMIFY_LAND_HEIGHT_MAPS_H
#define RAMIFY_LAND_HEIGHT_MAPS_H

#include "base/run.h"
#include "land/height_field.h"

// The registry of maps: MAP(ID, name).
// slope           degrees, over eight neighbours (Horn 1981)
// aspect          degrees, toward which the land falls: 0 = north (-z), 90 = east (+x); -1 = level
// curvature       1/m, the Laplacian: positive in hollows, negative on ridges
// flow            m^2, the catchment of each sample (height_drainage.h)
// wetness         ln(catchment per width of contour / tan slope) (Beven and Kirkby 1979)
// river-distance  m to the nearest river, as height_field_measure finds them
// deposit         m that erosion has laid down, and
// wear            m that it has taken away: deposit - wear is HeightField.change
// bedrock         0..1: 1 where rock is bare, 0 under 0.5 m of loose ground or more
// snow            0..1: share of the ground that snow covers
// lava            0..1: freshness of the lava on the ground: 1 = just laid, 0 = none, and
// scoria          0..1: how red hot gas has made the scoria there: HeightField.ground
// age             0..1: age of the ground of a braided river's valley: HeightField.age
// water-depth     m of water over the ground, negative by how far the ground is above the level
// next
//                 to it: HeightField.water less the height; missing where no water is near
// sun-hours       mean hours of direct sun a day (sun_hours.h)
// altitude        m: the height itself
#define HEIGHT_MAPS(MAP)                  \
    MAP(SLOPE, "slope")                   \
    MAP(ASPECT, "aspect")                 \
    MAP(CURVATURE, "curvature")           \
    MAP(FLOW, "flow")                     \
    MAP(WETNESS, "wetness")               \
    MAP(RIVER_DISTANCE, "river-distance") \
    MAP(DEPOSIT, "deposit")               \
    MAP(WEAR, "wear")                     \
    MAP(BEDROCK, "bedrock")               \
    MAP(SNOW, "snow")                     \
    MAP(LAVA, "lava")                     \
    MAP(SCORIA, "scoria")                 \
    MAP(AGE, "age")                       \
    MAP(WATER_DEPTH, "water-depth")       \
    MAP(SUN_HOURS, "sun-hours")           \
    MAP(ALTITUDE, "altitude")

enum {
#define MAP(ID, NAME) HEIGHT_MAP_##ID,
    HEIGHT_MAPS(MAP)
#undef MAP
};

#define HEIGHT_MAP_NAME(ID, NAME) NAME " "
#define HEIGHT_MAP_NAMES HEIGHT_MAPS(HEIGHT_MAP_NAME) // of all maps, a space after each

enum { HEIGHT_MAP_SIDE = 1024 };  // samples a side of a surface that is no height field
#define HEIGHT_MAP_LATITUDE 45.0f // degrees, where none is given

// Where snow lies: above this share of the relief, as snow feels the altitude
// (HeightField.climate). Also the snow line of the material terrain/alps.
#define HEIGHT_MAP_SNOW_LINE 0.47f

typedef struct HeightMap {
    int kind;       // HEIGHT_MAP_*
    float latitude; // degrees, of sun-hours
    int day;        // of the year, of sun-hours: 1 = 1 January; 0 = the year's mean
} HeightMap;

// A map by its name; sun-hours also as "sun-hours:LATITUDE" or "sun-hours:LATITUDE:DAY".
// ERROR_INPUT for anything else.
bool height_map_parse(const char *text, HeightMap *map, Error *e);

// A field of the same samples whose heights are the map's values; missing where the land is. The
// caller frees it. ERROR_INPUT if the land does not know what the map shows. The same bits for any
// number of threads.
HeightField *height_map(const HeightField *field, const HeightMap *map, const Run *run, Error *e);

#endif
