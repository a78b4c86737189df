#include "render/medium/droplets.h"

#include "render/medium/medium.h"
#include "render/warp.h"

DropletPhase droplet_phase(float d) // their eqs. (4) to (7)
{
    return (DropletPhase){.forward = expf(-0.0990567f / (d - 1.67154f)),
                          .side = expf(-2.20679f / (d + 3.91029f) - 0.428934f),
                          .alpha = expf(3.62489f - 8.29288f / (d + 5.52825f)),
                          .share = expf(-0.599085f / (d - 0.641583f) - 0.665888f)};
}

DropletPhase droplet_phase_widened(const DropletPhase *p, float left)
{
    return (DropletPhase){left * p->forward, left * p->side, left * p->alpha, p->share};
}

// Draine's lobe is that of Henyey and Greenstein times (1 + alpha cosine^2); the integral of the
// product, from the second moment (1 + 2 g^2) / 3.
static float norm(const DropletPhase *p)
{
    return 1.0f + p->alpha * (1.0f + 2.0f * p->side * p->side) / 3.0f;
}

float droplet_phase_mean_cosine(const DropletPhase *p)
{
    float g = p->side;
    float side = g * (1.0f + p->alpha * (3.0f + 2.0f * g * g) / 5.0f) / norm(p);
    return p->forward + p->share * (side - p->forward);
}

// Henyey and Greenstein's, without the cancellation in narrow peaks that 1 + g^2 - 2 g cosine has.
static float lobe(float g, float cosine)
{
    float d = (1.0f - g) * (1.0f - g) + 2.0f * g * (1.0f - cosine);
    return (1.0f - g) * (1.0f + g) / (4.0f * PI_F * d * sqrtf(d));
}

float droplet_phase_density(const DropletPhase *p, float cosine)
{
    float side = lobe(p->side, cosine) * (1.0f + p->alpha * cosine * cosine) / norm(p);
    float forward = lobe(p->forward, cosine);
    return forward + p->share * (side - forward);
}

// ---- drawing from Draine's lobe

// An antiderivative over the cosine of (1 + alpha cosine^2) / (1 + g^2 - 2 g cosine)^(3/2), where r
// is the root of that denominator's base b - 2 g cosine, b = 1 + g^2.
static double antiderivative(double g, double alpha, double r)
{
    double b = 1.0 + g * g, c = alpha / (4.0 * g * g);
    return ((1.0 + c * b * b) / r + 2.0 * c * b * r - c * r * r * r / 3.0) / g;
}

// Newton's method within bisection: the share of light below a cosine rises from 0 to 1.
static float draine_cosine(double g, double alpha, double u)
{
    double first = antiderivative(g, alpha, 1.0 + g);
    double all = antiderivative(g, alpha, 1.0 - g) - first;
    double low = -1.0, high = 1.0, x = 2.0 * u - 1.0;
    for (int i = 0; i < 40 && high - low > 1e-7; i++) {
        double r = sqrt(1.0 + g * g - 2.0 * g * x);
        double miss = antiderivative(g, alpha, r) - first - u * all;
        if (fabs(miss) < 1e-8 * all) {
            break;
        }
        low = miss < 0.0 ? x : low;
        high = miss < 0.0 ? high : x;
        x -= miss * r * r * r / (1.0 + alpha * x * x);
        x = x > low && x < high ? x : 0.5 * (low + high);
    }
    return (float)x;
}

Vec3 droplet_phase_draw(const DropletPhase *p, Vec3 direction, float u, float v)
{
    if (u >= p->share) {
        return phase_draw(p->forward, direction, (u - p->share) / (1.0f - p->share), v);
    }
    if (p->side < 1e-4f) { // even but for rounding, if alpha is as small
        return phase_draw(p->side, direction, u / p->share, v);
    }
    float cosine = draine_cosine((double)p->side, (double)p->alpha, (double)(u / p->share));
    return warp_cone(direction, cosine, sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine)), v);
}
