#include "render/filter.h"

// The 4-term Blackman-Harris window (Harris 1978); a Gaussian of which the radius is 2.5 sigma,
// lowered to end at zero.
float filter_profile(FilterKind kind, float x)
{
    switch (kind) {
    case FILTER_BLACKMAN_HARRIS:
        return 0.35875f + 0.48829f * cosf(PI_F * x) + 0.14128f * cosf(2.0f * PI_F * x) +
               0.01168f * cosf(3.0f * PI_F * x);
    case FILTER_GAUSSIAN:
        return expf(-3.125f * x * x) - expf(-3.125f);
    case FILTER_BOX:
        break;
    }
    return 1.0f;
}

// Inverts the cumulated profile by walking along a fine table of it.
void filter_fill(Filter *filter, FilterKind kind, float radius)
{
    enum { FINE = 8192 };
    double total = 0.0;
    for (int i = 0; i < FINE; i++) {
        total += (double)filter_profile(kind, (2.0f * (float)i + 1.0f) / (float)FINE - 1.0f);
    }
    double sum = 0.0, step = 0.0;
    int next = 0;
    for (int i = 0; i < FINE; i++) {
        step = (double)filter_profile(kind, (2.0f * (float)i + 1.0f) / (float)FINE - 1.0f) / total;
        while (next < FILTER_STEPS && (double)next / FILTER_STEPS <= sum + step) {
            double inside = step > 0.0 ? ((double)next / FILTER_STEPS - sum) / step : 0.0;
            double x = 2.0 * ((double)i + inside) / FINE - 1.0;
            filter->offset[next++] = radius * (float)x;
        }
        sum += step;
    }
    while (next <= FILTER_STEPS) {
        filter->offset[next++] = radius;
    }
}
