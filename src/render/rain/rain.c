#include "render/rain/rain.h"

#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>

static const float DEGREE = 0.017453292f;

// Rain begins inside the cloud: over this share of the fall it thickens.
static const float TOP = 0.08f;

Shower shower_default(void)
{
    return (Shower){.radius = 1500.0f,
                    .base = 1000.0f,
                    .bottom = -1000.0f,
                    .rate = 15.0f,
                    .lean = 12.0f,
                    .streaks = 0.7f};
}

// Specific attenuation of light in rain, 1.076 R^0.67 dB/km (Recommendation ITU-R P.1817), half of
// it by diffraction.
static float extinction_of(float rate)
{
    const float decibel = 0.2302585f;
    return 0.5f * 1.076e-3f * decibel * exact_pow(rate, 0.67f);
}

RainShaft rain_shaft(const Shower *shower, uint64_t seed)
{
    float s, c, lean_s, lean_c;
    exact_sincos(shower->wind * DEGREE, &s, &c);
    exact_sincos(shower->lean * DEGREE, &lean_s, &lean_c);
    float tangent = lean_s / lean_c;
    return (RainShaft){.shower = *shower,
                       .drift = vec3(s * tangent, 0.0f, c * tangent),
                       .extinction = extinction_of(shower->rate),
                       .key = random_key(seed, (uint64_t)shower->seed)};
}

// Shafts: wide veils with narrow ones in them, all along the way that drops fall.
static float streaks_at(const RainShaft *shaft, float x, float z)
{
    float width = 0.45f * shaft->shower.radius, s = shaft->shower.streaks;
    float n = noise_plane_fractal(x / width, z / width, 4, shaft->key);
    return clampf(1.0f + 2.4f * s * n, 1.0f - s, 1.0f + 1.5f * s);
}

// The share of the rain that falls at a place of the shaft's plane, `away` radii from its middle.
// Fraying moves the edge in and out by lobes with threads in them; none of it leaves the circle.
static float share_of_rain(const RainShaft *shaft, float x, float z, float away)
{
    float ragged = shaft->shower.ragged;
    if (ragged == 0.0f) {
        return 1.0f - smoothstepf(0.35f, 1.0f, away);
    }
    float width = 0.5f * shaft->shower.radius;
    float lobes = noise_plane_fractal(x / width, z / width, 6, random_key(shaft->key, 1));
    float frayed = away + ragged * (0.1f + 1.1f * lobes) * smoothstepf(0.0f, 0.5f, away);
    float share = 1.0f - smoothstepf(lerpf(0.35f, 0.0f, ragged), 1.0f, frayed);
    share *= lerpf(1.0f, share, ragged); // as seen through the whole shaft, it fades, too
    return share * (1.0f - smoothstepf(0.75f, 1.0f, away));
}

// The share of that rain that is left after `fallen` m of `depth`. Where little falls, small drops
// evaporate early: a frayed edge hangs as virga beside the rain that reaches the ground.
static float share_left(const RainShaft *shaft, float share, float fallen, float depth)
{
    float ragged = shaft->shower.ragged;
    if (ragged == 0.0f) {
        return 1.0f;
    }
    float reach = depth * lerpf(1.0f, 0.3f + 3.0f * share, ragged);
    return 1.0f - smoothstepf(0.4f * reach, reach, fallen);
}

float rain_extinction(const RainShaft *shaft, Vec3 p)
{
    const Shower *shower = &shaft->shower;
    float fallen = shower->base - p.y, depth = shower->base - shower->bottom;
    float top = TOP * depth;
    if (fallen < -top || fallen > depth) {
        return 0.0f;
    }
    float x = p.x - shower->center_x - fallen * shaft->drift.x;
    float z = p.z - shower->center_z - fallen * shaft->drift.z;
    float away = sqrtf(x * x + z * z) / shower->radius;
    if (away >= 1.0f) {
        return 0.0f;
    }
    float edge = share_of_rain(shaft, x, z, away);
    edge *= share_left(shaft, edge, fallen, depth);
    float height =
        smoothstepf(-top, 0.0f, fallen) * (1.0f - smoothstepf(0.6f, 1.0f, fallen / depth));
    if (shower->bottom <= -1000.0f) { // it reaches the ground
        height = smoothstepf(-top, 0.0f, fallen);
    }
    return shaft->extinction * edge * height * streaks_at(shaft, x, z);
}

// Narrows [*from, *to] to where a + t b lies within [low, high].
static void narrow(float a, float b, float low, float high, float *from, float *to)
{
    if (b == 0.0f) {
        *to = a < low || a > high ? *from : *to;
        return;
    }
    float t0 = (low - a) / b, t1 = (high - a) / b;
    *from = fmaxf(*from, fminf(t0, t1));
    *to = fminf(*to, fmaxf(t0, t1));
}

bool rain_segment(const RainShaft *shaft, Vec3 origin, Vec3 direction, float far, float *from,
                  float *to)
{
    const Shower *shower = &shaft->shower;
    float depth = shower->base - shower->bottom;
    *from = 0.0f;
    *to = far;
    narrow(origin.y, direction.y, shower->bottom, shower->base + TOP * depth, from, to);
    // The shaft stands upright in coordinates that drift with the drops.
    float fallen = shower->base - origin.y;
    float x = origin.x - shower->center_x - fallen * shaft->drift.x;
    float z = origin.z - shower->center_z - fallen * shaft->drift.z;
    float dx = direction.x + direction.y * shaft->drift.x;
    float dz = direction.z + direction.y * shaft->drift.z;
    float a = dx * dx + dz * dz, b = x * dx + z * dz;
    float c = x * x + z * z - shower->radius * shower->radius;
    float root = b * b - a * c;
    if (a <= 0.0f) {
        return c < 0.0f && *to > *from;
    }
    if (root <= 0.0f) {
        return false;
    }
    root = sqrtf(root);
    *from = fmaxf(*from, (-b - root) / a);
    *to = fminf(*to, (-b + root) / a);
    return *to > *from;
}
