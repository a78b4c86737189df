// A row: copies of any objects along a line, as posts of a fence, planks of a jetty, trees of an
// avenue.
#ifndef RAMIFY_OBJECTS_ROW_ROW_H
#define RAMIFY_OBJECTS_ROW_ROW_H

#include "objects/common/things.h"

// A corner of the line.
typedef struct RowPoint {
    Vec3 at; // m
} RowPoint;

typedef struct RowParams {
    RowPoint *points; // the line's corners, at least two
    int point_count;
    char *on;        // name of the object whose surface they stand on; NULL = the land
    bool on_land;    // they stand on the land or that surface, not at the line's own height
    float spacing;   // m along the line, from copy to copy; the same all along, so the last stands
                     // at the end
    float scale[2];  // least and largest size, relative to the thing's
    float align;     // 0 = upright .. 1 = at right angles to the line's rise
    float sink;      // m below the surface or line, of a copy of scale 1
    float jitter[3]; // m: most displacement across, upward and along the line
    float turn;      // degrees: most rotation about the vertical
    float tilt;      // degrees: most lean, to any side
    float gaps;      // 0 .. 1: share of places where none stands
    Things things;
} RowParams;

RowParams row_params_default(void);

// Number of places: both ends and as many between as come nearest to the spacing.
int64_t row_count(const RowParams *params);

// A copy's z axis points along the line, its x axis to the line's left, its y axis up. Fewer than
// row_count with gaps. Clear with thing_places_free, also on failure.
bool row_places_init(ThingPlaces *places, const RowParams *params, const Recipe *recipe,
                     const Surroundings *around, Error *e);

extern const struct Table row_table; // of its parameters

#endif
