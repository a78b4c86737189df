// The colour part of tone mapping: one pixel in, one pixel out.
#ifndef RAMIFY_IMAGE_TONE_CURVE_H
#define RAMIFY_IMAGE_TONE_CURVE_H

// y = x^g / (b x^g + c): film's characteristic curve. A toe by the power, a shoulder by saturation;
// middle grey 0.18 stays 0.18, and 5.5 stops above it are white.
typedef struct ToneCurveFit {
    float power, b, c;
} ToneCurveFit;

ToneCurveFit tone_curve_fit(float contrast);

// Linear scene values to linear display values 0..1, in place. Channels cross over a little before
// the curve, as dyes do, so bright colours pale toward white instead of turning hue.
void tone_film(const ToneCurveFit *fit, float saturation, float rgb[3]);

// Moves rgb from (below 1) or away from (above 1) its luminance; never negative.
void tone_saturate(float saturation, float rgb[3]);

// IEC 61966-2-1, there and back; both clamp to 0..1.
float tone_srgb_from_linear(float x);
float tone_linear_from_srgb(float x);

// Linear Rec. 709 matrix that makes light of this colour temperature (K; CIE daylight above 4000,
// Planckian below) neutral, by von Kries adaptation in the CAT16 space. Identity at 0 and 6500.
void tone_white_balance(float kelvin, float matrix[3][3]);

#endif
