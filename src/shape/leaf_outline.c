#include "shape/leaf_outline.h"

#include "base/exact_math.h"
#include "base/random.h"

#define FIRST 0.08f // shares of the length between which teeth stand
#define LAST 0.99f
#define CROWDED 0.2f // teeth at the base are longer than the mean by this share, at the tip shorter
#define POINT 0.76f  // place of a saw tooth's point, from the notch on the base's side
#define MOST_DEPTH 0.3f // of the half width

enum { STREAM_NOTCH = 1, STREAM_DEPTH, STREAM_SIDE, STREAM_SWELL }; // of a side's key

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

bool leaf_has_margin(const LeafOutline *outline)
{
    return outline->teeth > 0 || outline->uneven > 0.0f;
}

// ---- the margin ----

static uint64_t side_key(const LeafOutline *outline, float side)
{
    return random_key(outline->key, side > 0.0f ? 1 : 0);
}

// Smooth noise of one variable, -1..1, wavelength 1.
static float swell(uint64_t key, float x)
{
    float whole = floorf(x), t = x - whole;
    uint64_t at = (uint64_t)(int64_t)whole;
    float a = random_range(random_key(key, at), -1.0f, 1.0f);
    float b = random_range(random_key(key, at + 1), -1.0f, 1.0f);
    return lerpf(a, b, smoothstepf(0.0f, 1.0f, t));
}

// The side's half width before teeth.
static float side_width(const LeafOutline *outline, float side, float y)
{
    float half = leaf_half_width(outline, y);
    if (outline->uneven == 0.0f) {
        return half;
    }
    uint64_t key = side_key(outline, side);
    float own = random_range(random_key(key, STREAM_SIDE), -0.03f, 0.03f);
    uint64_t waves = random_key(key, STREAM_SWELL);
    float t = y / outline->length;
    float wave = 0.022f * swell(waves, 5.0f * t) + 0.010f * swell(random_key(waves, 0), 17.0f * t);
    return half * (1.0f + outline->uneven * (own + wave));
}

// How many teeth lie below share t of the length; 0 at FIRST, all of them at LAST.
static float teeth_below(const LeafOutline *outline, float t)
{
    float s = (t - FIRST) / (LAST - FIRST);
    return (float)outline->teeth * s * (1.0f - CROWDED + CROWDED * s);
}

// The share of the length below which so many teeth lie.
static float height_of(const LeafOutline *outline, float below)
{
    float q = below / (float)outline->teeth, a = 1.0f - CROWDED;
    float s = 2.0f * q / (a + sqrtf(a * a + 4.0f * CROWDED * q));
    return FIRST + s * (LAST - FIRST);
}

// Place of the notch below tooth `number`, in teeth.
static float notch(const LeafOutline *outline, uint64_t key, int number)
{
    float shift =
        random_range(random_key(random_key(key, STREAM_NOTCH), (uint64_t)number), -0.28f, 0.28f);
    return (float)number + outline->uneven * shift;
}

// One tooth: 0 in the notches x = 0 and 1, 1 at its point.
static float saw(float x)
{
    if (x < POINT) { // the back is convex, the front straight
        float q = x / POINT;
        return q * (1.35f - 0.35f * q);
    }
    return (1.0f - x) / (1.0f - POINT);
}

static float scallop(float x)
{
    float q = 2.0f * x - 1.0f;
    return 1.0f - q * q * fabsf(q);
}

static float tooth_height(const LeafOutline *outline, float x)
{
    x = clampf(x, 0.0f, 1.0f);
    float pointed = saw(x), third = 3.0f * x;
    if (outline->double_teeth) {
        pointed = 0.68f * pointed + 0.32f * saw(third - floorf(third < 3.0f ? third : 2.0f));
    }
    return lerpf(pointed, scallop(x), outline->tooth_round);
}

// m at height y. Teeth fade toward the base and the tip.
static float depth_at(const LeafOutline *outline, float half, float y)
{
    float t = y / outline->length, share = (LAST - FIRST) / (float)outline->teeth;
    float depth =
        outline->tooth_depth > 0.0f ? outline->tooth_depth : 0.4f * outline->length * share;
    depth *= smoothstepf(FIRST, FIRST + 0.12f, t) * (1.0f - smoothstepf(LAST - 0.03f, LAST, t));
    return fminf(depth, MOST_DEPTH * half);
}

float leaf_margin(const LeafOutline *outline, float side, float y)
{
    float half = side_width(outline, side, y), t = y / outline->length;
    if (outline->teeth <= 0 || !(half > 0.0f) || t <= FIRST || t >= LAST) {
        return half;
    }
    uint64_t key = side_key(outline, side);
    float below = teeth_below(outline, t);
    int number = (int)below;
    number += below < notch(outline, key, number) ? -1 : 0;
    number += below >= notch(outline, key, number + 1) ? 1 : 0;
    float low = notch(outline, key, number), high = notch(outline, key, number + 1);
    float less = random_unit(random_key(random_key(key, STREAM_DEPTH), (uint64_t)number));
    float height = (1.0f - 0.5f * outline->uneven * less) *
                   tooth_height(outline, (below - low) / (high - low));
    return half + depth_at(outline, half, y) * (height - 0.5f);
}

Vec3 leaf_tooth(const LeafOutline *outline, float side, int number)
{
    uint64_t key = side_key(outline, side);
    float low = notch(outline, key, number), high = notch(outline, key, number + 1);
    float at = lerpf(low, high, lerpf(POINT, 0.5f, outline->tooth_round));
    float y = outline->length * height_of(outline, at);
    return vec3(side * leaf_margin(outline, side, y), y, 0);
}

bool leaf_contains(const LeafOutline *outline, float scale, Vec3 p)
{
    float y = p.y / scale;
    float edge = leaf_has_margin(outline) ? leaf_margin(outline, p.x < 0.0f ? -1.0f : 1.0f, y)
                                          : leaf_half_width(outline, y);
    return fabsf(p.x) < scale * edge;
}
