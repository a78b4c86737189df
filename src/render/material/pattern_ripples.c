#include "render/material/pattern_ripples.h"

#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

// ---- ripples

typedef struct Phasor {
    float re, im;
    float re_x, re_z, im_x, im_z; // gradient, in cells
} Phasor;

#define CELL 11.0f // wavelengths: the more, the fewer forks
#define SWAY 2.0f  // radians: how far crests wind

// The wave of a cell's kernel at (x, z) from its middle; the wave number is in radians a cell.
static void add_wave(Phasor *sum, float x, float z, float wave_x, float wave_z, float phase)
{
    const float reach = 2.0f; // cells
    float off = (x * x + z * z) / (reach * reach);
    if (off >= 1.0f) {
        return;
    }
    float weight = (1.0f - off) * (1.0f - off), fall = -4.0f * (1.0f - off) / (reach * reach);
    float angle = wave_x * x + wave_z * z + phase, c = cosf(angle), s = sinf(angle);
    sum->re += weight * c;
    sum->im += weight * s;
    sum->re_x += fall * x * c - weight * wave_x * s;
    sum->re_z += fall * z * c - weight * wave_z * s;
    sum->im_x += fall * x * s + weight * wave_x * c;
    sum->im_z += fall * z * s + weight * wave_z * c;
}

static Phasor phasor_at(float x, float z, float wave_x, float wave_z, uint32_t seed)
{
    Phasor sum = {0};
    int column = (int)floorf(x), row = (int)floorf(z);
    for (int i = 0; i < 25; i++) {
        int at_x = column + i % 5 - 2, at_z = row + i / 5 - 2;
        uint32_t hash = noise_square(at_x, at_z, seed);
        float turn = 0.16f * (noise_unit(hash, 3) - 0.5f);
        float longer = 1.0f + 0.07f * (noise_unit(hash, 4) - 0.5f);
        add_wave(&sum, x - (float)at_x - noise_unit(hash, 0), z - (float)at_z - noise_unit(hash, 1),
                 longer * (wave_x - turn * wave_z), longer * (wave_z + turn * wave_x),
                 2.0f * PI_F * noise_unit(hash, 2));
    }
    return sum;
}

// Over a phase, from -1 to 1: the sawtooth sum of r^n sin(n phase) / n, a gentle windward side and
// a steep lee, (1 + r) / (1 - r) = 2.8 times as steep. *rise: its derivative.
static float ripple_profile(float c, float s, float *rise)
{
    const float r = 0.48f, top = 0.5007f; // asin(r)
    *rise = r * (r - c) / ((1.0f + r * (r - 2.0f * c)) * top);
    return -atan2f(r * s, 1.0f - r * c) / top;
}

SandRelief pattern_ripples(Vec3 p, float along_x, float along_z, float wavelength, uint32_t seed)
{
    const float cell = CELL * wavelength;
    Vec3 broad = vec3(p.x / (3.0f * cell), 0.5f, p.z / (3.0f * cell));
    Vec3 near = vec3(p.x / cell, 0.5f, p.z / cell), bend;
    float uneven = 1.0f + 0.3f * noise_solid(broad, seed + 1, NULL);
    float wander = noise_solid(near, seed + 2, &bend);
    float wave = 2.0f * PI_F * cell / (wavelength * uneven);
    Phasor z = phasor_at(p.x / cell, p.z / cell, wave * along_x, wave * along_z, seed);
    // Ripples are low where crests meet: little is left of the sum there.
    float square = z.re * z.re + z.im * z.im, rest = square + 0.05f, share = square / rest;
    share *= 0.85f + 0.3f * wander;
    float turn_x = (z.re * z.im_x - z.im * z.re_x) / rest + SWAY * bend.x;
    float turn_z = (z.re * z.im_z - z.im * z.re_z) / rest + SWAY * bend.z;
    float angle = atan2f(z.im, z.re) + SWAY * wander, rise;
    float height = ripple_profile(cosf(angle), sinf(angle), &rise);
    rise *= (0.85f + 0.3f * wander) / cell;
    return (SandRelief){.height = share * height,
                        .slope = vec3(rise * turn_x, 0.0f, rise * turn_z)};
}

// ---- tongues

// A grain flow: an alcove with a scarp at its head, a narrow neck through which the sand ran, a
// lobed toe. u runs down it, 0 = the scarp, 1 = the front of the toe.
typedef struct Tongue {
    float length, width; // cells; width: half that of the toe
    float order;         // 0..1: later ones lie on earlier ones
    float bend, phase;   // cells, radians: it swerves
} Tongue;

#define ALCOVE 0.16f        // of the length
#define TOE 0.9f            // where its round front begins
#define TONGUE_WIDEST 0.07f // cells from its middle, with its bends

