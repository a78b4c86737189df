// Per-pixel colour operations of tone mapping.
#ifndef RAMIFY_IMAGE_TONE_CURVE_H
#define RAMIFY_IMAGE_TONE_CURVE_H

// y = x^g / (b x^g + c): film's characteristic curve, with a toe by the power and a shoulder by
// saturation. Middle grey 0.18 maps to 0.18, 5.5 stops above it to white.
typedef struct ToneCurveFit {
    float power, b, c;
} ToneCurveFit;

ToneCurveFit tone_curve_fit(float contrast);

// Maps linear scene values to linear display values 0..1, in place. Channels are mixed slightly
// before the curve, as dyes do, so bright colours desaturate toward white instead of shifting hue.
void tone_film(const ToneCurveFit *fit, float saturation, float rgb[3]);

// Scales rgb's distance from its luminance (below 1: toward it); never negative.
void tone_saturate(float saturation, float rgb[3]);

// IEC 61966-2-1 transfer function and its inverse; both clamp to 0..1.
float tone_srgb_from_linear(float x);
float tone_linear_from_srgb(float x);

// Linear Rec. 709 matrix that makes light of this colour temperature (K; CIE daylight above 4000,
// Planckian below) neutral, by von Kries adaptation in CAT16 space (Li 2017). Identity at 0 and
// 6500.
void tone_white_balance(float kelvin, float matrix[3][3]);

#endif
