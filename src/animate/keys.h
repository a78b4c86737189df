// A value over time: keys, and how it goes from one to the next.
#ifndef RAMIFY_ANIMATE_KEYS_H
#define RAMIFY_ANIMATE_KEYS_H

#include "scene/scene.h"

typedef struct Keys {
    Ease ease;
    bool loop;           // after the last key comes the first again, one whole time later
    int count;           // >= 1
    int width;           // numbers a key, 1 .. SCENE_KEY_MOST_NUMBERS
    const double *at;    // count times, rising, in 0..1
    const double *value; // count * width
} Keys;

// The value at a time into value (width numbers). Without loop it stays before the first and after
// the last key. With loop any time is fine, and keys at both 0 and 1 are one key when they say the
// same (else there is a jump, as they ask for).
// EASE_SPLINE is the monotone cubic of Fritsch and Butland (1984): smooth through every key, and
// never beyond the two keys it is between.
void keys_at(const Keys *keys, double time, double *value);

// Which key holds at a time: the last one that is not later. For what cannot be in between.
int keys_step(const Keys *keys, double time);

// a + (b - a) s(u) with s of the ease: u itself, smoothstep, or 0.
double ease_between(Ease ease, double a, double b, double u);

#endif
