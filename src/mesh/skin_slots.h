// Where the rings of a chain stand and through which of a tube's side faces its children leave.
#ifndef RAMIFY_MESH_SKIN_SLOTS_H
#define RAMIFY_MESH_SKIN_SLOTS_H

#include "mesh/skin_plan.h"

// A ring, and the children that leave through the four faces between it and the next one.
// Face f looks along the axis' side turned by twist + f * 90 degrees.
typedef struct SkinStation {
    float along;      // m along the chain's axis
    float twist;      // radians that the ring is turned about the axis from the axis' side
    int32_t child[4]; // chains, -1 = none
} SkinStation;

// Working memory, reused from chain to chain.
typedef struct SkinSlots {
    SkinStation *station;
    int64_t station_count, station_capacity;
    struct SkinSlot *slot;
    int64_t slot_count, slot_capacity;
    int32_t *child; // chains that leave the one at hand
    int64_t child_count, child_capacity;
} SkinSlots;

// Places a chain's rings. The caller fills slots->child; phase is the twist of the first ring.
// The result is slots->station; every child is in exactly one place.
bool skin_slots_place(SkinSlots *slots, const SkinPlan *plan, int32_t chain, float phase, Error *e);
void skin_slots_clear(SkinSlots *slots);

#endif
