#include "image/quantise.h"

#include <math.h>

static uint8_t quantise(float value, float threshold)
{
    float v = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f; // NaN becomes 0
    float step = floorf(v * 255.0f + threshold);
    return (uint8_t)(step < 255.0f ? step : 255.0f);
}

// Threshold in (0, 1) with blue-noise-like differences between neighbours: interleaved gradient
// noise (Jimenez 2014), offset per channel.
static float dither_threshold(int x, int y, int channel)
{
    float a = 0.06711056f * (float)(x + 47 * channel) + 0.00583715f * (float)(y + 17 * channel);
    float b = 52.9829189f * (a - floorf(a));
    return fminf(fmaxf(b - floorf(b), 1.0f / 64.0f), 63.0f / 64.0f);
}

uint8_t quantise_dithered(float value, int x, int y, int channel)
{
    return quantise(value, dither_threshold(x, y, channel));
}

uint8_t quantise_nearest(float value)
{
    return quantise(value, 0.5f);
}
