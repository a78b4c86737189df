#include "shape/ellipsoid.h"

#include <math.h>

#define PI_D 3.14159265358979323846

bool ellipsoid_contains(const double half[3], const double p[3])
{
    double level = 0.0;
    for (int i = 0; i < 3; i++) {
        level += (p[i] / half[i]) * (p[i] / half[i]);
    }
    return level < 1.0;
}

bool ellipsoid_nearest(const double half[3], const double p[3], double c[3])
{
    int least = half[1] < half[0] ? 1 : 0;
    least = half[2] < half[least] ? 2 : least;
    double y[3], gap[3], s = 0.0;
    for (int i = 0; i < 3; i++) {
        // keep off the planes of symmetry, where the nearest point is not unique
        y[i] = fmax(fabs(p[i]), 1e-14 * half[i]);
        gap[i] = (half[i] - half[least]) * (half[i] + half[least]);
        s = fmax(s, half[i] * y[i] - gap[i]);
    }
    // Newton's method for the root s of sum (half y / (s + gap))^2 = 1. The sum is convex and
    // decreasing and starts at 1 or more, so the iteration increases to the root without
    // overshooting.
    for (int iteration = 0; iteration < 64; iteration++) {
        double sum = -1.0, slope = 0.0;
        for (int i = 0; i < 3; i++) {
            double t = half[i] * y[i] / (s + gap[i]);
            sum += t * t;
            slope += t * t / (s + gap[i]);
        }
        double step = 0.5 * sum / slope;
        s += step;
        if (!(step > 1e-15 * s)) {
            break;
        }
    }
    for (int i = 0; i < 3; i++) {
        double x = half[i] * half[i] * y[i] / (s + gap[i]);
        c[i] = p[i] < 0.0 ? -x : x;
    }
    return ellipsoid_contains(half, p);
}

// R_F and R_D by duplication (Carlson 1995); all arguments positive.
static void carlson(double x, double y, double z, double *rf, double *rd)
{
    double sum = 0.0, weight = 1.0, mean_d = 0.0;
    for (int i = 0; i < 60; i++) {
        double sx = sqrt(x), sy = sqrt(y), sz = sqrt(z), lambda = sx * sy + sy * sz + sz * sx;
        sum += weight / (sz * (z + lambda));
        weight *= 0.25;
        x = 0.25 * (x + lambda);
        y = 0.25 * (y + lambda);
        z = 0.25 * (z + lambda);
        mean_d = (x + y + 3.0 * z) / 5.0;
        double spread = fmax(fabs(x - y), fmax(fabs(y - z), fabs(z - x)));
        if (spread < 1e-9 * mean_d) {
            break;
        }
    }
    // for equal arguments R_F = x^(-1/2) and R_D = x^(-3/2); the remainder is of the order of
    // spread^2
    *rf = 1.0 / sqrt((x + y + z) / 3.0);
    *rd = 3.0 * sum + weight / (mean_d * sqrt(mean_d));
}

double ellipsoid_area(const double half[3])
{
    double a = half[0], b = half[1], c = half[2], swap;
    if (a < b) {
        swap = a, a = b, b = swap;
    }
    if (b < c) {
        swap = b, b = c, c = swap;
    }
    if (a < b) {
        swap = a, a = b, b = swap;
    }
    // the middle argument last, to avoid cancellation (DLMF 19.21.10)
    double x = 1.0 / (a * a), y = 1.0 / (c * c), z = 1.0 / (b * b), rf, rd;
    carlson(x, y, z, &rf, &rd);
    double rg = 0.5 * (z * rf - (x - z) * (y - z) * rd / 3.0 + sqrt(x * y / z));
    return 4.0 * PI_D * a * b * c * rg;
}
