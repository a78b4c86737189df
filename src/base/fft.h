// Fast Fourier transform of a power of two of complex points, using exact arithmetic: the same bits
// on every machine.
#ifndef RAMIFY_BASE_FFT_H
#define RAMIFY_BASE_FFT_H

#include "base/error.h"

#include <stdint.h>

typedef struct Complex {
    double re, im;
} Complex;

static inline Complex complex_times(Complex a, Complex b)
{
    return (Complex){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

// Roots exp(-2 pi i k / count), k < count / 2, for fft_transform. count: a power of two, >= 2. The
// caller frees them.
Complex *fft_roots(int64_t count, Error *e);

// Transforms in place: x_j becomes the sum over k of x_k exp(-2 pi i j k / count), not normalised.
// root: from fft_roots with the same count.
void fft_transform(Complex *x, int64_t count, const Complex *root);

#endif
