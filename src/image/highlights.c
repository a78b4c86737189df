#include "image/highlights.h"

#include <math.h>
#include <string.h>

enum { PARTS = 3 };

static const float LEAST_SHARE = 1e-5f; // rounding leaves less

// Shares and radiance of a pixel's parts. Returns how many there are.
static int pixel_parts(const HighlightParts *parts, int64_t i, const float rgba[4],
                       float share[PARTS], float radiance[PARTS][3])
{
    const Vec3 light = parts->light[i], sky = parts->sky[i];
    const float seen[2][3] = {{light.x, light.y, light.z}, {sky.x, sky.y, sky.z}};
    share[0] = parts->light_share[i];
    share[1] = parts->sky_share[i];
    share[2] = rgba[3] - share[0] - share[1];
    memcpy(radiance, seen, sizeof seen);
    for (int c = 0; c < 3; c++) {
        radiance[2][c] = fmaxf(0.0f, rgba[c] - seen[0][c] - seen[1][c]);
    }
    int count = 0;
    for (int k = 0; k < PARTS; k++) {
        count += share[k] > LEAST_SHARE;
    }
    return count;
}

// The radiance that the curve shows as the mean of the parts.
static float shown_mean(const AgxFit *curve, float gain, const float share[PARTS],
                        const float radiance[PARTS])
{
    float shown = 0.0f, total = 0.0f, mean = 0.0f;
    for (int k = 0; k < PARTS; k++) {
        if (share[k] > LEAST_SHARE) {
            shown += share[k] * agx_curve(curve, gain * radiance[k] / share[k]);
            total += share[k];
            mean += radiance[k];
        }
    }
    if (!(shown > 0.0f)) { // black in this view; others may show it
        return mean;
    }
    return total * agx_curve_inverse(curve, shown / total) / gain;
}

void highlights_compress(Image *image, Image *excess, const HighlightParts *parts,
                         const ToneParams *params)
{
    const AgxFit curve = agx_fit(params->look, params->contrast);
    float gain = tone_gain(image, NULL, params);
    int64_t count = (int64_t)image->width * image->height;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < count; i++) {
        float *p = image->pixel + 4 * i, *lost = excess->pixel + 3 * i;
        float share[PARTS], radiance[PARTS][3];
        if (pixel_parts(parts, i, p, share, radiance) < 2) {
            memset(lost, 0, 3 * sizeof *lost);
            continue;
        }
        for (int c = 0; c < 3; c++) {
            float channel[PARTS] = {radiance[0][c], radiance[1][c], radiance[2][c]};
            float mean = shown_mean(&curve, gain, share, channel);
            lost[c] = p[c] - mean;
            p[c] = mean;
        }
    }
}
