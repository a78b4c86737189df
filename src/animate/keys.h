// Keyframes: a value over time and its interpolation.
#ifndef RAMIFY_ANIMATE_KEYS_H
#define RAMIFY_ANIMATE_KEYS_H

#include "scene/scene.h"

typedef struct Keys {
    Ease ease;
    bool loop;           // after the last key the first follows, one period later
    int count;           // >= 1
    int width;           // numbers per key, 1 .. SCENE_KEY_MOST_NUMBERS
    const double *at;    // count times, increasing, in 0..1
    const double *value; // count * width
} Keys;

// Writes the value at a time into value (width numbers). Without loop it is constant before the
// first and after the last key. With loop any time is valid, and equal keys at 0 and 1 are the same
// key (different ones make a jump). EASE_SPLINE is monotone cubic interpolation (Fritsch and
// Butland 1984): smooth, without overshoot between keys.
void keys_at(const Keys *keys, double time, double *value);

// Index of the key in effect at a time: the last one not later. For values that cannot be
// interpolated.
int keys_step(const Keys *keys, double time);

// a + (b - a) s(u), with s the ease: u itself, smoothstep, or 0.
double ease_between(Ease ease, double a, double b, double u);

#endif
