#include "render/sky/atmosphere.h"

#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double GROUND_RADIUS = 6360.0, TOP_RADIUS = 6460.0;

enum { AIR_ALTITUDES = 48, AIR_ANGLES = 160, GLOW_ALTITUDES = 12, GLOW_ANGLES = 32 };

// Path lengths (km at sea-level density, for ozone at its peak) through the three constituents.
typedef struct Column {
    float rayleigh, mie, ozone;
} Column;

struct Atmosphere {
    Spectrum rayleigh, mie, ozone; // extinction per km
    Spectrum mie_scattering;
    float ground_albedo;
    double eye; // radius of the ground of the scene
    Column to_space[AIR_ALTITUDES][AIR_ANGLES];
    Spectrum glow[GLOW_ALTITUDES]
                 [GLOW_ANGLES]; // light scattered twice and more, for sun irradiance
};

// ---- spectra

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

Vec3 spectrum_to_rgb(const Spectrum *spectrum)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        sum = vec3_madd(sum, spectrum->v[i], spectrum_band_rgb(i));
    }
    return vec3_max(sum, vec3_splat(0.0f));
}

// Bucholtz 1995: 0.0116 per km at 550 nm.
static float rayleigh_extinction(float um)
{
    return 0.0116f * powf(0.55f / um, 4.08f);
}

// Angstrom's law with exponent 1.3 and the turbidity coefficient of Preetham et al. 1999; scale
// height 1.2 km.
static float mie_extinction(float turbidity, float um)
{
    float beta = fmaxf(0.04608f * turbidity - 0.04586f, 0.0f);
    return beta * powf(um, -1.3f) / 1.2f;
}

float atmosphere_clear_length(float turbidity)
{
    return 1.0f / (rayleigh_extinction(0.55f) + mie_extinction(turbidity, 0.55f));
}

// Aerosols absorb 5 %. Ozone: Chappuis band, 300 Dobson units in a tent of half-width 15 km.
static void fill_coefficients(Atmosphere *a, float turbidity)
{
    static const float ozone_cross_section[SPECTRUM_BANDS] = {0.01f, 0.12f, 0.70f, 1.85f, 3.90f,
                                                              5.00f, 2.90f, 1.35f}; // 1e-25 m^2
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        float um = 0.4f + 0.04f * (float)i;
        a->rayleigh.v[i] = rayleigh_extinction(um);
        a->mie.v[i] = mie_extinction(turbidity, um);
        a->mie_scattering.v[i] = 0.95f * a->mie.v[i];
        a->ozone.v[i] = ozone_cross_section[i] * 1e-25f * 8.07e22f / 15.0f;
    }
}

// e^-x for x >= 0 to 2e-6, in a form that the compiler runs for all bands at once.
static inline float decay(float x)
{
    float y = x * -1.44269504f;
    y = y > -120.0f ? y : -120.0f;
    int whole = (int)y;
    float f = (y - (float)whole) * 0.69314718f;
    float p = 1.0f + f * (1.0f / 7.0f);
    for (int k = 6; k > 0; k--) {
        p = 1.0f + p * f * (1.0f / (float)k);
    }
    uint32_t bits = (uint32_t)(whole + 127) << 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    return p * power;
}

static Column density_at(double altitude)
{
    float h = altitude > 0.0 ? (float)altitude : 0.0f;
    float tent = 1.0f - fabsf(h - 25.0f) / 15.0f;
    return (Column){decay(h / 8.0f), decay(h / 1.2f), tent > 0.0f ? tent : 0.0f};
}

// ---- geometry of a ray from radius r whose direction has cosine mu to the vertical

static double distance_to_top(double r, double mu)
{
    double d = r * r * (mu * mu - 1.0) + TOP_RADIUS * TOP_RADIUS;
    return fmax(0.0, -r * mu + sqrt(fmax(0.0, d)));
}

static bool meets_ground(double r, double mu, double *distance)
{
    double d = r * r * (mu * mu - 1.0) + GROUND_RADIUS * GROUND_RADIUS;
    if (mu >= 0.0 || d < 0.0) {
        return false;
    }
    *distance = fmax(0.0, -r * mu - sqrt(d));
    return true;
}

static double horizon_cosine(double r)
{
    double q = GROUND_RADIUS / r;
    return -sqrt(fmax(0.0, 1.0 - q * q));
}