static Tongue tongue_of(uint32_t hash)
{
    float size = noise_unit(hash, 3), order = noise_unit(hash, 2);
    return (Tongue){.length = 0.45f + 1.0f * size,
                    .width = 0.014f + 0.02f * size + 0.022f * noise_unit(hash, 4),
                    .order = order + 0.001f,
                    .bend = 0.012f * noise_unit(hash, 5),
                    .phase = 2.0f * PI_F * noise_unit(hash, 6)};
}

// Half the width at u as a share of the toe's, and its derivative.
static float tongue_width(float u, float *slope)
{
    float alcove = fmaxf(1.0f - u / (1.8f * ALCOVE), 0.0f);
    float t = clampf((u - 0.3f) / 0.6f, 0.0f, 1.0f);
    *slope = -1.6f * alcove / (1.8f * ALCOVE) + 3.9f * t * (1.0f - t) / 0.6f;
    return 0.35f + 0.8f * alcove * alcove + 0.65f * t * t * (3.0f - 2.0f * t);
}

// Thickness along the middle: what has left the alcove lies in the toe.
static float tongue_depth(float u, float *slope)
{
    float a = u / ALCOVE - 0.6f, hollow = -1.1f / (1.0f + a * a);
    float t = clampf((u - 0.25f) / 0.6f, 0.0f, 1.0f);
    *slope = 2.2f * a / ((1.0f + a * a) * (1.0f + a * a) * ALCOVE) + 6.5f * t * (1.0f - t);
    return hollow + 0.65f * t * t * (3.0f - 2.0f * t);
}

// The relief of one tongue around its middle, in cells; false outside.
static bool tongue_at(const Tongue *t, float along, float across, SandRelief *relief)
{
    float u = along / t->length + 0.5f, by_u[2];
    if (u <= 0.0f || u >= 1.0f) {
        return false;
    }
    float angle = 7.0f * along + t->phase, c = cosf(angle);
    across += t->bend * sinf(angle);
    float wide = tongue_width(u, &by_u[0]) + 0.05f * sinf(40.0f * u + t->phase);
    by_u[0] += 2.0f * cosf(40.0f * u + t->phase); // uneven edges
    wide *= t->width;
    float v = across / wide;
    float toe = fmaxf((u - TOE) / (1.0f - TOE), 0.0f);
    float head = fmaxf((ALCOVE - u) / ALCOVE, 0.0f);
    float square = v * v + toe * toe + head * head;
    if (square >= 1.0f) {
        return false;
    }
    // A front as steep as sand can stand: the edge is a step in slope.
    float depth = tongue_depth(u, &by_u[1]), cube = square * square * square;
    float form = 1.0f - square * cube;
    float square_u =
        2.0f * (toe / (1.0f - TOE) - head / ALCOVE) - 2.0f * v * v * t->width * by_u[0] / wide;
    float by_along = (by_u[1] * form - 4.0f * depth * cube * square_u) / t->length;
    float by_across = -8.0f * depth * cube * v / wide;
    by_along += by_across * t->bend * 7.0f * c;
    float coarse = smoothstepf(0.35f, 0.95f, u);
    *relief = (SandRelief){.height = depth * form,
                           .slope = vec3(by_across, 0.0f, by_along),
                           .tone = coarse * (0.4f + 0.6f * square) - 0.35f * (1.0f - coarse)};
    return true;
}

SandRelief pattern_tongues(Vec3 p, float down_x, float down_z, float length, uint32_t seed)
{
    enum { EACH = 14 }; // a cell
    const float cell = 0.6f * length;
    float x = p.x / cell, z = p.z / cell, latest = 0.0f;
    int column = (int)floorf(x), row = (int)floorf(z);
    SandRelief found = {0}, one;
    for (int i = 0; i < 9 * EACH; i++) {
        int at_x = column + i / EACH % 3 - 1, at_z = row + i / EACH / 3 - 1;
        // They come in groups, with plain faces between.
        float share = 0.15f + 0.85f * noise_unit(noise_square(at_x, at_z, seed + 31u), 0);
        uint32_t hash = noise_square(at_x, at_z, seed + (uint32_t)(i % EACH) * 977u);
        float dx = x - (float)at_x - noise_unit(hash, 0);
        float dz = z - (float)at_z - noise_unit(hash, 1);
        float across = dz * down_x - dx * down_z;
        if (fabsf(across) > TONGUE_WIDEST || noise_unit(hash, 7) > share) {
            continue;
        }
        Tongue t = tongue_of(hash);
        if (t.order < latest || !tongue_at(&t, dx * down_x + dz * down_z, across, &one)) {
            continue;
        }
        latest = t.order;
        found = one;
    }
    Vec3 s = vec3_scale(found.slope, 1.0f / cell);
    found.slope = vec3(s.z * down_x - s.x * down_z, 0.0f, s.z * down_z + s.x * down_x);
    return found;
}
