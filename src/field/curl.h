// Divergence-free noise: the curl of a smooth random vector potential (Bridson 2007).
#ifndef RAMIFY_FIELD_CURL_H
#define RAMIFY_FIELD_CURL_H

#include "base/vec.h"

#include <stdint.h>

// Curl at p of gradient noise of wavelength 1. Computed analytically, so divergence-free up to
// rounding.
Vec3 curl_noise(Vec3 p, uint64_t seed);

#endif
