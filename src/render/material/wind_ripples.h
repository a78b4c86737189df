// Ripples that a light wind makes on water of a short fetch, a lake's or a pond's, in patches
// between still water: the cat's paws of gusts. Their slopes are a sum of sines whose variances are
// those of the sea's spectrum; what a pixel does not resolve is told as a variance, so that
// resolved and hidden slopes together are the same from any distance.
#ifndef RAMIFY_RENDER_MATERIAL_WIND_RIPPLES_H
#define RAMIFY_RENDER_MATERIAL_WIND_RIPPLES_H

#include "base/vec.h"

typedef struct RippleWind {
    float speed;   // m/s at 10 m, above 0
    Vec2 way;      // unit, in plan: whereto it blows
    float calm;    // 0..1: share of the water that gusts leave still
    float gusts;   // m: about the size of the patches; 0 = 90
    float longest; // m: the longest ripples; 0 = those that the wind raises over 1 km
} RippleWind;

enum { RIPPLE_OCTAVES = 12, RIPPLE_EACH = 7 }; // at most; of an octave

// A sine of them.
typedef struct Ripple {
    Vec2 way;            // unit
    float number, phase; // 1/m; radians
} Ripple;

// A wind and its ripples, which are the same everywhere but for the phase.
typedef struct WindRipples {
    RippleWind wind;
    int octaves;
    float longest;                // m
    float wander[RIPPLE_EACH][2]; // how the phases of an octave follow its two noises
    Ripple ripple[RIPPLE_OCTAVES][RIPPLE_EACH];
} WindRipples;

WindRipples wind_ripples_of(const RippleWind *wind);

// The part of a pixel on the water.
typedef struct RipplePixel {
    Vec2 view;    // unit, in plan: the way along which it is long
    float length; // m
    float width;  // m across that
} RipplePixel;

typedef struct RipplePoint {
    Vec2 slope;       // of the surface along x and z, of ripples that the pixel resolves
    float roughness2; // variance of the slopes of the others, summed over both axes
    float cover;      // 0..1: share of the pixel that gusts ripple
} RipplePoint;

// At a place in plan, m.
RipplePoint wind_ripples_at(const WindRipples *ripples, Vec2 place, const RipplePixel *pixel);

// Variance of all slopes, summed over both axes, where gusts ripple the water (Cox and Munk 1954,
// J. Opt. Soc. Am. 44, 838: 0.003 + 0.00512 of the wind in m/s), and its mean over the lake, with
// the little that still water has.
float wind_ripples_variance(const RippleWind *wind);
float wind_ripples_mean_variance(const RippleWind *wind);

#endif
