#include "objects/sea/spectrum.h"

#include "base/exact_math.h"

#include <math.h>
#include <stdbool.h>

static const double TURN = 6.28318530717958647692;

#define RIPPLE_FROM (TURN / 3.0) // 1/m: where the spectrum's tail becomes too flat
#define RIPPLE_FULL (TURN / 0.1)

static double power(double x, double y)
{
    return x > 0.0 ? exact_exp(y * exact_log(x)) : 0.0;
}

static double hyperbolic_tangent(double x)
{
    if (x > 20.0) {
        return 1.0;
    }
    double e = exact_exp(-2.0 * x);
    return (1.0 - e) / (1.0 + e);
}

// ---- dispersion

double wave_frequency(double k, double depth)
{
    return sqrt(GRAVITY * k * (depth > 0.0 ? hyperbolic_tangent(k * depth) : 1.0));
}

double wave_number(double omega, double depth)
{
    double deep = omega * omega / GRAVITY;
    if (!(depth > 0.0)) {
        return deep;
    }
    double k = deep * depth < 1.0 ? omega / sqrt(GRAVITY * depth) : deep;
    for (int i = 0; i < 20; i++) { // Newton's method, from below the root's curvature
        double t = hyperbolic_tangent(k * depth);
        double f = GRAVITY * k * t - omega * omega;
        k -= f / (GRAVITY * (t + k * depth * (1.0 - t * t)));
    }
    return k;
}

double wave_group_speed(double k, double depth)
{
    double omega = wave_frequency(k, depth);
    if (!(depth > 0.0)) {
        return 0.5 * omega / k;
    }
    double t = hyperbolic_tangent(k * depth);
    return 0.5 * GRAVITY * (t + k * depth * (1.0 - t * t)) / omega;
}

// ---- the spectrum

WaveSpectrum wave_spectrum(double wind, double fetch, double depth)
{
    // Hasselmann et al.: peak and variance by the dimensionless fetch. A fully developed sea has
    // its peak at 0.13 g / wind and no overshoot (Pierson and Moskowitz 1964).
    const double most_fetch = (3.5 / 0.13) * (3.5 / 0.13) * (3.5 / 0.13), young = 3000.0;
    double x = GRAVITY * fetch / (wind * wind);
    x = x > most_fetch ? most_fetch : x;
    double youth = x > young ? exact_log(most_fetch / x) / exact_log(most_fetch / young) : 1.0;
    WaveSpectrum s = {.level = 1.0,
                      .peak = TURN * 3.5 * GRAVITY / wind * power(x, -1.0 / 3.0),
                      .peakedness = 1.0 + 2.3 * youth};
    double wind2 = wind * wind / GRAVITY;
    s.level = 1.6e-7 * x * wind2 * wind2 / wave_spectrum_variance(&s);
    s.depth = depth;
    return s;
}

// Kitaigorodskii's factor, as Thompson and Vincent (1983) approximate it.
static double depth_factor(double omega, double depth)
{
    double scaled = omega * sqrt(depth / GRAVITY);
    return scaled <= 1.0   ? 0.5 * scaled * scaled
           : scaled <= 2.0 ? 1.0 - 0.5 * (2.0 - scaled) * (2.0 - scaled)
                           : 1.0;
}

double wave_spectrum_at(const WaveSpectrum *s, double omega)
{
    double ratio = s->peak / omega;
    if (ratio > 4.0) {
        return 0.0; // exp(-320)
    }
    double width = ratio > 1.0 ? 0.07 : 0.09;
    double off = (omega - s->peak) / (width * s->peak);
    double ratio4 = ratio * ratio * ratio * ratio;
    // Far from the peak the overshoot is 1 to the last bit, which most waves need not wait for.
    double closeness = -0.5 * off * off;
    double enhanced = closeness < -40.0 ? 1.0 : power(s->peakedness, exact_exp(closeness));
    double omega2 = omega * omega;
    double deep = s->level * GRAVITY * GRAVITY / (omega2 * omega2 * omega) *
                  exact_exp(-1.25 * ratio4) * enhanced;
    return s->depth > 0.0 ? deep * depth_factor(omega, s->depth) : deep;
}

// Narrowness of the spread over directions.
static double spread_beta(const WaveSpectrum *s, double omega)
{
    double ratio = omega / s->peak;
    return ratio < 0.95  ? 2.61 * power(ratio < 0.56 ? 0.56 : ratio, 1.3)
           : ratio < 1.6 ? 2.28 * power(ratio, -1.3)
                         : power(10.0, -0.4 + 0.8393 * power(ratio, -1.134));
}

// Share 0..1 of the ripples at a wave number.
static double ripple_share(double k)
{
    if (k <= RIPPLE_FROM) {
        return 0.0;
    }
    double share = exact_log(k / RIPPLE_FROM) / exact_log(RIPPLE_FULL / RIPPLE_FROM);
    return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}

void wave_spectrum_steepen(WaveSpectrum *s, double wind, double shortest, double share)
{
    double last = TURN / shortest, peak = wave_number(s->peak, s->depth);
    double lacking = cox_munk_slopes(wind) - wave_spectrum_slopes(s, 0.25 * peak, last);
    double folds = 0.5 * exact_log(RIPPLE_FULL / RIPPLE_FROM) + exact_log(last / RIPPLE_FULL);
    s->ripples = lacking > 0.0 ? share * lacking / folds : 0.0;
}

WaveRing wave_spectrum_ring(const WaveSpectrum *s, double k)
{
    double omega = wave_frequency(k, s->depth), beta = spread_beta(s, omega);
    double waves = wave_spectrum_at(s, omega) * wave_group_speed(k, s->depth) / k;
    double ripples = s->ripples * ripple_share(k) / (k * k * k * k);
    return (WaveRing){waves + ripples, beta, hyperbolic_tangent(0.5 * beta * TURN)};
}

double wave_ring_density(const WaveRing *ring, double angle)
{
    double e = exact_exp(-ring->beta * fabs(angle));
    double sech = 2.0 * e / (1.0 + e * e);
    return ring->all * (0.5 * ring->beta * sech * sech / ring->within);
}

// Trapezoidal sum over the logarithm of the wave number of k^power times the spectrum.
static double integral(const WaveSpectrum *s, double low, double high, bool slopes)
{
    enum { STEPS = 2000 };
    double span = exact_log(high / low), sum = 0.0;
    for (int i = 0; i <= STEPS; i++) {
        double k = low * exact_exp(span * i / STEPS);
        double f = wave_spectrum_at(s, wave_frequency(k, s->depth)) * wave_group_speed(k, s->depth);
        f = f * k + s->ripples * ripple_share(k) / (k * k);
        sum += (i == 0 || i == STEPS ? 0.5 : 1.0) * f * (slopes ? k * k : 1.0);
    }
    return sum * span / STEPS;
}

double wave_spectrum_variance(const WaveSpectrum *s)
{
    double peak = wave_number(s->peak, s->depth);
    return integral(s, 0.02 * peak, 2000.0 * peak, false);
}

double wave_spectrum_slopes(const WaveSpectrum *s, double low, double high)
{
    return high > low ? integral(s, low, high, true) : 0.0;
}

// ---- what is known of seas

double cox_munk_slopes(double wind)
{
    return 0.003 + 0.00512 * wind;
}

double monahan_whitecaps(double wind)
{
    return 3.84e-6 * power(wind, 3.41);
}