// ---- columns from a point to space, tabulated from the horizon upward

static Column integrate_column(double r, double mu)
{
    enum { STEPS = 64 };
    double length = distance_to_top(r, mu), before = 0.0;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < STEPS; i++) {
        double s = (double)(i + 1) / STEPS, after = length * s * s;
        double t = 0.5 * (before + after);
        double radius = sqrt(r * r + t * t + 2.0 * r * mu * t);
        Column d = density_at(radius - GROUND_RADIUS);
        sum[0] += (double)d.rayleigh * (after - before);
        sum[1] += (double)d.mie * (after - before);
        sum[2] += (double)d.ozone * (after - before);
        before = after;
    }
    return (Column){(float)sum[0], (float)sum[1], (float)sum[2]};
}

static void fill_columns(Atmosphere *a)
{
    for (int j = 0; j < AIR_ALTITUDES; j++) {
        double h = (double)j / (AIR_ALTITUDES - 1);
        double r = GROUND_RADIUS + (TOP_RADIUS - GROUND_RADIUS) * h * h;
        double low = horizon_cosine(r);
        for (int i = 0; i < AIR_ANGLES; i++) {
            double s = (double)i / (AIR_ANGLES - 1);
            a->to_space[j][i] = integrate_column(r, low + (1.0 - low) * s * s);
        }
    }
}

static Column column_mix(Column a, Column b, float t)
{
    return (Column){lerpf(a.rayleigh, b.rayleigh, t), lerpf(a.mie, b.mie, t),
                    lerpf(a.ozone, b.ozone, t)};
}

// False where the ground is in the way.
static bool column_to_space(const Atmosphere *a, double r, double mu, Column *column)
{
    double low = horizon_cosine(r);
    if (mu < low) {
        return false;
    }
    float y = (float)sqrt(fmax(0.0, r - GROUND_RADIUS) / (TOP_RADIUS - GROUND_RADIUS));
    float x = (float)sqrt((mu - low) / (1.0 - low));
    y = clampf(y, 0.0f, 1.0f) * (float)(AIR_ALTITUDES - 1);
    x = clampf(x, 0.0f, 1.0f) * (float)(AIR_ANGLES - 1);
    int j = y < (float)(AIR_ALTITUDES - 1) ? (int)y : AIR_ALTITUDES - 2;
    int i = x < (float)(AIR_ANGLES - 1) ? (int)x : AIR_ANGLES - 2;
    const Column *below = &a->to_space[j][i], *above = &a->to_space[j + 1][i];
    *column = column_mix(column_mix(below[0], below[1], x - (float)i),
                         column_mix(above[0], above[1], x - (float)i), y - (float)j);
    return true;
}

static inline float extinction(const Atmosphere *a, int band, Column c)
{
    return a->rayleigh.v[band] * c.rayleigh + a->mie.v[band] * c.mie + a->ozone.v[band] * c.ozone;
}

Spectrum atmosphere_sun_transmittance(const Atmosphere *a, float sine)
{
    Spectrum result = {{0.0f}};
    Column c;
    if (column_to_space(a, a->eye, (double)sine, &c)) {
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            result.v[i] = decay(extinction(a, i, c));
        }
    }
    return result;
}

// ---- marching along a ray

static float rayleigh_phase(float cosine)
{
    return 3.0f / (16.0f * PI_F) * (1.0f + cosine * cosine);
}

// Cornette and Shanks 1992.
static float mie_phase(float cosine)
{
    const float g = 0.8f;
    float d = 1.0f + g * g - 2.0f * g * cosine;
    return 3.0f / (8.0f * PI_F) * (1.0f - g * g) * (1.0f + cosine * cosine) /
           ((2.0f + g * g) * d * sqrtf(d));
}

