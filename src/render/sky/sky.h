// The description of the sky: daylight, night, a picture or one colour.
#ifndef RAMIFY_RENDER_SKY_SKY_H
#define RAMIFY_RENDER_SKY_SKY_H

#include "base/vec.h"

typedef enum SkyKind { SKY_NONE, SKY_CONSTANT, SKY_SUN_SKY, SKY_ENVIRONMENT, SKY_NIGHT } SkyKind;

typedef struct Sky {
    SkyKind kind;
    Vec3 color;          // SKY_CONSTANT: radiance
    float sun_elevation; // SKY_SUN_SKY: degrees above the horizon
    float sun_azimuth;   // degrees from +Z toward +X
    float sun_size;      // angular diameter, degrees; 0.53 in nature
    float sun_strength;  // factor on the sun alone, 1 = physical
    float turbidity;     // 1 = pure air, 2-3 clear, 6+ hazy
    float ground_albedo; // grey, for light bounced into the sky
    float clouds; // SKY_SUN_SKY: share of the sky under thin clouds, 0..1; seen, but not cast as
                  // light
    float moon;   // SKY_NIGHT: light of the full moon, 0 = none
    float moon_elevation; // degrees above the horizon
    float moon_azimuth;   // degrees from +Z toward +X
    float moon_size;      // angular diameter, degrees
    float stars;          // SKY_NIGHT: factor on their light
    float city_glow;      // SKY_NIGHT: light of towns along the horizon
    char *time; // "2026-10-14T17:40": places sun and moon (render/sky/ephemeris.h); NULL = not
    float latitude, longitude; // degrees, north and east positive; with time
    float sidereal;            // degrees: right ascension on the meridian; with time
    const char *file;          // SKY_ENVIRONMENT: latitude-longitude HDR, borrowed
    float rotation;            // of all of it, sun, moon, clouds and stars too: degrees about +Y
    float strength;            // factor on all of it
    bool visible;              // seen by camera rays; if not, the background is black with alpha 0
    float aerial_perspective;  // SKY_SUN_SKY: metres of air for a metre of the scene; 0 = none
    float altitude;            // SKY_SUN_SKY: of the scene's ground above the sea, m
    float haze_distance; // m over which distant surfaces fade to 1/e into the sky's horizon colour;
                         // 0 = no haze
} Sky;

#endif
