// Airy's function Ai, the wave at the edge of light, as its integral: a table that is made once.
#ifndef RAMIFY_RENDER_RAIN_AIRY_H
#define RAMIFY_RENDER_RAIN_AIRY_H

enum { AIRY_STEPS = 12001 };

// Fills beyond[AIRY_STEPS] with the integral of Ai from y to infinity, for y from 6 down to -54.
void airy_fill(double *beyond);

// That integral at any y, linear between its values; 0 above the table and its mean, 1, below.
double airy_beyond(const double *beyond, double y);

#endif
