// Tone mapping: scene radiance to display values.
#ifndef RAMIFY_IMAGE_TONEMAP_H
#define RAMIFY_IMAGE_TONEMAP_H

#include "base/vec.h"
#include "image/agx.h"
#include "image/image.h"
#include "image/ocio.h"

typedef enum ViewTransform {
    VIEW_AGX,     // image/agx.h
    VIEW_FILMIC,  // tone_film
    VIEW_STANDARD // none: values above 1 are clipped
} ViewTransform;

typedef struct ToneParams {
    ViewTransform view;
    AgxLook look;               // of VIEW_AGX
    const OcioParams *color;    // borrowed; takes the place of view, look and contrast; NULL = none
    float exposure;             // stops
    bool auto_exposure;         // maps the image's log-average luminance to 0.18 before `exposure`
    float contrast, saturation; // 1 = unchanged; contrast is not for VIEW_STANDARD
    float white_balance;        // K: the light that becomes neutral; 0 or 6500 = none
    float bloom;                // fraction of light spread by the lens, 0..0.2
    float vignette;             // darkening at the corners, 0..1
} ToneParams;

ToneParams tone_params_default(void);

// The gain of auto_exposure: maps the log-average luminance of all pixels that are not black, in
// linear radiance, to 0.18.
float tone_auto_gain(const Image *image);

// The factor by which tone_map exposes an image: 2^exposure, and the gain of auto_exposure, which
// counts the light of `excess` (or NULL).
float tone_gain(const Image *image, const Image *excess, const ToneParams *params);

// image: linear radiance, 3 or 4 channels; with alpha, radiance is premultiplied (as in films and
// EXRs). excess: light that highlights_compress took from it, which counts in bloom and exposure;
// or NULL. The result has sRGB display values, straight (not premultiplied), with the same alpha,
// as PNG requires; with params->color, the display values of that view, within 0..1. Errors as of
// ocio_apply and image_new. The caller frees it.
Image *tone_map(const Image *image, const Image *excess, const ToneParams *params, Error *e);

#endif
