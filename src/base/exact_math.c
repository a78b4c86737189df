#include "base/exact_math.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define PI_D 3.14159265358979323846
#define LN2_D 0.69314718055994530942

// fmod is exact, so the same everywhere; what has more turns than this has lost its angle anyway.
#define MOST_ANGLE 1e6
#define MOST_EXPONENT 709.782712893384 // e to it is the largest double
#define LEAST_EXPONENT (-700.0)

void exact_sincos(float angle, float *sine, float *cosine)
{
    if (!isfinite(angle)) {
        *sine = *cosine = NAN;
        return;
    }
    if (fabsf(angle) > (float)MOST_ANGLE) {
        angle = (float)fmod((double)angle, 2.0 * PI_D);
    }
    // Reduce to |r| <= pi/4 about the nearest quarter turn, then Taylor.
    double quarters = (double)angle * (2.0 / PI_D);
    int64_t n = (int64_t)(quarters + (quarters < 0.0 ? -0.5 : 0.5));
    double r = (double)angle - (double)n * (PI_D / 2.0), r2 = r * r;
    double s = r * (1 - r2 / 6 * (1 - r2 / 20 * (1 - r2 / 42 * (1 - r2 / 72 * (1 - r2 / 110)))));
    double c = 1 - r2 / 2 * (1 - r2 / 12 * (1 - r2 / 30 * (1 - r2 / 56 * (1 - r2 / 90))));
    switch (n & 3) {
    case 0:
        *sine = (float)s, *cosine = (float)c;
        break;
    case 1:
        *sine = (float)c, *cosine = (float)-s;
        break;
    case 2:
        *sine = (float)-s, *cosine = (float)-c;
        break;
    default:
        *sine = (float)-c, *cosine = (float)s;
        break;
    }
}

void exact_sincos_double(double angle, double *sine, double *cosine)
{
    // pi / 2 in two parts, so that the reduction by a few quarters loses nothing
    const double high = 1.5707963267948966, low = 6.123233995736766e-17;
    double quarters = angle * (2.0 / PI_D);
    int64_t n = (int64_t)(quarters + (quarters < 0.0 ? -0.5 : 0.5));
    double r = (angle - (double)n * high) - (double)n * low, r2 = r * r;
    double s = 1.0, c = 1.0;
    for (int k = 18; k >= 2; k -= 2) { // Horner over the Taylor terms
        s = 1.0 - s * r2 / (double)(k * (k + 1));
        c = 1.0 - c * r2 / (double)(k * (k - 1));
    }
    s *= r;
    *sine = (n & 1) ? c : s;
    *cosine = (n & 1) ? s : c;
    if (n & 2) {
        *sine = -*sine;
    }
    if ((n + 1) & 2) {
        *cosine = -*cosine;
    }
}

double exact_log(double x)
{
    if (!(x > 0.0) || isinf(x)) {
        return x == 0.0 ? -INFINITY : x > 0.0 ? x : NAN;
    }
    int64_t exponent = -1022;
    if (x < DBL_MIN) { // subnormal: its exponent bits are zero
        x *= 0x1p54;
        exponent -= 54;
    }
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    exponent += (int64_t)(bits >> 52);
    bits = (bits & 0x000fffffffffffffull) | 0x3fe0000000000000ull; // mantissa in [0.5, 1)
    double m;
    memcpy(&m, &bits, sizeof m);
    if (m < 0.70710678118654752) {
        m *= 2.0;
        exponent--;
    }
    // ln m = 2 atanh((m - 1) / (m + 1))
    double z = (m - 1.0) / (m + 1.0), z2 = z * z, sum = 0.0;
    for (int k = 21; k >= 1; k -= 2) {
        sum = sum * z2 + 1.0 / k;
    }
    return 2.0 * z * sum + (double)exponent * LN2_D;
}

double exact_exp(double x)
{
    if (!(x >= LEAST_EXPONENT && x <= MOST_EXPONENT)) {
        return x < 0.0 ? 0.0 : x > 0.0 ? INFINITY : x;
    }
    double k = (double)(int64_t)(x / LN2_D + (x < 0.0 ? -0.5 : 0.5));
    double r = x - k * LN2_D, sum = 1.0;
    for (int i = 13; i >= 1; i--) {
        sum = 1.0 + sum * r / i;
    }
    bool top = k > 1023.0; // 2^1024 is not a double, although the result is
    uint64_t bits = (uint64_t)((int64_t)k + (top ? 1022 : 1023)) << 52;
    double scale;
    memcpy(&scale, &bits, sizeof scale);
    return sum * scale * (top ? 2.0 : 1.0);
}

float exact_pow(float x, float y)
{
    if (y == 0.0f) {
        return 1.0f;
    }
    if (x > 0.0f) {
        return x == 1.0f ? 1.0f : (float)exact_exp((double)y * exact_log((double)x));
    }
    return isnan(x) || isnan(y) ? NAN : y < 0.0f ? INFINITY : 0.0f;
}

// Arc tangent of t in [0, 1]: halves the angle twice, then sums the series.
static double arctangent(double t)
{
    t = t / (1.0 + sqrt(1.0 + t * t));
    t = t / (1.0 + sqrt(1.0 + t * t));
    double t2 = t * t, sum = 0.0;
    for (int k = 19; k >= 1; k -= 2) {
        sum = 1.0 / k - sum * t2;
    }
    return 4.0 * t * sum;
}

float exact_atan2(float y, float x)
{
    double ax = x < 0.0f ? -(double)x : (double)x, ay = y < 0.0f ? -(double)y : (double)y;
    if (ax == 0.0 && ay == 0.0) {
        return 0.0f;
    }
    double angle = ay <= ax ? arctangent(ay / ax) : PI_D / 2.0 - arctangent(ax / ay);
    if (x < 0.0f) {
        angle = PI_D - angle;
    }
    return (float)(y < 0.0f ? -angle : angle);
}

float exact_acos(float x)
{
    double c = x < -1.0f ? -1.0 : (x > 1.0f ? 1.0 : (double)x);
    return exact_atan2((float)sqrt((1.0 - c) * (1.0 + c)), (float)c);
}
