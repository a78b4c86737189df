// Spray: parcels of air with droplets, as falls and breakers throw them up. Clouds of the kind
// spray show them.
#ifndef RAMIFY_MESH_SPRAY_H
#define RAMIFY_MESH_SPRAY_H

#include "base/error.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

// A ball of air, or one that is drawn out, densest in its middle.
typedef struct SprayParcel {
    Vec3 center;   // m, in the scene
    float radius;  // m, > 0
    float content; // m^3 of the densest spray (density 1) that hold as many droplets
    Vec3 drawn;    // m: by how much its ends lie farther out than a ball's, along this direction
} SprayParcel;

typedef struct SprayParcels {
    SprayParcel *parcel; // owned
    int64_t count, capacity;
} SprayParcels;

// m: how far a parcel reaches from its centre along x, y or z (axis 0, 1 or 2), with its radius no
// less than `least`.
float spray_reach(const SprayParcel *parcel, int axis, float least);

// Adds a parcel. ERROR_MEMORY.
bool spray_add(SprayParcels *spray, SprayParcel parcel, Error *e);

// Adds all parcels of another. ERROR_MEMORY.
bool spray_join(SprayParcels *spray, const SprayParcels *other, Error *e);

// A puff of air that is shot into still air (Turner, "Buoyancy Effects in Fluids", 1973, ch. 6): it
// widens by a share of its way as it mixes, and keeps its momentum, so that way^4 grows evenly with
// the time. radius: m, at the start; speed: m/s, at the start. Returns its way, m, after s seconds.
float spray_puff_way(float radius, float speed, float seconds);

// The radius, m, of a puff after a way.
float spray_puff_radius(float radius, float way);

// m^3 of the densest spray that hide as much as a m^3 of water in drops of falls.
float spray_of_water(void);

void spray_free(SprayParcels *spray); // with its parcels; NULL is fine

#endif
