// Fractional Brownian motion (Mandelbrot and Van Ness 1968; Tanaka eq. (14); Tanaka report eq.
// (17)): the Gaussian process with B(0) = 0 and covariance E B(s) B(t) = (s^2H + t^2H - |s - t|^2H)
// / 2, sampled exactly at the integers by circulant embedding (Davies and Harte 1987) in O(n log
// n).
#ifndef RAMIFY_BASE_FBM_H
#define RAMIFY_BASE_FBM_H

#include "base/error.h"

#include <stdint.h>

enum { FBM_MOST_STEPS = 1 << 24 };

typedef struct Fbm Fbm; // caches the spectra of lengths sampled so far; not thread-safe

// hurst: the exponent H, 0 < H < 1: 0.5 = ordinary Brownian motion, smaller is rougher, larger is
// smoother. ERROR_INPUT otherwise. Free with fbm_free.
Fbm *fbm_new(double hurst, Error *e);
void fbm_free(Fbm *fbm); // NULL is fine

// Samples two independent paths a and b, each of steps + 1 values B(0) .. B(steps), steps >= 1;
// both depend on hurst, steps and key alone. ERROR_INPUT beyond FBM_MOST_STEPS.
bool fbm_paths(Fbm *fbm, int64_t steps, uint64_t key, double *a, double *b, Error *e);

// The same conditioned on B(steps) = 0: exactly B(t) - Cov(B(t), B(n)) / Var(B(n)) B(n). Both ends
// are exactly 0.
bool fbm_bridges(Fbm *fbm, int64_t steps, uint64_t key, double *a, double *b, Error *e);

// E B(s) B(t), s, t >= 0.
double fbm_covariance(double hurst, double s, double t);

#endif
