#include "render/sky/atmosphere.h"

#include "base/memory.h"
#include "render/sky/air_march.h"
#include "render/sky/air_orders.h"

#include <stdlib.h>

struct Atmosphere {
    double eye; // radius of the ground of the scene
    AirModel model;
    AirGlow glow;
};

// Means over bands about 400, 440 ... 680 nm of the extraterrestrial spectrum (ASTM E-490).
Spectrum atmosphere_solar_irradiance(void)
{
    return (Spectrum){{1.45f, 1.82f, 2.00f, 1.87f, 1.83f, 1.74f, 1.60f, 1.48f}};
}

static double lobe(double x, double center, double below, double above)
{
    double t = (x - center) / (x < center ? below : above);
    return exp(-0.5 * t * t);
}

// CIE 1931 colour matching, multi-lobe fit of Wyman, Sloan and Shirley, JCGT 2(2), 2013.
static void color_matching(double w, double xyz[3])
{
    xyz[0] = 1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) -
             0.065 * lobe(w, 501.1, 20.4, 26.2);
    xyz[1] = 0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1);
    xyz[2] = 1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8);
}

void wavelength_to_rgb(double nm, double rgb[3])
{
    double xyz[3];
    color_matching(nm, xyz);
    double x = xyz[0], y = xyz[1], z = xyz[2];
    rgb[0] = 3.2404542 * x - 1.5371385 * y - 0.4985314 * z;
    rgb[1] = -0.9692660 * x + 1.8760108 * y + 0.0415560 * z;
    rgb[2] = 0.0556434 * x - 0.2040259 * y + 1.0572252 * z;
}

Vec3 spectrum_band_rgb(int band)
{
    double sum[3] = {0.0, 0.0, 0.0};
    for (int w = 0; w < 40; w += 5) {
        double rgb[3];
        wavelength_to_rgb(380.0 + 40.0 * band + w + 2.5, rgb);
        for (int k = 0; k < 3; k++) {
            sum[k] += 683.0 * 5.0 * rgb[k];
        }
    }
    return vec3((float)sum[0], (float)sum[1], (float)sum[2]);
}

BandColors spectrum_band_colors(void)
{
    BandColors colors;
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        colors.rgb[i] = spectrum_band_rgb(i);
    }
    return colors;
}

Vec3 spectrum_color(const Spectrum *spectrum, const BandColors *colors)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        sum = vec3_madd(sum, spectrum->v[i], colors->rgb[i]);
    }
    return vec3_max(sum, vec3_splat(0.0f));
}

Vec3 spectrum_to_rgb(const Spectrum *spectrum)
{
    BandColors colors = spectrum_band_colors();
    return spectrum_color(spectrum, &colors);
}

float atmosphere_clear_length(float turbidity)
{
    return 1.0f / (air_rayleigh_extinction(0.55f) + air_mie_extinction(turbidity, 0.55f));
}

Atmosphere *atmosphere_new(float turbidity, float ground_albedo, float altitude, float sine,
                           const Run *run, Error *e)
{
    Atmosphere *a = memory_alloc_zero(1, sizeof *a, e);
    if (!a) {
        return NULL;
    }
    a->eye = GROUND_RADIUS + (double)altitude / 1000.0;
    air_model_init(&a->model, turbidity, ground_albedo);
    if (!air_orders_fill(&a->glow, &a->model, (double)sine, run, e)) {
        free(a);
        return NULL;
    }
    return a;
}

void atmosphere_free(Atmosphere *atmosphere)
{
    free(atmosphere);
}

Spectrum atmosphere_sun_transmittance(const Atmosphere *a, float sine)
{
    Spectrum result = {{0.0f}};
    Column c;
    if (air_column_to_space(&a->model, a->eye, (double)sine, &c)) {
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            result.v[i] = air_decay(air_extinction(&a->model, i, c));
        }
    }
    return result;
}

// A ray from `height` km above the scene's ground.
static AirRay ray_from(const Atmosphere *a, double height, Vec3 direction, Vec3 sun)
{
    float cosine = clampf(vec3_dot(direction, sun), -1.0f, 1.0f);
    return air_ray(fmax(a->eye + height, GROUND_RADIUS), (double)direction.y, (double)sun.y,
                   (double)cosine);
}

void atmosphere_radiance_level(const Atmosphere *a, const Vec3 *direction, int count, Vec3 sun,
                               Spectrum *light)
{
    Spectrum solar = atmosphere_solar_irradiance();
    AirPath path;
    for (int k = 0; k < count; k++) {
        AirRay ray = ray_from(a, 0.0, direction[k], sun);
        if (k == 0) {
            double length = air_distance_to_top(ray.r, ray.mu);
            air_meets_ground(ray.r, ray.mu, &length);
            air_path_find(&a->model, ray.r, ray.mu, length, AIR_PATH_STEPS, &path);
        }
        AirMarch m = air_march(&a->model, &a->glow, true, &ray, &path);
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            light[k].v[i] = (m.sunlit.v[i] + m.glow.v[i]) * solar.v[i];
        }
    }
}

Spectrum atmosphere_radiance(const Atmosphere *a, Vec3 direction, Vec3 sun)
{
    Spectrum light;
    atmosphere_radiance_level(a, &direction, 1, sun, &light);
    return light;
}

void atmosphere_stretch(const Atmosphere *a, double height, Vec3 direction, Vec3 sun, double length,
                        AirStretch *stretch)
{
    const double km_a_step = 4.0;
    AirRay ray = ray_from(a, height, direction, sun);
    AirMarch m = air_march_begin();
    double before = 0.0;
    stretch->steps = (int)fmin(2.0 + length / km_a_step, AIR_STEPS);
    for (int i = 0; i < stretch->steps; i++) {
        double part = (double)(i + 1) / stretch->steps, after = length * part * part;
        m.sunlit = (Spectrum){{0.0f}};
        air_march_on(&a->model, &a->glow, true, &ray, &m, before, after);
        stretch->sunlit[i] = m.sunlit;
        stretch->end[i] = before = after;
    }
    stretch->glow = m.glow;
    stretch->clear = m.clear;
}
