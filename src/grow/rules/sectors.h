// Sectors: directions about a heading, binned by angle (60 degrees in Horiuchi; any angle here). On
// a surface they lie in the tangent plane, in space on rings of polar angle.
#ifndef RAMIFY_GROW_RULES_SECTORS_H
#define RAMIFY_GROW_RULES_SECTORS_H

#include "base/error.h"
#include "base/vec.h"

enum { MAX_SECTORS = 64, MAX_SECTOR_RINGS = 32 };

typedef struct SectorTable {
    int count; // sector 0 is the forward one, the others follow by angle
    bool planar;
    float angle;                        // radians per sector
    int rings;                          // polar rings; in the plane, sectors to either side
    int ring_start[MAX_SECTOR_RINGS];   // index of a ring's first sector
    int ring_sectors[MAX_SECTOR_RINGS]; // number of sectors per ring
    Vec3 axis[MAX_SECTORS];             // unit, in (heading, normal, side) components
} SectorTable;

// ERROR_INPUT when the angle is not in (0, 180] degrees or makes more than MAX_SECTORS sectors.
bool sectors_init(SectorTable *table, float degrees, bool planar, Error *e);

// Sector of a direction given in (heading, normal, side) components; need not be unit.
int sectors_find(const SectorTable *table, Vec3 local);

#endif
