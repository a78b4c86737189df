#include "render/rain/rain_phase.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "render/rain/airy.h"
#include "render/sky/atmosphere.h"
#include "render/warp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ORDERS = 4,  // reflected outside; refracted through; reflected inside once; twice
    RAYS = 3000, // through one drop
    TURNED = 2 * RAIN_PHASE_BINS, // bins of deflection, 0 .. 2 pi
    SPREAD = 60,                  // bins on each side that a ray is spread over
    SIZES = 40,                   // of drops
    FIRST = 390,                  // nm
    LAST = 700,
    STEP = 10
};

// Degrees: of the orders that make no bow.
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

// One wavelength: the power that each order sends to each bin of deflection, together about 1.
static void trace_drop(double n, double (*bin)[TURNED])
{
    const double pi = 3.14159265358979323846;
    for (int k = 0; k < RAYS; k++) {
        double b = (k + 0.5) / RAYS, sine = b / n; // impact parameter over the radius
        double cos_i = sqrt(1.0 - b * b), cos_r = sqrt(1.0 - sine * sine), share[2];
        double i = (double)exact_atan2((float)b, (float)cos_i);
        double r = (double)exact_atan2((float)sine, (float)cos_r);
        double area = 2.0 * b / RAYS;
        fresnel(cos_i, cos_r, n, share);
        bin[0][(int)((pi - 2.0 * i) / pi * RAIN_PHASE_BINS)] += area * 0.5 * (share[0] + share[1]);
        for (int order = 1; order < ORDERS; order++) {
            double power = 0.0;
            for (int k2 = 0; k2 < 2; k2++) {
                double through = (1.0 - share[k2]) * (1.0 - share[k2]);
                power +=
                    0.5 * through * (order > 1 ? share[k2] : 1.0) * (order > 2 ? share[k2] : 1.0);
            }
            double deflection = 2.0 * (i - r) + (order - 1) * (pi - 2.0 * r);
            int at = (int)(deflection / pi * RAIN_PHASE_BINS);
            bin[order][at < TURNED ? at : TURNED - 1] += area * power;
        }
    }
}

static void normalise(double spread[2 * SPREAD + 1])
{
    double sum = 0.0;
    for (int k = 0; k <= 2 * SPREAD; k++) {
        sum += spread[k];
    }
    for (int k = 0; k <= 2 * SPREAD; k++) {
        spread[k] /= sum;
    }
}

static void fill_blur(double spread[2 * SPREAD + 1])
{
    double width = BLUR * RAIN_PHASE_BINS / 180.0;
    for (int k = -SPREAD; k <= SPREAD; k++) {
        spread[k + SPREAD] = exact_exp(-0.5 * k * k / (width * width));
    }
    normalise(spread);
}

// How the waves of a bow of `inside` reflections spread the power of its rays (Airy 1838): rays
// pile up as 1/sqrt(t) at the least deflection, waves as Ai(-z)^2, which is 1/sqrt(t) folded with
// 2^(2/3) Ai(2^(2/3) (t - z)) / (2 pi) (Reid 1995). z is the angle in units of h^(1/3) x^(-2/3),
// for drops of x wavelengths of girth (van de Hulst 1957, 13.2). The mean of the drops of moderate
// rain (Marshall and Palmer 1948) by their cross-section; larger ones are too flat to add to the
// bow.
static void fill_fringes(const double *beyond, double nm, double n, int inside,
                         double spread[2 * SPREAD + 1])
{
    const double pi = 3.14159265358979323846, per_mm = 2.3, least = 0.3, most = 1.6;
    double p2 = (inside + 1.0) * (inside + 1.0), short_of = n * n - 1.0;
    double h = (p2 - 1.0) * (p2 - 1.0) / p2 * sqrt((p2 - n * n) / (short_of * short_of * short_of));
    for (int k = 0; k <= 2 * SPREAD; k++) {
        spread[k] = 0.0;
    }
    for (int s = 0; s < SIZES; s++) {
        double across = least + (most - least) * (s + 0.5) / SIZES; // mm
        double weight = across * across * exact_exp(-per_mm * across);
        double x = pi * across * 1e6 / nm;
        double bins =
            (double)exact_pow((float)(h / (4.0 * x * x)), 1.0f / 3.0f) / pi * RAIN_PHASE_BINS;
        for (int k = -SPREAD; k <= SPREAD; k++) {
            spread[k + SPREAD] += weight * (airy_beyond(beyond, -(k + 0.5) / bins) -
                                            airy_beyond(beyond, -(k - 0.5) / bins));
        }
    }
    normalise(spread);
}

// Adds an order's power to the bins of angle, spread.
static void add_order(const double *turned, const double *spread, double *bin)
{
    for (int i = 0; i < TURNED; i++) {
        for (int k = -SPREAD; turned[i] > 0.0 && k <= SPREAD; k++) {
            int at = i + k;
            at = at < 0 ? -1 - at : at;
            at = at >= TURNED ? 2 * TURNED - 1 - at : at;
            at = at >= RAIN_PHASE_BINS ? TURNED - 1 - at : at;
            bin[at] += turned[i] * spread[k + SPREAD];
        }
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

typedef struct Bows {
    double power[RAIN_PHASE_BINS][3], bin[RAIN_PHASE_BINS];
    double turned[ORDERS][TURNED]; // of one wavelength
    double beyond[AIRY_STEPS];
} Bows;

static void add_wavelength(Bows *bows, double nm)
{
    double spread[2 * SPREAD + 1], rgb[3], n = rain_index(nm);
    wavelength_to_rgb(nm, rgb);
    memset(bows->bin, 0, sizeof bows->bin);
    memset(bows->turned, 0, sizeof bows->turned);
    trace_drop(n, bows->turned);
    fill_blur(spread);
    for (int order = 0; order < ORDERS; order++) {
        if (order > 1) {
            fill_fringes(bows->beyond, nm, n, order - 1, spread);
        }
        add_order(bows->turned[order], spread, bows->bin);
    }
    for (int i = 0; i < RAIN_PHASE_BINS; i++) {
        for (int c = 0; c < 3; c++) {
            bows->power[i][c] += rgb[c] * bows->bin[i];
        }
    }
}

RainPhase *rain_phase_new(Error *e)
{
    RainPhase *phase = memory_alloc(1, sizeof *phase, e);
    Bows *bows = memory_alloc_zero(1, sizeof *bows, e);
    if (!phase || !bows) {
        free(bows);
        free(phase);
        return NULL;
    }
    airy_fill(bows->beyond);
    for (int nm = FIRST; nm <= LAST; nm += STEP) {
        add_wavelength(bows, nm);
    }
    to_density(phase, bows->power);
    add_up(phase);
    free(bows);
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