static Spectrum glow_at(const Atmosphere *a, double r, double mu_sun)
{
    float y = (float)sqrt(fmax(0.0, r - GROUND_RADIUS) / (TOP_RADIUS - GROUND_RADIUS));
    y = clampf(y, 0.0f, 1.0f) * (float)(GLOW_ALTITUDES - 1);
    float x = clampf(0.5f + 0.5f * (float)mu_sun, 0.0f, 1.0f) * (float)(GLOW_ANGLES - 1);
    int j = y < (float)(GLOW_ALTITUDES - 1) ? (int)y : GLOW_ALTITUDES - 2;
    int i = x < (float)(GLOW_ANGLES - 1) ? (int)x : GLOW_ANGLES - 2;
    Spectrum result;
    for (int k = 0; k < SPECTRUM_BANDS; k++) {
        float below = lerpf(a->glow[j][i].v[k], a->glow[j][i + 1].v[k], x - (float)i);
        float above = lerpf(a->glow[j + 1][i].v[k], a->glow[j + 1][i + 1].v[k], x - (float)i);
        result.v[k] = lerpf(below, above, y - (float)j);
    }
    return result;
}

// A ray from radius r; mu, mu_sun and cosine are those of its angle to the vertical, of the sun's
// to the vertical, and of the ray's to the sun.
typedef struct AirRay {
    double r, mu, mu_sun, cosine;
    float phase[2]; // of air, of aerosols
    bool with_glow;
} AirRay;

// Results of the march, for a sun of irradiance 1 in every band.
typedef struct March {
    Spectrum sunlit;   // scattered once toward the eye
    Spectrum glow;     // scattered more than once
    Spectrum returned; // the same if the surroundings shone with radiance 1: Hillaire's f_ms
    Column passed;
} March;

// Adds the segment of length `step` around the point at radius r, behind `passed`.
static void gather(const Atmosphere *a, March *m, const AirRay *ray, double r, double mu_sun,
                   Column passed, Column density, double step)
{
    Column sun = {0.0f, 0.0f, 0.0f};
    bool lit = column_to_space(a, r, mu_sun, &sun);
    Spectrum glow = {{0.0f}};
    if (ray->with_glow) {
        glow = glow_at(a, r, mu_sun);
    }
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        float air = a->rayleigh.v[i] * density.rayleigh;
        float dust = a->mie_scattering.v[i] * density.mie;
        float seen = decay(extinction(a, i, passed)) * (float)step;
        float direct = lit ? decay(extinction(a, i, sun)) : 0.0f;
        m->sunlit.v[i] += seen * direct * (air * ray->phase[0] + dust * ray->phase[1]);
        m->glow.v[i] += seen * (air + dust) * glow.v[i];
        m->returned.v[i] += seen * (air + dust);
    }
}

// One step of the march, from `before` to `after` km.
static void march_on(const Atmosphere *a, March *m, const AirRay *ray, double before, double after)
{
    double t = 0.5 * (before + after);
    double radius = sqrt(ray->r * ray->r + t * t + 2.0 * ray->r * ray->mu * t);
    Column d = density_at(radius - GROUND_RADIUS);
    float half = 0.5f * (float)(after - before);
    Column middle = {m->passed.rayleigh + d.rayleigh * half, m->passed.mie + d.mie * half,
                     m->passed.ozone + d.ozone * half};
    double mu_here = (ray->r * ray->mu_sun + t * ray->cosine) / radius;
    gather(a, m, ray, radius, mu_here, middle, d, after - before);
    m->passed = (Column){middle.rayleigh + d.rayleigh * half, middle.mie + d.mie * half,
                         middle.ozone + d.ozone * half};
}

// Where step i of so many ends: shorter ones near the eye.
static double step_end(double length, int i, int steps)
{
    double s = (double)(i + 1) / steps;
    return length * s * s;
}

static March march(const Atmosphere *a, const AirRay *ray, double length, int steps)
{
    March m = {.sunlit = {{0.0f}}};
    double before = 0.0;
    for (int i = 0; i < steps; i++) {
        double after = step_end(length, i, steps);
        march_on(a, &m, ray, before, after);
        before = after;
    }
    return m;
}

// ---- light scattered more than once

