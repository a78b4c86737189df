#include "image/agx.h"

#include "base/color.h"
#include "image/color_matrix.h"

#include <math.h>
#include <stdbool.h>

// Of the log2 encoding, in stops from middle grey; and of the sigmoid, which works on values that
// are encoded for a display of this exponent.
static const float MIDDLE = 0.18f, LOW = -10.0f, HIGH = 6.5f, ENCODING = 2.2f;
static const float TOE_POWER = 1.5f, SHOULDER_POWER = 2.5f;

// The matrix that reads colours as coordinates of primaries which are nearer to white by these
// shares of their distances. The shares keep the hues of bright colours in Oklab as constant as
// possible without paling them much: less of blue, whose hue turns least.
static void inset_matrix(const double share[3], ColorMatrix out)
{
    double moved[3][2];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) {
            moved[i][k] = COLOR_REC709[i][k] + share[i] * (COLOR_D65[k] - COLOR_REC709[i][k]);
        }
    }
    ColorMatrix full, inset, inverse;
    color_matrix_to_xyz(COLOR_REC709, COLOR_D65, full);
    color_matrix_to_xyz(moved, COLOR_D65, inset);
    color_matrix_invert(full, inverse);
    color_matrix_multiply(inverse, inset, out);
}

static void fill_matrices(AgxFit *fit)
{
    const double in_share[3] = {0.30, 0.30, 0.20}, out_share[3] = {0.27, 0.20, 0.17};
    ColorMatrix inset, moved, outset;
    inset_matrix(in_share, inset);
    inset_matrix(out_share, moved);
    color_matrix_invert(moved, outset);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            fit->inset[i][j] = (float)inset[i][j];
            fit->outset[i][j] = (float)outset[i][j];
        }
    }
}

// The scale a of a h(slope x / a), h(u) = u / (1 + u^power)^(1 / power), that takes x = width to
// height.
static float half_scale(float slope, float width, float height, float power)
{
    double rise = (double)slope * (double)width, p = (double)power;
    double a = pow(rise, -p) * (pow(rise / (double)height, p) - 1.0);
    return (float)pow(a, -1.0 / p);
}

static float look_slope(AgxLook look)
{
    switch (look) {
    case AGX_BASE_CONTRAST:
        return 2.4f;
    case AGX_HIGH_CONTRAST:
        return 3.4f;
    case AGX_MEDIUM_HIGH_CONTRAST:
    case AGX_PUNCHY:
        break;
    }
    return 3.0f;
}

static float sigmoid(const AgxFit *fit, float t)
{
    bool bright = t > fit->x;
    float scale = bright ? fit->shoulder : fit->toe, power = bright ? SHOULDER_POWER : TOE_POWER;
    float u = fit->slope * fabsf(t - fit->x) / scale;
    float rise = scale * u / powf(1.0f + powf(u, power), 1.0f / power);
    float y = bright ? fit->y + rise : fit->y - rise;
    return y > 0.0f ? fminf(powf(y, ENCODING), 1.0f) : 0.0f;
}

AgxFit agx_fit(AgxLook look, float contrast)
{
    AgxFit fit = {.saturation = look == AGX_PUNCHY ? 1.25f : 1.0f};
    fill_matrices(&fit);
    float x = -LOW / (HIGH - LOW), y = powf(MIDDLE, 1.0f / ENCODING);
    float straight = fmaxf(y / x, (1.0f - y) / (1.0f - x)); // below, a half has no solution
    fit.x = x;
    fit.y = y;
    fit.slope = fmaxf(look_slope(look) * contrast, 1.02f * straight);
    fit.toe = half_scale(fit.slope, x, y, TOE_POWER);
    fit.shoulder = half_scale(fit.slope, 1.0f - x, 1.0f - y, SHOULDER_POWER);
    for (int i = 0; i <= AGX_STEPS; i++) {
        fit.sigmoid[i] = sigmoid(&fit, (float)i / (float)AGX_STEPS);
    }
    return fit;
}

float agx_curve(const AgxFit *fit, float x)
{
    float t = x > 0.0f ? (log2f(x / MIDDLE) - LOW) / (HIGH - LOW) : 0.0f;
    if (!(t > 0.0f) || t >= 1.0f) {
        return t >= 1.0f ? 1.0f : 0.0f;
    }
    float at = t * (float)AGX_STEPS;
    int i = (int)at;
    return lerpf(fit->sigmoid[i], fit->sigmoid[i + 1], at - (float)i);
}

// h(u) = v has the solution u = v / (1 - v^power)^(1 / power).
float agx_curve_inverse(const AgxFit *fit, float y)
{
    float encoded = powf(fminf(fmaxf(y, 0.0f), 1.0f), 1.0f / ENCODING);
    bool bright = encoded > fit->y;
    float scale = bright ? fit->shoulder : fit->toe, power = bright ? SHOULDER_POWER : TOE_POWER;
    float v = fabsf(encoded - fit->y) / scale;
    float u = v / powf(fmaxf(1.0f - powf(v, power), 1e-6f), 1.0f / power);
    float way = u * scale / fit->slope;
    float t = bright ? fminf(fit->x + way, 1.0f) : fmaxf(fit->x - way, 0.0f);
    return MIDDLE * exp2f(LOW + t * (HIGH - LOW));
}

// Mixes with the grey of the same luminance, as little as brings all channels into 0..1.
static void into_gamut(float rgb[3])
{
    float y = fminf(fmaxf(luminance_rgb(rgb), 0.0f), 1.0f), keep = 1.0f;
    for (int i = 0; i < 3; i++) {
        if (rgb[i] < 0.0f) {
            keep = fminf(keep, y / (y - rgb[i]));
        } else if (rgb[i] > 1.0f) {
            keep = fminf(keep, (1.0f - y) / (rgb[i] - y));
        }
    }
    for (int i = 0; i < 3; i++) {
        rgb[i] = fminf(fmaxf(y + keep * (rgb[i] - y), 0.0f), 1.0f);
    }
}

void agx_apply(const AgxFit *fit, float saturation, float rgb[3])
{
    float inset[3];
    color_matrix_apply(fit->inset, rgb, inset);
    for (int i = 0; i < 3; i++) {
        inset[i] = agx_curve(fit, inset[i]);
    }
    color_matrix_apply(fit->outset, inset, rgb);
    float y = luminance_rgb(rgb);
    for (int i = 0; i < 3; i++) {
        rgb[i] = y + (rgb[i] - y) * saturation * fit->saturation;
    }
    into_gamut(rgb);
}
