// A cumulonimbus: towers of water, as trees of balls, below an anvil of ice (anvil.h).
#ifndef RAMIFY_RENDER_CLOUD_STORM_H
#define RAMIFY_RENDER_CLOUD_STORM_H

#include "render/cloud/puffs.h"

// Directions of a storm: along its wind and across it.
typedef struct StormFrame {
    const Cloud *cloud; // borrowed
    float sine, cosine; // of the wind's azimuth
    float top;          // m: altitude of the anvil's upper side
} StormFrame;

StormFrame storm_frame(const Cloud *cloud);

// A place in shares of the storm's size downwind of its centre and beside it; y: altitude, m.
Vec3 storm_place(const StormFrame *frame, float along, float aside, float y);

// Adds the towers of a storm about its centre, its flanking line, the dome that shoots over the
// anvil and its shelf. Errors: ERROR_MEMORY.
bool storm_grow(Puffs *puffs, const Cloud *cloud, uint64_t key, Error *e);

// Share of the greatest extinction that towers have at an altitude: droplets freeze to few large
// crystals as they rise past -15 to -40 degrees, in the upper third.
float storm_freezing(const StormFrame *frame, float altitude);

#endif
