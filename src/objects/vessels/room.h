// Where a vessel may lie: inside the organ, clear of obstacles and of the other tree. Private to
// this folder.
#ifndef RAMIFY_OBJECTS_VESSELS_ROOM_H
#define RAMIFY_OBJECTS_VESSELS_ROOM_H

#include "objects/vessels/grow.h"

// Constraints on a tree's vessels.
typedef struct VesselRoom {
    const VesselTree *tree;
    const Envelope *envelope;
    const SegmentGrid *others; // of the other tree; NULL = none
    const struct Room *taken;  // obstacles; NULL = none
    float most_inset;          // m: largest known distance inside the envelope
    float gap;                 // m, beyond both radii
} VesselRoom;

VesselRoom vessel_room(const VesselBed *bed, const VesselTree *tree, const SegmentGrid *others,
                       float gap);

// Is a vessel from a to b inside the organ by at least its radius, and clear of obstacles? It may
// lead out of an obstacle.
bool vessel_room_is_inside(const VesselRoom *room, Vec3 a, Vec3 b, float radius);

// The same, and clear of the other tree.
bool vessel_room_is_free(const VesselRoom *room, Vec3 a, Vec3 b, float radius);

// Turns the forks of the tree to Murray's angles as far as there is room, if params->turn is set,
// and counts them in bed->turned.
bool vessel_room_turn(VesselBed *bed, const VesselRoom *room, Error *e);

// Bends daughters to Murray's angles at the forks that turning left, likewise.
bool vessel_room_bend(VesselBed *bed, const VesselRoom *room, Error *e);

#endif
