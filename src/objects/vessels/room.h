// Where a vessel may lie: inside the organ and clear of the other tree. Private to vessels*.c.
#ifndef RAMIFY_OBJECTS_VESSELS_ROOM_H
#define RAMIFY_OBJECTS_VESSELS_ROOM_H

#include "objects/vessels/grow.h"

// What a tree must keep clear of.
typedef struct VesselRoom {
    const VesselTree *tree;
    const Envelope *envelope;
    const SegmentGrid *others; // of the other tree; NULL = none
    float most_inset;          // m: as far as the envelope's distance can be told
    float gap;                 // m, beyond both radii
} VesselRoom;

VesselRoom vessel_room(const VesselBed *bed, const VesselTree *tree, const SegmentGrid *others,
                       float gap);

// Does a vessel from a to b lie as deep inside the organ as it is thick?
bool vessel_room_is_inside(const VesselRoom *room, Vec3 a, Vec3 b, float radius);

// The same, and clear of the other tree.
bool vessel_room_is_free(const VesselRoom *room, Vec3 a, Vec3 b, float radius);

// Turns the forks of the tree to Murray's angles as far as there is room, if the scene wants that,
// and counts them in bed->turned.
bool vessel_room_turn(VesselBed *bed, const VesselRoom *room, Error *e);

#endif
