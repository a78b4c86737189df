// Forms of loose sand: ripples across the wind, with crests that fork and end, and the tongues of
// grains that slide down a slip face. Both turn with a direction that may change from place to
// place.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_RIPPLES_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_RIPPLES_H

#include "base/vec.h"

#include <stdint.h>

typedef struct SandRelief {
    float height; // about -1..1
    Vec3 slope;   // its gradient, per metre; level
    float tone;   // -1..1: of tongues, how coarse their grains are
} SandRelief;

// At p (m): crests across the unit vector (along_x, along_z), their steep sides toward it, about
// `wavelength` m apart, more in some places than in others. Phasor noise (Tricard et al. 2019, ACM
// Trans. Graph. 38, 57): the phase of a sum of waves, each with its own random phase, direction and
// length around its own place, so that crests wind, and join and end where the sum is 0. At
// most they slope by 8 degrees to windward and 22 in the lee when they are 1/14 as high as long
// (Sharp 1963, J. Geol. 71, 617: 8 to 10 and 20 to 30).
SandRelief pattern_ripples(Vec3 p, float along_x, float along_z, float wavelength, uint32_t seed);

// At p (m): grain flows that have run toward the unit vector (down_x, down_z), in groups: an alcove
// below a scarp, a narrow neck, a lobed toe of coarse grains (Hunter 1977, Sedimentology 24, 361);
// later ones lie on earlier ones. The longest are about 0.9 `length` m long.
SandRelief pattern_tongues(Vec3 p, float down_x, float down_z, float length, uint32_t seed);

#endif
