// Guides of a denoiser without their own noise. A lens that blurs gives albedo and normal the noise
// of few samples; a filter that divides by the one and follows both keeps it as stipple.
#ifndef RAMIFY_IMAGE_DENOISE_GUIDES_H
#define RAMIFY_IMAGE_DENOISE_GUIDES_H

#include "image/denoise.h"

// Albedo and normal by non-local means with the variances of both (Rousselle 2013; prefiltered as
// by Bitterli 2016). Pixels without noise keep their values. input->guide_variance is given. Free
// both images; false: ERROR_MEMORY or ERROR_CANCELLED, and nothing is to be freed. The result does
// not depend on run->threads.
bool denoise_guides(const DenoiseInput *input, float strength, const Run *run, Image **albedo,
                    Image **normal, Error *e);

#endif
