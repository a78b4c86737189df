#include "shape/leaf_outline.h"

#include "base/exact_math.h"

// (y/m)^(m k) ((1-y)/(1-m))^((1-m) k), which is 1 at its maximum y = m, to the power tip / 2.
float leaf_half_width(const LeafOutline *outline, float y)
{
    float t = y / outline->length, m = clampf(outline->widest, 0.05f, 0.95f);
    if (!(t > 0.0f && t < 1.0f)) {
        return 0.0f;
    }
    double logarithm = (double)m * exact_log((double)(t / m)) +
                       (double)(1.0f - m) * exact_log((double)((1.0f - t) / (1.0f - m)));
    return 0.5f * outline->width * (float)exact_exp((double)outline->tip * logarithm);
}

bool leaf_contains(const LeafOutline *outline, float scale, Vec3 p)
{
    return fabsf(p.x) < scale * leaf_half_width(outline, p.y / scale);
}
