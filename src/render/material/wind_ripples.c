#include "render/material/wind_ripples.h"

#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

enum { GUSTS = 5, SEED_WAVES = 1511, SEED_GUSTS = 1607 };

#define SHORTEST 0.017f // m: where surface tension takes over from gravity
#define FETCH 1000.0f   // m

// Of the variance of the longest ripples in a gust, what runs on into still water; of each octave
// below, less by this factor, since viscosity damps short ripples first.
#define STILL_SHARE 0.012f
#define STILL_FACTOR 0.35f

// ---- the spectrum

// The peak of Hasselmann et al. (1973) at this fetch: 22 (g^2 / (wind fetch))^(1/3) rad/s.
static float longest_of(const RippleWind *wind)
{
    const float g = 9.81f;
    float peak = 22.0f * cbrtf(g * g / (wind->speed * FETCH));
    float longest = wind->longest > 0.0f ? wind->longest : 2.0f * PI_F * g / (peak * peak);
    return fmaxf(longest, 2.0f * SHORTEST);
}

// Slopes of the equilibrium range, k^-4 of heights, have the same variance in every octave.
static int octaves_of(float longest)
{
    int octaves = (int)ceilf(log2f(longest / SHORTEST));
    return octaves < 1 ? 1 : octaves > RIPPLE_OCTAVES ? RIPPLE_OCTAVES : octaves;
}

float wind_ripples_variance(const RippleWind *wind)
{
    return 0.003f + 0.00512f * wind->speed;
}

float wind_ripples_mean_variance(const RippleWind *wind)
{
    int octaves = octaves_of(longest_of(wind));
    float still = 0.0f, share = STILL_SHARE;
    for (int i = 0; i < octaves; i++, share *= STILL_FACTOR) {
        still += share / (float)octaves;
    }
    return wind_ripples_variance(wind) * lerpf(1.0f, still, wind->calm);
}

// ---- gusts

// Of the noise, in units in which its first octave has the deviation 1.
typedef struct GustSum {
    float seen, hidden, all; // value; variance that the pixel hides; variance of all
} GustSum;

static GustSum gusts_at(const RippleWind *wind, Vec2 place, float width)
{
    const float deviation = 0.283f; // of noise_solid over a plane
    const float longer = 1.7f;      // along the wind
    GustSum sum = {0.0f, 0.0f, 0.0f};
    float size = wind->gusts > 0.0f ? wind->gusts : 90.0f, height = 1.0f;
    float along = (place.x * wind->way.x + place.y * wind->way.y) / longer;
    float across = place.y * wind->way.x - place.x * wind->way.y;
    size *= 1.6f; // a patch is about half a wave of the noise
    for (int i = 0; i < GUSTS; i++) {
        float seen = pattern_detail(size, width), variance = height * height;
        if (seen > 0.0f) {
            Vec3 p = vec3(along / size, 0.37f, across / size);
            sum.seen +=
                seen * height / deviation * noise_solid(p, (uint32_t)(SEED_GUSTS + i), NULL);
        }
        sum.hidden += (1.0f - seen * seen) * variance;
        sum.all += variance;
        size *= 0.43f;
        height *= 0.62f;
    }
    return sum;
}

// The share of the pixel that gusts ripple: where a normal variable exceeds a level, with the
// logistic function in place of the normal distribution's. What is hidden only softens the edge, so
// that the mean over the lake is the same from any distance.
static float cover_of(const RippleWind *wind, Vec2 place, float width)
{
    const float soft = 0.06f, logistic = 1.702f, least = 1e-3f; // soft: variance of an edge
    if (wind->calm <= least || wind->calm >= 1.0f - least) {
        return wind->calm <= least ? 1.0f : 0.0f;
    }
    GustSum sum = gusts_at(wind, place, width);
    float level = logf(wind->calm / (1.0f - wind->calm)) / logistic * sqrtf(sum.all + soft);
    return 1.0f / (1.0f + expf(logistic * (level - sum.seen) / sqrtf(sum.hidden + soft)));
}

