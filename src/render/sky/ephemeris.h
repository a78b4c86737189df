// Where sun and moon stand at a time and a place on the Earth.
#ifndef RAMIFY_RENDER_SKY_EPHEMERIS_H
#define RAMIFY_RENDER_SKY_EPHEMERIS_H

#include <stdbool.h>

// A place in the sky, degrees.
typedef struct SkyPlace {
    double elevation; // apparent: raised by refraction
    double azimuth;   // as of a Sky: from +Z (south) toward +X (east); north is -Z
} SkyPlace;

// Days from noon of 2000-01-01, universal time, of "2026-10-14T17:40", seconds and a zone ("Z",
// "+02:00") optional. Without a zone *zoned is false, and the time is that of sundials but for the
// equation of time (local mean time). False when the text is no such time.
bool ephemeris_days(const char *text, double *days, bool *zoned);

// latitude, longitude: degrees, north and east positive. Low precision formulas of the Astronomical
// Almanac, for 1950 to 2050: the sun within 0.01 degrees, the moon (seen from the place, not from
// the Earth's centre) within 0.3.
SkyPlace ephemeris_sun(double days, double latitude, double longitude);
SkyPlace ephemeris_moon(double days, double latitude, double longitude);

// Right ascension on the meridian, degrees, 0 .. 360.
double ephemeris_sidereal(double days, double longitude);

#endif
