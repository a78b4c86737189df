// Sun and moon against events that almanacs print.
#include "render/sky/ephemeris.h"
#include "testing.h"

#include <math.h>

static double days_of(const char *time)
{
    double days;
    bool zoned;
    if (!ephemeris_days(time, &days, &zoned)) {
        fail_msg("%s is not read", time);
    }
    return days;
}

static void assert_near(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance)) {
        fail_msg("%.6g, not %.6g +- %g", value, wanted, tolerance);
    }
}

// Degrees between two places in the sky.
static double apart(SkyPlace a, SkyPlace b)
{
    const double r = acos(-1.0) / 180.0;
    double c = sin(a.elevation * r) * sin(b.elevation * r) +
               cos(a.elevation * r) * cos(b.elevation * r) * cos((a.azimuth - b.azimuth) * r);
    return acos(fmin(fmax(c, -1.0), 1.0)) / r;
}

static void times_are_read(void **state)
{
    (void)state;
    assert_near(days_of("2000-01-01T12:00Z"), 0.0, 1e-9);
    assert_near(days_of("1999-12-31T12:00Z"), -1.0, 1e-9);
    assert_near(days_of("2000-03-01T12:00"), 60.0, 1e-9); // a leap year
    assert_near(days_of("2026-10-14T17:40+02:00"), days_of("2026-10-14T15:40:00Z"), 1e-9);
    assert_near(days_of("2026-10-14T17:40:30-05:30") - days_of("2026-10-14T23:10Z"), 30.0 / 86400,
                1e-9);
    static const char *const BAD[] = {"",
                                      "noon",
                                      "2026-10-14",
                                      "2026-13-14T17:40",
                                      "2026-02-29T17:40",
                                      "2026-10-14T24:00",
                                      "2026-10-14T17:60",
                                      "2026-10-14T17:40+",
                                      "2026-10-14T17:40 ",
                                      "2026-10-14 17:40",
                                      "26-10-14T17:40",
                                      "2026-10-14T17:40:61"};
    for (unsigned i = 0; i < sizeof BAD / sizeof *BAD; i++) {
        double days;
        bool zoned;
        if (ephemeris_days(BAD[i], &days, &zoned)) {
            fail_msg("'%s' is read", BAD[i]);
        }
    }
}

// At its highest the sun stands in the south, 90 - latitude + declination high.
static void the_sun_culminates_where_it_must(void **state)
{
    (void)state;
    SkyPlace june = ephemeris_sun(days_of("2026-06-21T12:02Z"), 51.48, 0.0);
    assert_near(june.elevation, 90.0 - 51.48 + 23.436, 0.05);
    assert_near(june.azimuth, 0.0, 0.5);
    SkyPlace december = ephemeris_sun(days_of("2026-12-21T12:00"), 51.48, 0.0);
    assert_near(december.elevation, 90.0 - 51.48 - 23.436, 0.1);
    SkyPlace sydney = ephemeris_sun(days_of("2026-12-21T11:58"), -33.87, 0.0);
    assert_near(sydney.elevation, 90.0 - 33.87 + 23.436, 0.1);
    assert_near(fabs(sydney.azimuth), 180.0, 3.0); // in the north
}

// London, midsummer: sunrise at 04:43 in the north-east, sunset at 21:21 in the north-west.
static void the_sun_rises_when_almanacs_say(void **state)
{
    (void)state;
    SkyPlace rise = ephemeris_sun(days_of("2026-06-21T04:43+01:00"), 51.507, -0.128);
    SkyPlace set = ephemeris_sun(days_of("2026-06-21T21:21+01:00"), 51.507, -0.128);
    assert_near(rise.elevation, -0.27, 0.15); // the upper limb on the horizon
    assert_near(set.elevation, -0.27, 0.15);
    assert_near(rise.azimuth, 180.0 - 49.0, 1.0); // 49 degrees east of north
    assert_near(set.azimuth, -180.0 + 49.0, 1.0);
}

// Total eclipse of the sun, Oviedo, 2026-08-12 18:28 UTC; of the moon, 2026-03-03 11:33 UTC, seen
// from Honolulu.
static void eclipses_happen(void **state)
{
    (void)state;
    double days = days_of("2026-08-12T20:28+02:00");
    SkyPlace sun = ephemeris_sun(days, 43.36, -5.85), moon = ephemeris_moon(days, 43.36, -5.85);
    assert_near(sun.elevation, 10.5, 1.5);
    assert_near(apart(sun, moon), 0.0, 0.35);
    days = days_of("2026-03-03T11:33Z");
    sun = ephemeris_sun(days, 21.3, -157.86);
    moon = ephemeris_moon(days, 21.3, -157.86);
    assert_true(moon.elevation > 30.0);
    assert_near(apart(sun, moon), 180.0, 1.6); // parallax and refraction of half a degree each
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_are_read),
        cmocka_unit_test(the_sun_culminates_where_it_must),
        cmocka_unit_test(the_sun_rises_when_almanacs_say),
        cmocka_unit_test(eclipses_happen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
