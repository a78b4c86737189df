// From scene radiance to display values.
#ifndef RAMIFY_IMAGE_TONEMAP_H
#define RAMIFY_IMAGE_TONEMAP_H

#include "base/vec.h"
#include "image/image.h"

typedef enum ToneCurve { TONE_FILMIC, TONE_LINEAR } ToneCurve;

typedef struct ToneParams {
    ToneCurve curve;
    float exposure;             // stops
    bool auto_exposure;         // log-average luminance of the image goes to 0.18 before `exposure`
    float contrast, saturation; // 1 = as it is
    float white_balance;        // K: the light that shall look neutral; 0 or 6500 = none
    float bloom;                // share of light spread by the lens, 0..0.2
    float vignette;             // darkening at the corners, 0..1
} ToneParams;

ToneParams tone_params_default(void);

// The factor that takes the log-average luminance of what is not black in linear radiance to 0.18:
// what auto_exposure multiplies by.
float tone_auto_gain(const Image *image);

// image: linear radiance, 3 or 4 channels; with alpha, radiance is premultiplied (as films and EXRs
// hold it). The result has sRGB display values, straight (not premultiplied) beside the same alpha,
// as PNG wants them.
Image *tone_map(const Image *image, const ToneParams *params, Error *e);

#endif