// ---- ripples

// One of those of an octave. Directions lie as the squared cosine about the wind's, within 80
// degrees.
static Ripple ripple_of(const RippleWind *wind, float longest, int octave, int i)
{
    uint32_t hash = noise_square(octave, i, SEED_WAVES);
    float step = ((float)i + noise_unit(hash, 0)) / RIPPLE_EACH,
          u = 2.0f * noise_unit(hash, 1) - 1.0f;
    float angle = 1.4f * u * (0.55f + 0.45f * u * u), c = cosf(angle), s = sinf(angle);
    return (Ripple){{wind->way.x * c - wind->way.y * s, wind->way.y * c + wind->way.x * s},
                    2.0f * PI_F / longest * exp2f((float)octave + step),
                    2.0f * PI_F * noise_unit(hash, 2)};
}

// Metres of the pixel along this way.
static float extent_along(const RipplePixel *pixel, Vec2 way)
{
    float along = pixel->length * (way.x * pixel->view.x + way.y * pixel->view.y);
    float across = pixel->width * (way.y * pixel->view.x - way.x * pixel->view.y);
    return sqrtf(along * along + across * across);
}

// Crests are short: the phases of an octave wander over some wavelengths, each wave's its own way.
static void wander(Vec2 place, float wavelength, int octave, float shift[2])
{
    float size = 5.0f * wavelength;
    for (int k = 0; k < 2; k++) {
        Vec3 p = vec3(place.x / size, 0.61f, place.y / size);
        shift[k] = 7.0f * noise_solid(p, (uint32_t)(SEED_WAVES + 20 * k + octave), NULL);
    }
}

WindRipples wind_ripples_of(const RippleWind *wind)
{
    WindRipples ripples = {.wind = *wind, .longest = longest_of(wind)};
    ripples.octaves = octaves_of(ripples.longest);
    for (int i = 0; i < RIPPLE_EACH; i++) {
        ripples.wander[i][0] = cosf(2.4f * (float)i);
        ripples.wander[i][1] = sinf(2.4f * (float)i);
        for (int octave = 0; octave < ripples.octaves; octave++) {
            ripples.ripple[octave][i] = ripple_of(wind, ripples.longest, octave, i);
        }
    }
    return ripples;
}

// Adds one octave, whose slopes have this variance, summed over both axes.
static void add_octave(const WindRipples *ripples, int octave, float variance, Vec2 place,
                       const RipplePixel *pixel, RipplePoint *point)
{
    float wavelength = ripples->longest * exp2f(-(float)octave), shift[2];
    float each = variance / RIPPLE_EACH;
    if (pattern_detail(wavelength, pixel->width) <= 0.0f) {
        point->roughness2 += variance;
        return;
    }
    wander(place, wavelength, octave, shift);
    for (int i = 0; i < RIPPLE_EACH; i++) {
        const Ripple *r = &ripples->ripple[octave][i];
        float seen = pattern_detail(2.0f * PI_F / r->number, extent_along(pixel, r->way));
        point->roughness2 += (1.0f - seen * seen) * each;
        if (seen > 0.0f) {
            float phase = r->number * (place.x * r->way.x + place.y * r->way.y) + r->phase;
            phase += shift[0] * ripples->wander[i][0] + shift[1] * ripples->wander[i][1];
            float slope = seen * sqrtf(2.0f * each) * cosf(phase);
            point->slope.x += slope * r->way.x;
            point->slope.y += slope * r->way.y;
        }
    }
}

RipplePoint wind_ripples_at(const WindRipples *ripples, Vec2 place, const RipplePixel *pixel)
{
    RipplePoint point = {.cover = cover_of(&ripples->wind, place, pixel->width)};
    float still = STILL_SHARE;
    float variance = wind_ripples_variance(&ripples->wind) / (float)ripples->octaves;
    for (int i = 0; i < ripples->octaves; i++, still *= STILL_FACTOR) {
        add_octave(ripples, i, variance * lerpf(still, 1.0f, point.cover), place, pixel, &point);
    }
    return point;
}
