#include "image/tone_curve.h"

#include "base/color.h"
#include "image/color_matrix.h"

#include <math.h>
#include <string.h>

static float clamp_unit(float x)
{
    return x > 0.0f ? fminf(x, 1.0f) : 0.0f;
}

ToneCurveFit tone_curve_fit(float contrast)
{
    const double middle = 0.18, white = 0.18 * 45.25; // 5.5 stops
    double power = 1.4 * fmax((double)contrast, 0.1);
    power = fmax(power, 1.01); // below, the curve has no toe and no solution
    double m = pow(middle, power), w = pow(white, power);
    double b = (w - m / middle) / (w - m);
    double c = m * (1.0 / middle - 1.0) * w / (w - m); // w (1 - b) without cancellation
    return (ToneCurveFit){(float)power, (float)b, (float)c};
}

static float curve(const ToneCurveFit *fit, float x)
{
    float p = powf(x, fit->power);
    return fminf(1.0f, p / (fit->b * p + fit->c));
}

void tone_saturate(float saturation, float rgb[3])
{
    float y = luminance_rgb(rgb);
    for (int i = 0; i < 3; i++) {
        rgb[i] = fmaxf(0.0f, y + (rgb[i] - y) * saturation);
    }
}

void tone_film(const ToneCurveFit *fit, float saturation, float rgb[3])
{
    const float crossover = 0.15f; // also compensates the saturation that the power adds
    float mixed[3], y = luminance_rgb(rgb);
    for (int i = 0; i < 3; i++) {
        mixed[i] = curve(fit, rgb[i] + crossover * (y - rgb[i]));
    }
    tone_saturate(saturation, mixed);
    memcpy(rgb, mixed, sizeof mixed);
}

float tone_srgb_from_linear(float x)
{
    x = clamp_unit(x);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
}

float tone_linear_from_srgb(float x)
{
    x = clamp_unit(x);
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

// CIE xy of a light: Planckian locus (Kim 2002) below 4000 K, daylight locus above.
static void chromaticity(double t, double *x, double *y)
{
    if (t < 4000.0) {
        *x = -0.2661239e9 / (t * t * t) - 0.2343589e6 / (t * t) + 0.8776956e3 / t + 0.179910;
        double v = *x, v2 = v * v, v3 = v2 * v;
        *y = t < 2222.0 ? -1.1063814 * v3 - 1.34811020 * v2 + 2.18555832 * v - 0.20219683
                        : -0.9549476 * v3 - 1.37418593 * v2 + 2.09137015 * v - 0.16748867;
        return;
    }
    *x = t <= 7000.0 ? -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + 0.09911e3 / t + 0.244063
                     : -2.0064e9 / (t * t * t) + 1.9018e6 / (t * t) + 0.24748e3 / t + 0.237040;
    *y = -3.0 * *x * *x + 2.870 * *x - 0.275;
}

// Cone responses to a light of luminance 1.
static void cones_of(ColorMatrix cat, double kelvin, double cones[3])
{
    double x, y;
    chromaticity(kelvin, &x, &y);
    double xyz[3] = {x / y, 1.0, (1.0 - x - y) / y};
    for (int i = 0; i < 3; i++) {
        cones[i] = cat[i][0] * xyz[0] + cat[i][1] * xyz[1] + cat[i][2] * xyz[2];
    }
}

void tone_white_balance(float kelvin, float matrix[3][3])
{
    ColorMatrix xyz_of_rgb = {{0.4124564, 0.3575761, 0.1804375},
                              {0.2126729, 0.7151522, 0.0721750},
                              {0.0193339, 0.1191920, 0.9503041}};
    ColorMatrix cat = {{0.401288, 0.650173, -0.051461}, // Li 2017
                       {-0.250268, 1.204414, 0.045854},
                       {-0.002079, 0.048952, 0.953127}};
    ColorMatrix scale = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (kelvin > 0.0f && fabsf(kelvin - 6500.0f) > 0.5f) {
        double from[3], to[3];
        cones_of(cat, fmin(fmax((double)kelvin, 1667.0), 25000.0), from);
        cones_of(cat, 6500.0, to);
        for (int i = 0; i < 3; i++) {
            scale[i][i] = to[i] / from[i];
        }
    }
    ColorMatrix forth, back, scaled, result;
    color_matrix_multiply(cat, xyz_of_rgb, forth);
    color_matrix_invert(forth, back);
    color_matrix_multiply(scale, forth, scaled);
    color_matrix_multiply(back, scaled, result);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            matrix[i][j] = (float)result[i][j];
        }
    }
}
