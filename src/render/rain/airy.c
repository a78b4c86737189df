#include "render/rain/airy.h"

static const double TOP = 6.0, EACH = 0.005;

// Runge and Kutta's steps of Ai'' = y Ai, downward, where Ai outgrows the other solution.
void airy_fill(double *beyond)
{
    const double h = -EACH;
    double y = TOP, ai = 9.947694360252892e-6, slope = -2.4765200397034985e-5; // Ai(6), Ai'(6)
    double integral = 3.88174e-6;                                              // of Ai above 6
    for (int i = 0; i < AIRY_STEPS; i++) {
        beyond[i] = integral;
        double a1 = slope, s1 = y * ai;
        double a2 = slope + 0.5 * h * s1, s2 = (y + 0.5 * h) * (ai + 0.5 * h * a1);
        double a3 = slope + 0.5 * h * s2, s3 = (y + 0.5 * h) * (ai + 0.5 * h * a2);
        double a4 = slope + h * s3, s4 = (y + h) * (ai + h * a3);
        double next = ai + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        integral += 0.5 * EACH * (ai + next);
        slope += h / 6.0 * (s1 + 2.0 * s2 + 2.0 * s3 + s4);
        ai = next;
        y += h;
    }
}

double airy_beyond(const double *beyond, double y)
{
    double at = (TOP - y) / EACH;
    if (at < 0.0) {
        return 0.0;
    }
    int i = (int)at;
    if (i >= AIRY_STEPS - 1) {
        return 1.0;
    }
    return beyond[i] + (at - i) * (beyond[i + 1] - beyond[i]);
}
