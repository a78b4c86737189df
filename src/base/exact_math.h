// Elementary functions from + - * / sqrt alone: the same bits on every machine and libm, for growth
// and geometry. Computed in double with series of more terms than a float can see; results are
// rounded once.
#ifndef RAMIFY_BASE_EXACT_MATH_H
#define RAMIFY_BASE_EXACT_MATH_H

// Sine and cosine of an angle in radians; error below 1e-7 for |angle| < 1e6, beyond that defined
// but no better than the angle's own rounding. NaN for what is not finite.
void exact_sincos(float angle, float *sine, float *cosine);

// The same to the last bits of a double for |angle| <= 7; error below 1e-15.
void exact_sincos_double(double angle, double *sine, double *cosine);

// Natural logarithm (-infinity for 0, NaN below) and e^x (0 below -700, infinity where a double
// ends). Relative error below 1e-14.
double exact_log(double x);
double exact_exp(double x);

// x^y; an x below 0 counts as 0. 0^0 = 1, 0^y is infinite for y < 0.
float exact_pow(float x, float y);

// Angle in radians of the vector (x, y), in (-pi, pi]; 0 for the zero vector.
float exact_atan2(float y, float x);

// Inverse cosine in radians; x is clamped to [-1, 1].
float exact_acos(float x);

#endif
