// Keys of the sky and of area lights.
#include "render/sky/ephemeris.h"
#include "render/world.h"
#include "scene/spec_check.h"

#include <math.h>

#define BIT(kind) (1u << (kind))

#define LOWEST_SUN (-10.0) // degrees, of sun_sky

static const EnumName SKY_KINDS[] = {{"sun_sky", SKY_SUN_SKY},   {"environment", SKY_ENVIRONMENT},
                                     {"constant", SKY_CONSTANT}, {"night", SKY_NIGHT},
                                     {"none", SKY_NONE},         {0}};

#define SKY_ANY (BIT(SKY_SUN_SKY) | BIT(SKY_ENVIRONMENT) | BIT(SKY_CONSTANT) | BIT(SKY_NIGHT))

static const Key SKY_KEYS[] = {
    {KEY_OF(Sky, kind, "kind", KEY_ENUM), .names = SKY_KINDS,
     .doc = "sun_sky: clear sky by day, at dusk or at dawn, computed from the sun's position; "
            "environment: HDR panorama from a file; constant: one colour in all directions; night: "
            "stars, airglow and the moon, exposed for the night; none: black."},
    {KEY_OF(Sky, color, "color", KEY_COLOR), .kinds = BIT(SKY_CONSTANT), .high = 1e9,
     .unit = "W/(m^2 sr)", .doc = "Radiance of the sky."},
    {KEY_OF(Sky, sun_elevation, "sun_elevation", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY),
     .low = LOWEST_SUN, .high = 90, .unit = "degrees",
     .doc = "Elevation of the sun above the horizon: 2 to 6 gives long shadows and warm light; "
            "below -0.3 the sun has set."},
    {KEY_OF(Sky, sun_azimuth, "sun_azimuth", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY), .low = -360,
     .high = 360, .unit = "degrees", .doc = "Azimuth of the sun, from +Z toward +X."},
    {KEY_OF(Sky, time, "time", KEY_TEXT), .kinds = BIT(SKY_SUN_SKY) | BIT(SKY_NIGHT),
     .doc = "Date and time, as 2026-10-14T17:40, which place sun, moon and stars, the first two "
            "instead of their elevations and azimuths, and give the moon its phase. With a zone "
            "(Z, +02:00) it is that of clocks; without one, "
            "local mean time: the sun is highest near 12:00. North is -Z, east +X, before "
            "`rotation`."},
    {KEY_OF(Sky, latitude, "latitude", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY) | BIT(SKY_NIGHT),
     .low = -90, .high = 90, .unit = "degrees", .doc = "Latitude for `time`, north positive."},
    {KEY_OF(Sky, longitude, "longitude", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY) | BIT(SKY_NIGHT),
     .low = -180, .high = 180, .unit = "degrees",
     .doc = "Longitude for a `time` with a zone, east positive."},
    {KEY_OF(Sky, sun_size, "sun_size", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY), .flags = KEY_ABOVE,
     .high = 90, .unit = "degrees",
     .doc = "Angular diameter of the sun; a larger sun casts softer shadows and is as bright in "
            "total."},
    {KEY_OF(Sky, sun_strength, "sun_strength", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY), .high = 1e6,
     .doc = "Multiplier of the sun's light only; 1 = physical, 0 = no sun."},
    {KEY_OF(Sky, turbidity, "turbidity", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY), .low = 1,
     .high = 10,
     .doc = "Haze in the air: 1 = pure air, 2 to 3 = clear, 6 or more = hazy, with a pale sky and "
            "a red sun."},
    {KEY_OF(Sky, ground_albedo, "ground_albedo", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY), .high = 1,
     .doc = "Reflectance of the ground; light that it reflects brightens the sky."},
    {KEY_OF(Sky, clouds, "clouds", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY), .high = 1,
     .doc = "Fraction of the sky covered by thin, high clouds; they are visible but cast no "
            "shadows. The "
            "scene's `clouds` do."},
    {KEY_OF(Sky, moon, "moon", KEY_FLOAT), .kinds = BIT(SKY_NIGHT), .high = 1e6,
     .doc = "Multiplier of the full moon's light: 1 = a moonlit landscape, 0 = no moon."},
    {KEY_OF(Sky, moon_elevation, "moon_elevation", KEY_FLOAT), .kinds = BIT(SKY_NIGHT), .low = -10,
     .high = 90, .unit = "degrees", .doc = "Elevation of the moon above the horizon."},
    {KEY_OF(Sky, moon_azimuth, "moon_azimuth", KEY_FLOAT), .kinds = BIT(SKY_NIGHT), .low = -360,
     .high = 360, .unit = "degrees", .doc = "Azimuth of the moon, from +Z toward +X."},
    {KEY_OF(Sky, moon_size, "moon_size", KEY_FLOAT), .kinds = BIT(SKY_NIGHT), .flags = KEY_ABOVE,
     .high = 90, .unit = "degrees", .doc = "Angular diameter of the moon."},
    {KEY_OF(Sky, stars, "stars", KEY_FLOAT), .kinds = BIT(SKY_NIGHT), .high = 1e6,
     .doc = "Multiplier of the starlight."},
    {KEY_OF(Sky, city_glow, "city_glow", KEY_FLOAT), .kinds = BIT(SKY_NIGHT), .high = 1e6,
     .doc = "Glow of city lights along the horizon: 1 = a suburb, 0 = none."},
    {KEY_OF(Sky, file, "file", KEY_FILE), .flags = KEY_REQUIRED, .kinds = BIT(SKY_ENVIRONMENT),
     .doc = "Latitude-longitude HDR panorama (.hdr, .exr), relative to the scene's folder."},
    {KEY_OF(Sky, rotation, "rotation", KEY_FLOAT), .kinds = SKY_ANY & ~BIT(SKY_CONSTANT),
     .low = -360000, .high = 360000, .unit = "degrees",
     .doc = "Rotation of the whole sky (panorama, sun, moon, clouds, stars) about +Y, from +Z "
            "toward +X."},
    {KEY_OF(Sky, strength, "strength", KEY_FLOAT), .kinds = SKY_ANY, .high = 1e9,
     .doc = "Multiplier of all light from the sky."},
    {KEY_OF(Sky, visible, "visible", KEY_BOOL), .kinds = SKY_ANY,
     .doc = "Show the sky to the camera; if false, the background is transparent."},
    {KEY_OF(Sky, altitude, "altitude", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY), .high = 9000,
     .unit = "m",
     .doc = "Altitude of the scene's ground (y = 0) above the sea: thinner air, a darker sky."},
    {KEY_OF(Sky, aerial_perspective, "aerial_perspective", KEY_FLOAT), .kinds = BIT(SKY_SUN_SKY),
     .high = 1e6,
     .doc =
         "Air between the camera and what it sees, in metres per metre of the scene: 1 = nature, "
         "in which `turbidity` 1, 1.3 and 2 let green light reach 86, 27 and 10 km to 1/e; "
         "more for scenes built small; 0 = none. Sunlit air is dark where terrain or clouds "
         "shade it."},
    {KEY_OF(Sky, haze_distance, "haze_distance", KEY_FLOAT), .kinds = SKY_ANY, .high = 1e9,
     .unit = "m",
     .doc = "Distance at which haze reduces a surface's light to 1/e and replaces the rest by the "
            "horizon's colour; 0 = no haze."},
    {0},
};

