// The cracks so far, as segments in cells of the plane: what a growing one bends to and ends on.
#ifndef RAMIFY_OBJECTS_ICE_CRACKS_CRACK_FIELD_H
#define RAMIFY_OBJECTS_ICE_CRACKS_CRACK_FIELD_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct CrackSegment {
    Vec3 a, b;     // m, y = 0
    int32_t crack; // its number
    int32_t next;  // of the same cell; -1 = the last
} CrackSegment;

typedef struct CrackField {
    float half, cell; // m: half of the square's side; side of a cell
    int32_t across;   // cells
    int32_t *first;   // of each cell; -1 = none
    CrackSegment *segment;
    int64_t count, capacity;
} CrackField;

typedef struct CrackContact {
    float distance; // m
    Vec3 at;        // m, the nearest point
    Vec3 along;     // unit, of its segment
} CrackContact;

// For a square about the origin. reach: m, of crack_field_nearest. Zero on failure.
bool crack_field_new(CrackField *field, float size, float reach, Error *e);
void crack_field_clear(CrackField *field);

// Segments are at most half a reach long.
bool crack_field_add(CrackField *field, Vec3 a, Vec3 b, int32_t crack, Error *e);

// The nearest crack within the reach but for number `but`; false if there is none.
bool crack_field_nearest(const CrackField *field, Vec3 p, int32_t but, CrackContact *contact);

// The first crossing on the way from a to b, of at most half a reach: its place; false if there is
// none.
bool crack_field_crossing(const CrackField *field, Vec3 a, Vec3 b, Vec3 *at);

#endif
