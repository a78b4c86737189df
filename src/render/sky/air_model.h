// The matter of the atmosphere, molecules, aerosols and ozone, in eight wavelength bands:
// extinction, phase functions, and the columns from any height to space. Lengths in km; r is a
// radius from the earth's centre, mu the cosine of a direction's angle to the vertical.
#ifndef RAMIFY_RENDER_SKY_AIR_MODEL_H
#define RAMIFY_RENDER_SKY_AIR_MODEL_H

#include "base/vec.h"

#include <stdint.h>
#include <string.h>

#define GROUND_RADIUS 6360.0
#define TOP_RADIUS 6460.0

enum { SPECTRUM_BANDS = 8 }; // 40 nm each, 380 to 700 nm
enum { AIR_ALTITUDES = 48, AIR_ANGLES = 160 };

typedef struct Spectrum {
    float v[SPECTRUM_BANDS];
} Spectrum;

// Path lengths (km at sea-level density, for ozone at its peak) through the three constituents.
typedef struct Column {
    float rayleigh, mie, ozone;
} Column;

typedef struct AirModel {
    Spectrum rayleigh, mie, ozone; // extinction per km
    Spectrum mie_scattering;
    float ground_albedo;
    Column to_space[AIR_ALTITUDES][AIR_ANGLES]; // from the horizon upward
} AirModel;

// turbidity, ground_albedo: see atmosphere_new.
void air_model_init(AirModel *model, float turbidity, float ground_albedo);

// Extinction per km at sea level of molecules and of aerosols at a wavelength of um micrometres.
float air_rayleigh_extinction(float um);
float air_mie_extinction(float turbidity, float um);

// Relative to sea level, for ozone to its peak.
Column air_density(double altitude);

double air_distance_to_top(double r, double mu);
bool air_meets_ground(double r, double mu, double *distance);

// False where the ground is in the way.
bool air_column_to_space(const AirModel *model, double r, double mu, Column *column);

// e^-x for x of 0 to 1e9 to 2e-6, in a form that the compiler runs for all bands at once: a bound
// on x itself, instead of on the exponent, would be a branch.
static inline float air_decay(float x)
{
    float y = x * -1.44269504f;
    int whole = (int)y, exponent = whole + 127;
    float f = (y - (float)whole) * 0.69314718f;
    float p = 1.0f + f * (1.0f / 7.0f);
    for (int k = 6; k > 0; k--) {
        p = 1.0f + p * f * (1.0f / (float)k);
    }
    uint32_t bits = (uint32_t)(exponent > 0 ? exponent : 0) << 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    return p * power;
}

static inline float air_extinction(const AirModel *a, int band, Column c)
{
    return a->rayleigh.v[band] * c.rayleigh + a->mie.v[band] * c.mie + a->ozone.v[band] * c.ozone;
}

static inline float air_rayleigh_phase(float cosine)
{
    return 3.0f / (16.0f * PI_F) * (1.0f + cosine * cosine);
}

// Cornette and Shanks 1992.
static inline float air_mie_phase(float cosine)
{
    const float g = 0.8f;
    float d = 1.0f + g * g - 2.0f * g * cosine;
    return 3.0f / (8.0f * PI_F) * (1.0f - g * g) * (1.0f + cosine * cosine) /
           ((2.0f + g * g) * d * sqrtf(d));
}

#endif
