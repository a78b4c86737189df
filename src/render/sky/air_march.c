#include "render/sky/air_march.h"

#include "base/exact_math.h"

AirRay air_ray(double r, double mu, double mu_sun, double cosine)
{
    double sines = sqrt(fmax(0.0, 1.0 - mu * mu)) * sqrt(fmax(0.0, 1.0 - mu_sun * mu_sun));
    float across = sines > 1e-9 ? (float)((cosine - mu * mu_sun) / sines) : 1.0f;
    return (AirRay){r, mu, mu_sun, cosine, exact_acos(clampf(across, -1.0f, 1.0f))};
}

// Adds what the point at radius r scatters of the sun's own light. seen: length of the segment, as
// far as it is seen.
static void add_sunlit(const AirModel *a, AirMarch *m, const AirRay *ray, double r, double mu_sun,
                       const Spectrum *seen, Column density)
{
    Column sun;
    if (!air_column_to_space(a, r, mu_sun, &sun)) {
        return;
    }
    float air = density.rayleigh * air_rayleigh_phase((float)ray->cosine);
    float dust = density.mie * air_mie_phase((float)ray->cosine);
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        m->sunlit.v[i] += seen->v[i] * air_decay(air_extinction(a, i, sun)) *
                          (a->rayleigh.v[i] * air + a->mie_scattering.v[i] * dust);
    }
}

// clear: transmittance to the step, which the step dims.
static AirStep step_between(const AirModel *a, double r, double mu, double before, double after,
                            Spectrum *clear)
{
    AirStep s = {.t = 0.5 * (before + after)};
    s.radius = sqrt(r * r + s.t * s.t + 2.0 * r * mu * s.t);
    s.density = air_density(s.radius - GROUND_RADIUS);
    float step = (float)(after - before);
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        float depth = air_extinction(a, i, s.density) * step, left = air_decay(depth);
        float mean = depth > 1e-3f ? (1.0f - left) / depth : 1.0f - 0.5f * depth;
        s.seen.v[i] = clear->v[i] * mean * step;
        clear->v[i] *= left;
    }
    return s;
}

static void add_step(const AirModel *a, const AirGlow *glow, bool sunlit, const AirRay *ray,
                     const AirStep *s, AirMarch *m)
{
    double mu_sun = (ray->r * ray->mu_sun + s->t * ray->cosine) / s->radius;
    if (sunlit) {
        add_sunlit(a, m, ray, s->radius, mu_sun, &s->seen, s->density);
    }
    if (glow) {
        GlowPair light =
            air_glow_at(glow, s->radius, mu_sun, (ray->r * ray->mu + s->t) / s->radius, ray->turn);
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            m->glow.v[i] +=
                s->seen.v[i] * (a->rayleigh.v[i] * s->density.rayleigh * light.air.v[i] +
                                a->mie_scattering.v[i] * s->density.mie * light.dust.v[i]);
        }
    }
}

void air_march_on(const AirModel *a, const AirGlow *glow, bool sunlit, const AirRay *ray,
                  AirMarch *m, double before, double after)
{
    AirStep s = step_between(a, ray->r, ray->mu, before, after, &m->clear);
    add_step(a, glow, sunlit, ray, &s, m);
}

AirMarch air_march_begin(void)
{
    AirMarch m = {.sunlit = {{0.0f}}};
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        m.clear.v[i] = 1.0f;
    }
    return m;
}

void air_path_find(const AirModel *a, double r, double mu, double length, int steps, AirPath *path)
{
    path->count = steps;
    path->clear = air_march_begin().clear;
    double before = 0.0;
    for (int i = 0; i < steps; i++) {
        double part = (double)(i + 1) / steps, after = length * part * part * part;
        path->step[i] = step_between(a, r, mu, before, after, &path->clear);
        before = after;
    }
}

AirMarch air_march(const AirModel *a, const AirGlow *glow, bool sunlit, const AirRay *ray,
                   const AirPath *path)
{
    AirMarch m = {.clear = path->clear};
    for (int i = 0; i < path->count; i++) {
        add_step(a, glow, sunlit, ray, &path->step[i], &m);
    }
    return m;
}
