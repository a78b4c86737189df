#include "render/sky/ephemeris.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define RADIANS (3.14159265358979323846 / 180.0)

static double sine(double degrees)
{
    return sin(degrees * RADIANS);
}

static double cosine(double degrees)
{
    return cos(degrees * RADIANS);
}

// ---- time ----

static bool is_leap(int year)
{
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

static int days_of_month(int year, int month)
{
    static const int DAYS[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return DAYS[month - 1] + (month == 2 && is_leap(year));
}

// Days from 2000-01-01 to a date of the Gregorian calendar.
static int day_number(int year, int month, int day)
{
    int number = day - 1;
    for (int m = 1; m < month; m++) {
        number += days_of_month(year, m);
    }
    int past = year - 1;
    return number + 365 * (year - 2000) + (past / 4 - past / 100 + past / 400) - 484;
}

// "Z", "+02:00" or nothing, up to the end of the text.
static bool read_zone(const char *text, double *hours, bool *zoned)
{
    int hour, minute, used = 0;
    char sign;
    *hours = 0.0;
    *zoned = *text != '\0';
    if (!*zoned || strcmp(text, "Z") == 0) {
        return true;
    }
    bool read = sscanf(text, "%c%2d:%2d%n", &sign, &hour, &minute, &used) == 3 && !text[used] &&
                (sign == '+' || sign == '-') && hour >= 0 && hour <= 14 && minute >= 0 &&
                minute < 60;
    if (read) {
        *hours = (sign == '-' ? -1.0 : 1.0) * (hour + minute / 60.0);
    }
    return read;
}

bool ephemeris_days(const char *text, double *days, bool *zoned)
{
    int year, month, day, hour, minute, used = 0, more = 0;
    double second = 0.0, zone;
    if (sscanf(text, "%4d-%2d-%2dT%2d:%2d%n", &year, &month, &day, &hour, &minute, &used) != 5 ||
        used != 16) {
        return false;
    }
    if (text[used] == ':') {
        int whole;
        if (sscanf(text + used, ":%2d%n", &whole, &more) != 1 || more != 3) {
            return false;
        }
        second = whole;
    }
    bool sound = year >= 1 && month >= 1 && month <= 12 && day >= 1 &&
                 day <= days_of_month(year, month) && hour >= 0 && hour < 24 && minute >= 0 &&
                 minute < 60 && second >= 0.0 && second < 60.0;
    if (!sound || !read_zone(text + used + more, &zone, zoned)) {
        return false;
    }
    *days =
        day_number(year, month, day) + (hour - zone + minute / 60.0 + second / 3600.0) / 24.0 - 0.5;
    return true;
}

// ---- places ----

// Ecliptic longitude and latitude, degrees; distance in radii of the Earth.
typedef struct Ecliptic {
    double longitude, latitude, distance;
} Ecliptic;

// Apparent elevation of what stands at a true one: Saemundsson 1986.
static double refracted(double elevation)
{
    double e = fmax(elevation, -2.0);
    return elevation + 1.02 / 60.0 / tan((e + 10.3 / (e + 5.11)) * RADIANS);
}

double ephemeris_sidereal(double days, double longitude)
{
    double degrees = fmod(280.46062 + 360.98564737 * days + longitude, 360.0);
    return degrees < 0.0 ? degrees + 360.0 : degrees;
}

static SkyPlace seen_from(Ecliptic e, double days, double latitude, double longitude)
{
    double tilt = 23.439 - 4e-7 * days;
    double x = cosine(e.latitude) * cosine(e.longitude);
    double y =
        cosine(tilt) * cosine(e.latitude) * sine(e.longitude) - sine(tilt) * sine(e.latitude);
    double z =
        sine(tilt) * cosine(e.latitude) * sine(e.longitude) + cosine(tilt) * sine(e.latitude);
    double sidereal = ephemeris_sidereal(days, longitude);
    // Toward the place's meridian, east and the celestial pole; then up, east and south.
    double meridian = x * cosine(sidereal) + y * sine(sidereal);
    double east = -x * sine(sidereal) + y * cosine(sidereal);
    double up = meridian * cosine(latitude) + z * sine(latitude) - 1.0 / e.distance;
    double south = meridian * sine(latitude) - z * cosine(latitude);
    double elevation = atan2(up, sqrt(east * east + south * south)) / RADIANS;
    return (SkyPlace){refracted(elevation), atan2(east, south) / RADIANS};
}

SkyPlace ephemeris_sun(double days, double latitude, double longitude)
{
    double anomaly = 357.528 + 0.9856003 * days;
    double place = 280.460 + 0.9856474 * days + 1.915 * sine(anomaly) + 0.020 * sine(2.0 * anomaly);
    return seen_from((Ecliptic){place, 0.0, 23481.0}, days, latitude, longitude);
}

SkyPlace ephemeris_moon(double days, double latitude, double longitude)
{
    double t = days / 36525.0;
    Ecliptic moon = {
        .longitude = 218.32 + 481267.881 * t + 6.29 * sine(135.0 + 477198.87 * t) -
                     1.27 * sine(259.3 - 413335.36 * t) + 0.66 * sine(235.7 + 890534.22 * t) +
                     0.21 * sine(269.9 + 954397.74 * t) - 0.19 * sine(357.5 + 35999.05 * t) -
                     0.11 * sine(186.5 + 966404.03 * t),
        .latitude = 5.13 * sine(93.3 + 483202.02 * t) + 0.28 * sine(228.2 + 960400.89 * t) -
                    0.28 * sine(318.3 + 6003.15 * t) - 0.17 * sine(217.6 - 407332.21 * t)};
    double parallax =
        0.9508 + 0.0518 * cosine(135.0 + 477198.87 * t) + 0.0095 * cosine(259.3 - 413335.36 * t) +
        0.0078 * cosine(235.7 + 890534.22 * t) + 0.0028 * cosine(269.9 + 954397.74 * t);
    moon.distance = 1.0 / sine(parallax);
    return seen_from(moon, days, latitude, longitude);
}