// Sun and moon at the sky's time.
static bool place_by_time(const Mapping *mapping, void *params)
{
    Sky *sky = params;
    double days;
    bool zoned;
    if (!sky->time) {
        return true;
    }
    if (!ephemeris_days(sky->time, &days, &zoned)) {
        return mapping_fail(mapping, "time",
                            " is '%s'; it must be a date and a time, such as 2026-10-14T17:40 or "
                            "2026-10-14T17:40+02:00",
                            sky->time);
    }
    double longitude = zoned ? (double)sky->longitude : 0.0;
    SkyPlace sun = ephemeris_sun(days, (double)sky->latitude, longitude);
    SkyPlace moon = ephemeris_moon(days, (double)sky->latitude, longitude);
    if (sky->kind == SKY_SUN_SKY && sun.elevation < LOWEST_SUN) {
        return mapping_fail(mapping, "time",
                            " is in the night: the sun is at %.1f degrees, and sun_sky needs at "
                            "least %g; kind: night shows stars and moon",
                            sun.elevation, LOWEST_SUN);
    }
    sky->sun_elevation = (float)sun.elevation;
    sky->sun_azimuth = (float)sun.azimuth;
    sky->moon_elevation = (float)fmax(moon.elevation, LOWEST_SUN);
    sky->moon_azimuth = (float)moon.azimuth;
    sky->sidereal = (float)ephemeris_sidereal(days, longitude);
    return true;
}

