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

void air_march_on(const AirModel *a, const AirGlow *glow, bool sunlit, const AirRay *ray,
                  AirMarch *m, double before, double after)
{
    double t = 0.5 * (before + after);
    double radius = sqrt(ray->r * ray->r + t * t + 2.0 * ray->r * ray->mu * t);
    Column d = air_density(radius - GROUND_RADIUS);
    float step = (float)(after - before);
    double mu_sun = (ray->r * ray->mu_sun + t * ray->cosine) / radius;
    Spectrum seen;
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        float depth = air_extinction(a, i, d) * step, left = air_decay(depth);
        float mean = depth > 1e-3f ? (1.0f - left) / depth : 1.0f - 0.5f * depth;
        seen.v[i] = m->clear.v[i] * mean * step;
        m->clear.v[i] *= left;
    }
    if (sunlit) {
        add_sunlit(a, m, ray, radius, mu_sun, &seen, d);
    }
    if (glow) {
        GlowPair light =
            air_glow_at(glow, radius, mu_sun, (ray->r * ray->mu + t) / radius, ray->turn);
        for (int i = 0; i < SPECTRUM_BANDS; i++) {
            m->glow.v[i] += seen.v[i] * (a->rayleigh.v[i] * d.rayleigh * light.air.v[i] +
                                         a->mie_scattering.v[i] * d.mie * light.dust.v[i]);
        }
    }
}

AirMarch air_march_begin(void)
{
    AirMarch m = {.sunlit = {{0.0f}}};
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        m.clear.v[i] = 1.0f;
    }
    return m;
}

AirMarch air_march(const AirModel *a, const AirGlow *glow, bool sunlit, const AirRay *ray,
                   double length, int steps)
{
    AirMarch m = air_march_begin();
    double before = 0.0;
    for (int i = 0; i < steps; i++) {
        double part = (double)(i + 1) / steps, after = length * part * part * part;
        air_march_on(a, glow, sunlit, ray, &m, before, after);
        before = after;
    }
    return m;
}
