#include "render/sky/air_model.h"

// Bucholtz 1995: 0.0116 per km at 550 nm.
float air_rayleigh_extinction(float um)
{
    return 0.0116f * powf(0.55f / um, 4.08f);
}

// Angstrom's law with exponent 1.3 and the turbidity coefficient of Preetham et al. 1999; scale
// height 1.2 km.
float air_mie_extinction(float turbidity, float um)
{
    float beta = fmaxf(0.04608f * turbidity - 0.04586f, 0.0f);
    return beta * powf(um, -1.3f) / 1.2f;
}

// Aerosols absorb 5 %. Ozone: Chappuis band, 300 Dobson units in a tent of half-width 15 km.
static void fill_coefficients(AirModel *a, float turbidity)
{
    static const float ozone_cross_section[SPECTRUM_BANDS] = {0.01f, 0.12f, 0.70f, 1.85f, 3.90f,
                                                              5.00f, 2.90f, 1.35f}; // 1e-25 m^2
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        float um = 0.4f + 0.04f * (float)i;
        a->rayleigh.v[i] = air_rayleigh_extinction(um);
        a->mie.v[i] = air_mie_extinction(turbidity, um);
        a->mie_scattering.v[i] = 0.95f * a->mie.v[i];
        a->ozone.v[i] = ozone_cross_section[i] * 1e-25f * 8.07e22f / 15.0f;
    }
}

Column air_density(double altitude)
{
    float h = altitude > 0.0 ? (float)altitude : 0.0f;
    float tent = 1.0f - fabsf(h - 25.0f) / 15.0f;
    return (Column){air_decay(h / 8.0f), air_decay(h / 1.2f), tent > 0.0f ? tent : 0.0f};
}

double air_distance_to_top(double r, double mu)
{
    double d = r * r * (mu * mu - 1.0) + TOP_RADIUS * TOP_RADIUS;
    return fmax(0.0, -r * mu + sqrt(fmax(0.0, d)));
}

bool air_meets_ground(double r, double mu, double *distance)
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

static Column integrate_column(double r, double mu)
{
    enum { STEPS = 64 };
    double length = air_distance_to_top(r, mu), before = 0.0;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < STEPS; i++) {
        double s = (double)(i + 1) / STEPS, after = length * s * s;
        double t = 0.5 * (before + after);
        double radius = sqrt(r * r + t * t + 2.0 * r * mu * t);
        Column d = air_density(radius - GROUND_RADIUS);
        sum[0] += (double)d.rayleigh * (after - before);
        sum[1] += (double)d.mie * (after - before);
        sum[2] += (double)d.ozone * (after - before);
        before = after;
    }
    return (Column){(float)sum[0], (float)sum[1], (float)sum[2]};
}

static void fill_columns(AirModel *a)
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

bool air_column_to_space(const AirModel *a, double r, double mu, Column *column)
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

void air_model_init(AirModel *model, float turbidity, float ground_albedo)
{
    model->ground_albedo = ground_albedo;
    fill_coefficients(model, turbidity);
    fill_columns(model);
}
