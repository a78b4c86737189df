// An eruption on a terrain, as a long exposure shows it at night: bombs that fly from the vent and
// roll down the flank draw streaks of light, and streams of lava run down the steepest way, part
// where the land parts them, cool, and grow a dark crust that leaves glowing strands.
#ifndef RAMIFY_OBJECTS_ERUPTION_ERUPTION_H
#define RAMIFY_OBJECTS_ERUPTION_ERUPTION_H

#include "objects/common/recipe.h"

typedef struct LavaStream {
    float at[2];  // m: x, z of its source
    float width;  // m: of each of its branches there
    float length; // m: of the longest branch
    int branches; // that set out from the source together
} LavaStream;

typedef struct EruptionParams {
    char *on;          // the terrain
    float vent[2];     // m: x, z
    float vent_width;  // m
    int bombs;         // number
    float speed;       // m/s: of the fastest
    float spread;      // degrees: standard deviation of their directions from the vertical
    float shutter;     // s: the exposure, which cuts their streaks
    float size;        // m: width of the largest streaks
    float temperature; // degrees C, of lava where it comes out
    float radiance;    // W/(m^2 sr), luminous, of such lava
    LavaStream *stream;
    int stream_count;
} EruptionParams;

EruptionParams eruption_params_default(void);

// A way of glowing matter: points with their temperatures.
typedef struct TrailPoint {
    Vec3 position;
    float radius; // m
    float kelvin;
    float shown; // factor on its light: of what flies fast, a long exposure sees little; 0 = dark
} TrailPoint;

typedef struct Trails {
    TrailPoint *point; // owned
    int64_t count, capacity;
    int64_t *first; // owned: trail_count + 1 entries
    int64_t trail_count, first_capacity;
} Trails;

void trails_clear(Trails *trails);
bool trails_begin(Trails *trails, Error *e);
bool trails_add(Trails *trails, TrailPoint point, Error *e); // to the last one begun

// The streaks of all bombs; each stream's glowing strands, and the rubble of crust along it.
// land: heights in scene space.
bool eruption_fly(Trails *trails, const EruptionParams *params, const HeightField *land,
                  uint64_t seed, Error *e);
bool eruption_flow(Trails *strands, Trails *crust, const EruptionParams *params,
                   const HeightField *land, uint64_t seed, Error *e);

// Light at a temperature over that at another, K, by Wien's law at 600 nm.
float eruption_glow(float kelvin, float hottest);

bool eruption_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table eruption_table;

#endif