// Mean over all directions of the light scattered twice, times the geometric series of all further
// orders (Hillaire, eq. 5-10).
static Spectrum multiple_scattering(const Atmosphere *a, double r, double mu_sun)
{
    enum { POLAR = 8, TURNS = 8 };
    const float isotropic = 0.25f / PI_F;
    Spectrum second = {{0.0f}}, share = {{0.0f}}, result;
    double sine_sun = sqrt(fmax(0.0, 1.0 - mu_sun * mu_sun));
    for (int k = 0; k < POLAR * TURNS; k++) {
        int ring = k / TURNS;
        double mu = -1.0 + 2.0 * (ring + 0.5) / POLAR;
        double turn = 2.0 * (double)PI_F * (k % TURNS + 0.5) / TURNS;
        double cosine = mu * mu_sun + sqrt(1.0 - mu * mu) * sine_sun * cos(turn);
        double length = distance_to_top(r, mu);
        bool ground = meets_ground(r, mu, &length);
        AirRay ray = {r, mu, mu_sun, cosine, {isotropic, isotropic}, false};
        March m = march(a, &ray, length, 16);
        Column sun;
        double foot = (r * mu_sun + length * cosine) / GROUND_RADIUS;
        bool lit = ground && foot > 0.0 && column_to_space(a, GROUND_RADIUS, foot, &sun);
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            second.v[i] += m.sunlit.v[i];
            share.v[i] += m.returned.v[i];
            if (lit) {
                float clear = decay(extinction(a, i, m.passed)) * decay(extinction(a, i, sun));
                second.v[i] += clear * (float)foot * a->ground_albedo / PI_F;
            }
        }
    }
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        float f = fminf(share.v[i] / (POLAR * TURNS), 0.99f);
        result.v[i] = second.v[i] / (POLAR * TURNS) / (1.0f - f);
    }
    return result;
}

Atmosphere *atmosphere_new(float turbidity, float ground_albedo, float altitude, const Run *run,
                           Error *e)
{
    Atmosphere *a = memory_alloc_zero(1, sizeof *a, e);
    if (!a) {
        return NULL;
    }
    a->ground_albedo = ground_albedo;
    a->eye = GROUND_RADIUS + (double)altitude / 1000.0;
    fill_coefficients(a, turbidity);
    fill_columns(a);
#pragma omp parallel for schedule(dynamic) num_threads(run->threads)
    for (int k = 0; k < GLOW_ALTITUDES * GLOW_ANGLES; k++) {
        int j = k / GLOW_ANGLES, i = k % GLOW_ANGLES;
        double h = (double)j / (GLOW_ALTITUDES - 1);
        double r = GROUND_RADIUS + fmax(1e-3, (TOP_RADIUS - GROUND_RADIUS) * h * h);
        a->glow[j][i] = multiple_scattering(a, r, -1.0 + 2.0 * (double)i / (GLOW_ANGLES - 1));
    }
    return a;
}

void atmosphere_free(Atmosphere *atmosphere)
{
    free(atmosphere);
}

// A ray from `height` km above the scene's ground.
static AirRay ray_from(const Atmosphere *a, double height, Vec3 direction, Vec3 sun)
{
    float cosine = clampf(vec3_dot(direction, sun), -1.0f, 1.0f);
    return (AirRay){.r = fmax(a->eye + height, GROUND_RADIUS),
                    .mu = (double)direction.y,
                    .mu_sun = (double)sun.y,
                    .cosine = (double)cosine,
                    .phase = {rayleigh_phase(cosine), mie_phase(cosine)},
                    .with_glow = true};
}

Spectrum atmosphere_radiance(const Atmosphere *a, Vec3 direction, Vec3 sun)
{
    AirRay ray = ray_from(a, 0.0, direction, sun);
    double length = distance_to_top(ray.r, ray.mu);
    meets_ground(ray.r, ray.mu, &length);
    March m = march(a, &ray, length, 48);
    Spectrum solar = atmosphere_solar_irradiance(), light;
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        light.v[i] = (m.sunlit.v[i] + m.glow.v[i]) * solar.v[i];
    }
    return light;
}

void atmosphere_stretch(const Atmosphere *a, double height, Vec3 direction, Vec3 sun, double length,
                        AirStretch *stretch)
{
    const double km_a_step = 4.0;
    AirRay ray = ray_from(a, height, direction, sun);
    March m = {.sunlit = {{0.0f}}};
    double before = 0.0;
    stretch->steps = (int)fmin(2.0 + length / km_a_step, AIR_STEPS);
    for (int i = 0; i < stretch->steps; i++) {
        double after = step_end(length, i, stretch->steps);
        m.sunlit = (Spectrum){{0.0f}};
        march_on(a, &m, &ray, before, after);
        stretch->sunlit[i] = m.sunlit;
        stretch->end[i] = before = after;
    }
    stretch->glow = m.glow;
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        stretch->clear.v[i] = decay(extinction(a, i, m.passed));
    }
}
