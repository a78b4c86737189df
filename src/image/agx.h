// A view transform after Troy Sobotka's AgX (Sobotka 2022): the primaries are moved
// toward white (inset), each channel is encoded in log2 and goes through a sigmoid, and the
// primaries are moved back (outset). Bright saturated colours therefore pale toward white and keep
// their hue, instead of running into the corners of the display's gamut.
#ifndef RAMIFY_IMAGE_AGX_H
#define RAMIFY_IMAGE_AGX_H

// Contrast and saturation of the picture.
typedef enum AgxLook {
    AGX_MEDIUM_HIGH_CONTRAST,
    AGX_BASE_CONTRAST, // flat, a start for grading
    AGX_HIGH_CONTRAST,
    AGX_PUNCHY // medium high contrast, more saturated
} AgxLook;

enum { AGX_STEPS = 2112 }; // 128 a stop: middle grey is one of them

typedef struct AgxFit {
    float inset[3][3], outset[3][3];
    float x, y;                   // middle grey in the sigmoid's coordinates
    float slope;                  // of the sigmoid there
    float toe, shoulder;          // scales of its two halves, which end at black and at white
    float saturation;             // of the look
    float sigmoid[AGX_STEPS + 1]; // display values over the log2 encoding, black to white
} AgxFit;

// contrast: factor on the look's slope at middle grey; limited to slopes that the sigmoid can have.
AgxFit agx_fit(AgxLook look, float contrast);

// Maps linear scene values to linear display values 0..1, in place. Greys stay grey, 0.18 maps to
// 0.18, 10 stops below it to black, 6.5 stops above it to white.
void agx_apply(const AgxFit *fit, float saturation, float rgb[3]);

// The sigmoid alone: what agx_apply does to greys, and its inverse, of 0..1.
float agx_curve(const AgxFit *fit, float x);
float agx_curve_inverse(const AgxFit *fit, float y);

#endif
