// The earth's atmosphere: light of the sun scattered by air (Rayleigh), aerosols (Mie) and absorbed
// by ozone, in eight wavelength bands; single scattering integrated along the ray, further orders
// from a table (air_orders.h). Lengths in km inside.
#ifndef RAMIFY_RENDER_SKY_ATMOSPHERE_H
#define RAMIFY_RENDER_SKY_ATMOSPHERE_H

#include "base/error.h"
#include "base/run.h"
#include "base/vec.h"
#include "render/sky/air_model.h"

typedef struct Atmosphere Atmosphere;

// turbidity: 1 = pure air, 2-3 clear, 6 hazy (Preetham et al. 1999); ground_albedo grey, 0..1;
// altitude: of the scene's ground above the sea, m; sine: of the elevation of the only sun that it
// will be asked about. Built in 0.2 s of processor time by run->threads threads.
Atmosphere *atmosphere_new(float turbidity, float ground_albedo, float altitude, float sine,
                           const Run *run, Error *e);
void atmosphere_free(Atmosphere *atmosphere); // NULL is fine

// Transmittance of the atmosphere for the sun at this sine of elevation, seen from near the ground.
Spectrum atmosphere_sun_transmittance(const Atmosphere *atmosphere, float sine);

// Radiance of the sky, W / (m^2 sr nm), seen from near the ground in direction (unit, +Y up) with
// the sun in direction sun. Below the horizon: of the air in front of the ground.
Spectrum atmosphere_radiance(const Atmosphere *atmosphere, Vec3 direction, Vec3 sun);

// The same in `count` directions of one elevation, in light[], for a third less work.
void atmosphere_radiance_level(const Atmosphere *atmosphere, const Vec3 *direction, int count,
                               Vec3 sun, Spectrum *light);

// The distance over which level air at sea level takes light of 550 nm to 1 / e, km.
float atmosphere_clear_length(float turbidity);

// Air between an eye and what it sees, for a sun of irradiance 1 in every band.
enum { AIR_STEPS = 12 };
typedef struct AirStretch {
    Spectrum clear; // transmittance
    Spectrum glow;  // light scattered more than once, toward the eye
    int steps;
    Spectrum sunlit[AIR_STEPS]; // sunlight scattered once toward the eye, by step
    double end[AIR_STEPS];      // km from the eye
} AirStretch;

// height: of the eye above the scene's ground, km; length: to what it sees, km.
void atmosphere_stretch(const Atmosphere *atmosphere, double height, Vec3 direction, Vec3 sun,
                        double length, AirStretch *stretch);

// The sun's irradiance outside the atmosphere, W / (m^2 nm).
Spectrum atmosphere_solar_irradiance(void);

// The contribution of a wavelength to each channel of linear Rec. 709 (some are negative): CIE
// 1931.
void wavelength_to_rgb(double nm, double rgb[3]);

// Radiance 1 in a band to linear Rec. 709 times luminance in cd/m^2; some are negative.
Vec3 spectrum_band_rgb(int band);

// Radiance per band to linear Rec. 709 times luminance in cd/m^2 (irradiance: lux). For many
// spectra look up the colours of the bands once: they are integrals.
typedef struct BandColors {
    Vec3 rgb[SPECTRUM_BANDS]; // spectrum_band_rgb
} BandColors;
BandColors spectrum_band_colors(void);
Vec3 spectrum_color(const Spectrum *spectrum, const BandColors *colors);
Vec3 spectrum_to_rgb(const Spectrum *spectrum);

#endif
