// The fast Fourier transform of a power of two of complex points, from exact arithmetic: the same
// bits on every machine.
#ifndef RAMIFY_BASE_FFT_H
#define RAMIFY_BASE_FFT_H

#include "base/error.h"

#include <stdint.h>

typedef struct Complex {
    double re, im;
} Complex;

// exp(-2 pi i k / count) for k < count / 2: what fft_transform needs. count: a power of two, >= 2.
// The caller frees it.
Complex *fft_roots(int64_t count, Error *e);

// In place: x_j becomes the sum over k of x_k exp(-2 pi i j k / count), not normalised. root: from
// fft_roots of the same count.
void fft_transform(Complex *x, int64_t count, const Complex *root);

#endif
