// Conditions on maps of land: where copies stand and where layers of materials lie.
#ifndef RAMIFY_LAND_WHERE_H
#define RAMIFY_LAND_WHERE_H

#include "base/run.h"
#include "land/height_maps.h"

// A map's value lies in a range.
typedef struct MapRange {
    int map;        // HEIGHT_MAP_*
    float range[2]; // least and greatest value, in the map's unit; of aspect it may lead through
                    // north
    float fade;     // in that unit: the share falls to 0 over this distance from the range
    float latitude; // degrees, of sun-hours
    int day;        // of the year, of sun-hours; 0 = the year's mean
} MapRange;

// The maps that conditions name, of one land.
typedef struct Where {
    const MapRange *range; // borrowed
    HeightField **map;     // one per condition
    int count;
} Where;

// Makes the maps of the land. ERROR_INPUT, with the key where.NUMBER, if the land does not have
// one. Free with where_free, also on failure.
bool where_init(Where *where, const MapRange *ranges, int count, const HeightField *land,
                const Run *run, Error *e);
void where_free(Where *where);

// The share 0..1 of copies, or of a layer, that the conditions leave at a sample of the land: 1
// where all hold.
float where_share_of(const Where *where, int64_t sample);

// The same at the sample next to a place; beyond the land, that of its rim. 1 without conditions.
float where_share(const Where *where, Vec3 p);

#endif
