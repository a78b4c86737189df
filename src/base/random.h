// Counter-based random numbers: every draw is a pure function of a key, so it does not depend on
// the order of evaluation, the number of threads or other draws.
#ifndef RAMIFY_BASE_RANDOM_H
#define RAMIFY_BASE_RANDOM_H

#include "base/vec.h"

#include <stdint.h>

// Mixes 64 bits (the finaliser of SplitMix64, Steele 2014).
static inline uint64_t random_mix(uint64_t x)
{
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

// Derives a key from a key and a number, such as a stream; nest calls for several numbers.
static inline uint64_t random_key(uint64_t key, uint64_t number)
{
    return random_mix(key + 0x9e3779b97f4a7c15ull * (number + 1));
}

// Uniform in [0, 1), 24 bits.
static inline float random_unit(uint64_t key)
{
    return (float)(random_mix(key) >> 40) * (1.0f / 16777216.0f);
}

// Uniform in [low, high).
static inline float random_range(uint64_t key, float low, float high)
{
    return low + (high - low) * random_unit(key);
}

// Standard normal, by Box-Muller over exact_math.
float random_normal(uint64_t key);

// Uniform on the unit sphere.
Vec3 random_direction(uint64_t key);

#endif
