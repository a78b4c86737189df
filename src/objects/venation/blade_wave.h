// The waves of a blade: furrows along the secondary veins, and a margin that goes up and down.
#ifndef RAMIFY_OBJECTS_VENATION_BLADE_WAVE_H
#define RAMIFY_OBJECTS_VENATION_BLADE_WAVE_H

#include "objects/venation/venation.h"

// Height of the flat blade at p by params->wave, m: 0 on the midrib, up to about the wave on the
// margin; 0 below the blade.
float blade_wave(const VenationParams *params, Vec3 p);

#endif
