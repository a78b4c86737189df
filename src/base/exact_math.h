// Elementary functions from + - * / sqrt alone, for growth and geometry: the same bits on every
// machine and libm. Computed in double with more series terms than a float can resolve; results are
// rounded once.
#ifndef RAMIFY_BASE_EXACT_MATH_H
#define RAMIFY_BASE_EXACT_MATH_H

// Sine and cosine of an angle in radians; error below 1e-7 for |angle| < 1e6, beyond that limited
// by the angle's own rounding. NaN for non-finite angles.
void exact_sincos(float angle, float *sine, float *cosine);

// The same with double precision for |angle| <= 7; error below 1e-15.
void exact_sincos_double(double angle, double *sine, double *cosine);

// Natural logarithm (-infinity for 0, NaN below) and e^x (0 below -700, infinity on overflow).
// Relative error below 1e-14.
double exact_log(double x);
double exact_exp(double x);

// x^y; a negative x counts as 0. 0^0 = 1, 0^y is infinite for y < 0.
float exact_pow(float x, float y);

// Angle in radians of the vector (x, y), in (-pi, pi]; 0 for the zero vector.
float exact_atan2(float y, float x);

// Inverse cosine in radians; x is clamped to [-1, 1].
float exact_acos(float x);

#endif