const Table sky_table = {
    .name = "sky",
    .doc = "Light from the environment: day sky, night sky, panorama or constant colour.",
    .example =
        "sky: {kind: sun_sky, sun_elevation: 4, sun_azimuth: 200, turbidity: 4, clouds: 0.3}\n",
    .size = sizeof(Sky),
    .keys = SKY_KEYS,
    .kind_key = "kind",
    .check = place_by_time};

static const EnumName LIGHT_KINDS[] = {{"quad", LIGHT_QUAD}, {"sphere", LIGHT_SPHERE}, {0}};

static const Key LIGHT_KEYS[] = {
    {KEY_OF(Light, kind, "kind", KEY_ENUM), .flags = KEY_REQUIRED, .names = LIGHT_KINDS,
     .doc = "quad: a parallelogram that emits to one side; sphere: a sphere."},
    {KEY_OF(Light, radiance, "radiance", KEY_COLOR), .high = 1e12, .unit = "W/(m^2 sr)",
     .doc = "Emitted radiance, which is power per area and solid angle: a light of half the area "
            "needs twice the radiance to be as bright."},
    {KEY_OF(Light, center, "center", KEY_VECTOR), .count = 3, .kinds = BIT(LIGHT_SPHERE),
     .unit = "m", .doc = "Centre of the sphere."},
    {KEY_OF(Light, radius, "radius", KEY_FLOAT), .kinds = BIT(LIGHT_SPHERE), .flags = KEY_ABOVE,
     .high = 1e6, .unit = "m", .doc = "Radius of the sphere."},
    {KEY_OF(Light, corner, "corner", KEY_VECTOR), .count = 3, .kinds = BIT(LIGHT_QUAD), .unit = "m",
     .doc = "One corner of the quad."},
    {KEY_OF(Light, edge_u, "edge_u", KEY_VECTOR), .count = 3, .kinds = BIT(LIGHT_QUAD), .unit = "m",
     .doc = "First edge, from the corner; the quad emits toward edge_u x edge_v."},
    {KEY_OF(Light, edge_v, "edge_v", KEY_VECTOR), .count = 3, .kinds = BIT(LIGHT_QUAD), .unit = "m",
     .doc = "Second edge, from the corner."},
    {0},
};

static void light_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    // A square of 1 m^2 at 3 m that emits downward; or a sphere of 10 cm radius at that place.
    *(Light *)out = (Light){.kind = kind < 0 ? LIGHT_SPHERE : (LightKind)kind,
                            .radiance = {10, 10, 10},
                            .center = {0, 3, 0},
                            .radius = 0.1f,
                            .corner = {-0.5f, 3, -0.5f},
                            .edge_u = {1, 0, 0},
                            .edge_v = {0, 0, 1}};
}

const Table light_table = {
    .name = "light",
    .doc = "An area light: a flat panel or a sphere.",
    .example =
        "lights:\n"
        "  - {kind: quad, corner: [-1, 3, 1], edge_u: [2, 0, 0], edge_v: [0, 0, 1], radiance: 8}\n"
        "  - {kind: sphere, center: [1, 0.5, 2], radius: 0.1, radiance: [40, 25, 10]}\n",
    .size = sizeof(Light),
    .keys = LIGHT_KEYS,
    .kind_key = "kind",
    .kind_defaults = light_defaults,
    .check = check_light};
