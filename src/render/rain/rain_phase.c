#include "render/rain/rain_phase.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "render/sky/atmosphere.h"
#include "render/warp.h"

#include <math.h>
#include <stdlib.h>

enum {
    ORDERS = 4,  // reflected outside; refracted through; reflected inside once; twice
    RAYS = 3000, // through one drop
    SPREAD = 24, // bins on each side that a ray is spread over
    FIRST = 390, // nm
    LAST = 700,
    STEP = 10
};

// Degrees: drops of different sizes and not quite round, and diffraction (Lee 1998).
static const double BLUR = 0.35;

double rain_index(double nm)
{
    return 1.31279 + 15.762 / nm - 4382.0 / (nm * nm) + 1.1455e6 / (nm * nm * nm);
}

// Share of unpolarized power that the surface reflects, and of each polarization.
static void fresnel(double cos_i, double cos_r, double n, double reflected[2])
{
    double s = (cos_i - n * cos_r) / (cos_i + n * cos_r);
    double p = (n * cos_i - cos_r) / (n * cos_i + cos_r);
    reflected[0] = s * s;
    reflected[1] = p * p;
}

// Adds the power of a ray of this deflection to the bins, spread by a Gaussian.
static void add_power(double *bin, const double *spread, double deflection, double power)
{
    const double pi = 3.14159265358979323846;
    double angle = fmod(fabs(deflection), 2.0 * pi);
    angle = angle > pi ? 2.0 * pi - angle : angle;
    int middle = (int)(angle / pi * RAIN_PHASE_BINS);
    for (int k = -SPREAD; k <= SPREAD; k++) {
        int at = middle + k;
        at = at < 0 ? -1 - at : at;
        at = at >= RAIN_PHASE_BINS ? 2 * RAIN_PHASE_BINS - 1 - at : at;
        bin[at] += power * spread[k + SPREAD];
    }
}

// One wavelength: the power that goes to each bin of angle, together about 1.
static void trace_drop(double n, const double *spread, double *bin)
{
    const double pi = 3.14159265358979323846;
    for (int k = 0; k < RAYS; k++) {
        double b = (k + 0.5) / RAYS, sine = b / n; // impact parameter over the radius
        double cos_i = sqrt(1.0 - b * b), cos_r = sqrt(1.0 - sine * sine), share[2];
        double i = (double)exact_atan2((float)b, (float)cos_i);
        double r = (double)exact_atan2((float)sine, (float)cos_r);
        double area = 2.0 * b / RAYS;
        fresnel(cos_i, cos_r, n, share);
        add_power(bin, spread, pi - 2.0 * i, area * 0.5 * (share[0] + share[1]));
        for (int order = 1; order < ORDERS; order++) {
            double power = 0.0;
            for (int k2 = 0; k2 < 2; k2++) {
                double through = (1.0 - share[k2]) * (1.0 - share[k2]);
                power +=
                    0.5 * through * (order > 1 ? share[k2] : 1.0) * (order > 2 ? share[k2] : 1.0);
            }
            double deflection = 2.0 * (i - r) + (order - 1) * (pi - 2.0 * r);
            add_power(bin, spread, deflection, area * power);
        }
    }
}

static void fill_spread(double spread[2 * SPREAD + 1])
{
    double sum = 0.0, width = BLUR * RAIN_PHASE_BINS / 180.0;
    for (int k = -SPREAD; k <= SPREAD; k++) {
        sum += spread[k + SPREAD] = exact_exp(-0.5 * k * k / (width * width));
    }
    for (int k = 0; k <= 2 * SPREAD; k++) {
        spread[k] /= sum;
    }
}

