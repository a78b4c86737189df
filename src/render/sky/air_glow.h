// A table of the light around every point of the atmosphere that air or ground has already
// scattered, as that point scatters it on: mean radiances weighted by the phase functions. They are
// smooth in height and direction even where the light itself is not (Bruneton and Neyret,
// "Precomputed Atmospheric Scattering", EGSR 2008).
#ifndef RAMIFY_RENDER_SKY_AIR_GLOW_H
#define RAMIFY_RENDER_SKY_AIR_GLOW_H

#include "render/sky/air_model.h"

// Heights, the sun's elevations, elevations of a direction, and its azimuths from the sun's.
enum { GLOW_HEIGHTS = 12, GLOW_SUNS = 20, GLOW_TILTS = 16, GLOW_TURNS = 8 };

// Weighted by the phase function of molecules and of aerosols, for a sun of irradiance 1 in every
// band.
typedef struct GlowPair {
    Spectrum air, dust;
} GlowPair;

typedef struct AirGlow {
    int first_sun, last_sun; // the only ones whose entries are known, first_sun < last_sun
    GlowPair at[GLOW_HEIGHTS][GLOW_SUNS][GLOW_TILTS][GLOW_TURNS];
} AirGlow;

// Where the entries lie: radius, cosine of the sun's angle to the vertical, the direction's, and
// the azimuth (radians, 0 .. pi). Between the first and last they are interpolated.
double air_glow_radius(int height);
double air_glow_sun(int sun);
double air_tilt(int tilt, int tilts); // of so many: denser near the horizon
double air_turn(int turn, int turns);

// Sets which suns' entries are needed where the sun's sine of elevation is this near the ground:
// along a ray through the atmosphere it changes by no more than a few degrees.
void air_glow_set_suns(AirGlow *glow, double sine);

// turn: radians, 0 .. pi. Beyond the first and last sun these two stand for others.
GlowPair air_glow_at(const AirGlow *glow, double r, double mu_sun, double mu, float turn);

#endif
