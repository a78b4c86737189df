#include "objects/terrain/lift.h"

#include "base/memory.h"
#include "objects/terrain/lowest_lists.h"

#include <stdlib.h>
#include <string.h>

// ---- the curve

static float secant(const LiftCurve *c, int i)
{
    float run = c->distance[i + 1] - c->distance[i];
    return run > 0.0f ? (c->height[i + 1] - c->height[i]) / run : 0.0f;
}

// The slope at an inner stop: the weighted harmonic mean of the secants beside it, 0 at an extremum
// (Fritsch and Butland 1984), so that the curve does not overshoot.
static float inner_slope(const LiftCurve *c, int i)
{
    float a = secant(c, i - 1), b = secant(c, i);
    if (a * b <= 0.0f) {
        return 0.0f;
    }
    float before = c->distance[i] - c->distance[i - 1];
    float after = c->distance[i + 1] - c->distance[i];
    float w1 = 2.0f * after + before, w2 = after + 2.0f * before;
    return (w1 + w2) / (w1 / a + w2 / b);
}

LiftCurve lift_curve(const LiftStop *stop, int count)
{
    LiftCurve c = {.count = count};
    for (int i = 0; i < count; i++) {
        c.distance[i] = stop[i].distance;
        c.height[i] = stop[i].height;
    }
    for (int i = 1; i < count - 1; i++) {
        c.slope[i] = inner_slope(&c, i);
    }
    if (count > 1) { // not curved at the ends
        float a = 1.5f * secant(&c, 0) - 0.5f * c.slope[1];
        float b = 1.5f * secant(&c, count - 2) - 0.5f * c.slope[count - 2];
        c.slope[0] = count > 2 ? a : secant(&c, 0);
        c.slope[count - 1] = count > 2 ? b : secant(&c, 0);
    }
    return c;
}

float lift_curve_at(const LiftCurve *c, float distance)
{
    int last = c->count - 1;
    if (distance > c->distance[last]) {
        return 0.0f;
    }
    int i = 0;
    while (i < last && distance > c->distance[i + 1]) {
        i++;
    }
    if (distance <= c->distance[0] || i == last) {
        return c->height[distance <= c->distance[0] ? 0 : last];
    }
    float run = c->distance[i + 1] - c->distance[i], t = (distance - c->distance[i]) / run;
    float s = 1.0f - t;
    float h = s * s * ((1.0f + 2.0f * t) * c->height[i] + t * run * c->slope[i]) +
              t * t * ((3.0f - 2.0f * t) * c->height[i + 1] - s * run * c->slope[i + 1]);
    float low = c->height[i] < c->height[i + 1] ? c->height[i] : c->height[i + 1];
    float high = c->height[i] < c->height[i + 1] ? c->height[i + 1] : c->height[i];
    return clampf(h, low, high);
}

void lift_curve_range(const LiftCurve *c, float from, float to, float *low, float *high)
{
    float a = lift_curve_at(c, from), b = lift_curve_at(c, to);
    *low = a < b ? a : b;
    *high = a < b ? b : a;
    for (int i = 0; i < c->count; i++) { // monotone between stops
        if (c->distance[i] > from && c->distance[i] < to) {
            *low = c->height[i] < *low ? c->height[i] : *low;
            *high = c->height[i] > *high ? c->height[i] : *high;
        }
    }
}

// ---- bands

// The point of the ridge, m from its start, where d / share is least: with a the place's projection
// and y its distance from the line, the derivative of ((t - a)^2 + y^2) / (share0 + m t)^2 is zero
// at t = a + m y^2 / (share0 + m a).
static float band_foot(const RidgeBand *b, float along, float y2)
{
    if (!(b->length > 0.0f)) {
        return 0.0f;
    }
    float m = (b->share1 - b->share0) / b->length;
    float share = b->share0 + m * along;
    if (share <= 0.0f) {
        return b->share1 > b->share0 ? b->length : 0.0f;
    }
    return clampf(along + m * y2 / share, 0.0f, b->length);
}

float ridge_band_lift(const RidgeBand *b, const LiftCurve *curve, float half, float x, float z)
{
    float px = x - b->x, pz = z - b->z;
    float along = px * b->dx + pz * b->dz, across = px * b->dz - pz * b->dx;
    float y2 = across * across;
    float foot = band_foot(b, along, y2);
    float t = b->length > 0.0f ? foot / b->length : 0.0f;
    float share = lerpf(b->share0, b->share1, t), ahead = along - foot;
    float reach = share * half;
    return reach > 0.0f ? share * lift_curve_at(curve, sqrtf(ahead * ahead + y2) / reach) : 0.0f;
}

struct RidgeLift {
    RidgeBand *band;
    LiftCurve curve;
    float half;
    LowestLists *lists;
};

// Lifts are negated: the highest is the lowest.
static void band_bounds(const void *functions, int32_t i, float x, float z, float r, float *low,
                        float *high)
{
    const RidgeLift *lift = functions;
    const RidgeBand *b = &lift->band[i];
    float px = x - b->x, pz = z - b->z;
    float ahead = px * b->dx + pz * b->dz, across = px * b->dz - pz * b->dx;
    ahead -= clampf(ahead, 0.0f, b->length);
    float d = sqrtf(ahead * ahead + across * across);
    float least = b->share0 < b->share1 ? b->share0 : b->share1;
    float most = b->share0 < b->share1 ? b->share1 : b->share0;
    float nearest = 0.9999f * (d - r) / (most * lift->half);
    nearest = nearest > 0.0f ? nearest : 0.0f;
    float farthest = least > 0.0f ? 1.0001f * (d + r) / (least * lift->half) : 3e38f;
    *low = 1.0f; // never the lowest: the plane is at 0
    *high = 3e38f;
    if (nearest <= lift->curve.distance[lift->curve.count - 1]) {
        lift_curve_range(&lift->curve, nearest, farthest, high, low);
        *low *= -most;
        *high *= -least;
    }
}

RidgeLift *ridge_lift_new(const RidgeBand *band, int64_t count, const LiftCurve *curve, float half,
                          float size, float margin, const Run *run, Error *e)
{
    RidgeLift *lift = memory_alloc_zero(1, sizeof *lift, e);
    if (!lift) {
        return NULL;
    }
    lift->curve = *curve;
    lift->half = half;
    lift->band = memory_alloc(count, sizeof *band, e);
    if (lift->band) {
        if (count > 0) {
            memcpy(lift->band, band, sizeof *band * (size_t)count);
        }
        lift->lists = lowest_lists_new(band_bounds, lift, count, 0.0f, size, margin, run, e);
    }
    if (!lift->lists) {
        ridge_lift_free(lift);
        return NULL;
    }
    return lift;
}

void ridge_lift_free(RidgeLift *lift)
{
    if (lift) {
        lowest_lists_free(lift->lists);
        free(lift->band);
        free(lift);
    }
}

float ridge_lift_at(const RidgeLift *lift, float x, float z)
{
    int32_t count;
    const int32_t *list = lowest_lists_at(lift->lists, x, z, &count);
    float best = 0.0f;
    for (int32_t i = 0; i < count; i++) {
        float h = ridge_band_lift(&lift->band[list[i]], &lift->curve, lift->half, x, z);
        best = h > best ? h : best;
    }
    return best;
}
