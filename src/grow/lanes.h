// Eight numbers at a time, in the compiler's vectors. They are passed by address, since how vectors
// are passed by value depends on the instruction set.
#ifndef RAMIFY_GROW_LANES_H
#define RAMIFY_GROW_LANES_H

#include <stdint.h>
#include <string.h>

enum { LANES = 8 };

typedef float FloatLanes __attribute__((vector_size(LANES * sizeof(float))));
typedef int32_t IntLanes __attribute__((vector_size(LANES * sizeof(int32_t))));

// The lanes of a comparison (0 or -1 each) that hold, as bits.
static inline unsigned lanes_bits(const IntLanes *holds)
{
#ifdef __AVX__
    FloatLanes signs;
    memcpy(&signs, holds, sizeof signs);
    return (unsigned)__builtin_ia32_movmskps256(signs);
#else
    unsigned bits = 0;
    for (int i = 0; i < LANES; i++) {
        bits |= (unsigned)(*holds)[i] & 1u << i;
    }
    return bits;
#endif
}

// Raises each lane of *most to the value's where that is larger.
static inline void lanes_raise(FloatLanes *most, const FloatLanes *values)
{
    IntLanes above = *values > *most;
    *most = (FloatLanes)((above & (IntLanes)*values) | (~above & (IntLanes)*most));
}

static inline float lanes_largest(const FloatLanes *values)
{
    float largest = (*values)[0];
#pragma omp simd reduction(max : largest)
    for (int i = 0; i < LANES; i++) {
        largest = (*values)[i] > largest ? (*values)[i] : largest;
    }
    return largest;
}

#endif