// Densities of all bins of power, each channel 1 over the sphere.
static void to_density(RainPhase *phase, double (*power)[3])
{
    const double pi = 3.14159265358979323846;
    double sum[3] = {0.0};
    for (int i = 0; i < RAIN_PHASE_BINS; i++) {
        for (int c = 0; c < 3; c++) {
            power[i][c] = fmax(power[i][c], 0.0); // outside of the gamut
            sum[c] += power[i][c];
        }
    }
    for (int i = 0; i < RAIN_PHASE_BINS; i++) {
        double s0, c0, s1, c1;
        exact_sincos_double(pi * i / RAIN_PHASE_BINS, &s0, &c0);
        exact_sincos_double(pi * (i + 1) / RAIN_PHASE_BINS, &s1, &c1);
        double solid = 2.0 * pi * (c0 - c1);
        phase->density[i] =
            vec3((float)(power[i][0] / sum[0] / solid), (float)(power[i][1] / sum[1] / solid),
                 (float)(power[i][2] / sum[2] / solid));
    }
    phase->density[RAIN_PHASE_BINS] = phase->density[RAIN_PHASE_BINS - 1];
}

static void add_up(RainPhase *phase)
{
    const double pi = 3.14159265358979323846;
    double sum = 0.0;
    for (int i = 0; i < RAIN_PHASE_BINS; i++) {
        double s0, c0, s1, c1;
        exact_sincos_double(pi * i / RAIN_PHASE_BINS, &s0, &c0);
        exact_sincos_double(pi * (i + 1) / RAIN_PHASE_BINS, &s1, &c1);
        phase->drawn[i] = (float)sum;
        sum += (double)rain_phase_pdf(phase->density[i]) * 2.0 * pi * (c0 - c1);
    }
    phase->drawn[RAIN_PHASE_BINS] = 1.0f;
}

RainPhase *rain_phase_new(Error *e)
{
    RainPhase *phase = memory_alloc(1, sizeof *phase, e);
    double(*power)[3] = memory_alloc_zero(RAIN_PHASE_BINS, sizeof *power, e);
    double *bin = memory_alloc(RAIN_PHASE_BINS, sizeof *bin, e);
    if (!phase || !power || !bin) {
        free(bin);
        free(power);
        free(phase);
        return NULL;
    }
    double spread[2 * SPREAD + 1];
    fill_spread(spread);
    for (int nm = FIRST; nm <= LAST; nm += STEP) {
        double rgb[3];
        wavelength_to_rgb(nm, rgb);
        for (int i = 0; i < RAIN_PHASE_BINS; i++) {
            bin[i] = 0.0;
        }
        trace_drop(rain_index(nm), spread, bin);
        for (int i = 0; i < RAIN_PHASE_BINS; i++) {
            for (int c = 0; c < 3; c++) {
                power[i][c] += rgb[c] * bin[i];
            }
        }
    }
    to_density(phase, power);
    add_up(phase);
    free(bin);
    free(power);
    return phase;
}

Vec3 rain_phase(const RainPhase *phase, float cosine)
{
    float angle = exact_acos(clampf(cosine, -1.0f, 1.0f));
    int i = (int)(angle * (RAIN_PHASE_BINS / 3.14159265f));
    return phase->density[i < RAIN_PHASE_BINS ? i : RAIN_PHASE_BINS - 1];
}

Vec3 rain_phase_draw(const RainPhase *phase, Vec3 direction, float u, float v, float *pdf)
{
    int low = 0, high = RAIN_PHASE_BINS;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        low = phase->drawn[middle] <= u ? middle : low;
        high = phase->drawn[middle] <= u ? high : middle;
    }
    float width = phase->drawn[low + 1] - phase->drawn[low];
    float share = width > 0.0f ? (u - phase->drawn[low]) / width : 0.5f, s0, c0, s1, c1;
    const float bin = 3.14159265f / RAIN_PHASE_BINS;
    exact_sincos((float)low * bin, &s0, &c0);
    exact_sincos((float)(low + 1) * bin, &s1, &c1);
    float cosine = clampf(lerpf(c0, c1, share), -1.0f, 1.0f);
    *pdf = rain_phase_pdf(phase->density[low]);
    return warp_cone(direction, cosine, sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine)), v);
}
