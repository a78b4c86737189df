// Forms of loose sand: ripples across the wind, with crests that fork and end, and the tongues of
// grains that slide down a slip face. Both turn with a direction that may change from place to
// place.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_RIPPLES_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_RIPPLES_H

#include "base/vec.h"

#include <stdint.h>

typedef struct SandRelief {
    float height; // about -1..1; of tongues 0..1
    Vec3 slope;   // its gradient, per metre; level
    float tone;   // -1..1: of tongues, by how fresh each is
} SandRelief;

// At p (m): crests across the unit vector (along_x, along_z), their steep sides toward it, about
// `wavelength` m apart. Phasor noise (Tricard et al. 2019, ACM Trans. Graph. 38, 57): the phase of
// a sum of waves, each with its own random phase around its own place, so that crests join and end
// where the sum is 0.
SandRelief pattern_ripples(Vec3 p, float along_x, float along_z, float wavelength, uint32_t seed);

// At p (m): tongues that run toward the unit vector (down_x, down_z), about `length` m long; later
// ones lie on earlier ones.
SandRelief pattern_tongues(Vec3 p, float down_x, float down_z, float length, uint32_t seed);

#endif
