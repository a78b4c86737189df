#include "render/material/pattern_ripples.h"

#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

// ---- ripples

typedef struct Phasor {
    float re, im;
    float re_x, re_z, im_x, im_z; // gradient, in cells
} Phasor;

// The wave of a cell's kernel at (x, z) from its middle; the wave number is in radians a cell.
static void add_wave(Phasor *sum, float x, float z, float wave_x, float wave_z, float phase)
{
    const float reach = 1.5f; // cells
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
        add_wave(&sum, x - (float)at_x - noise_unit(hash, 0), z - (float)at_z - noise_unit(hash, 1),
                 wave_x, wave_z, 2.0f * PI_F * noise_unit(hash, 2));
    }
    return sum;
}

SandRelief pattern_ripples(Vec3 p, float along_x, float along_z, float wavelength, uint32_t seed)
{
    const float cell = 8.0f * wavelength; // the more, the fewer forks
    float uneven = 1.0f + 0.16f * noise_solid(vec3(p.x / (3.0f * cell), 0.5f, p.z / (3.0f * cell)),
                                              seed + 1, NULL);
    float wave = 2.0f * PI_F * cell / (wavelength * uneven);
    Phasor z = phasor_at(p.x / cell, p.z / cell, wave * along_x, wave * along_z, seed);
    // Ripples are low where crests meet: little is left of the sum there.
    float square = z.re * z.re + z.im * z.im, rest = square + 0.07f, share = square / rest;
    float size = sqrtf(square) + 1e-6f, c = z.re / size, s = z.im / size;
    float turn_x = (z.re * z.im_x - z.im * z.re_x) / (rest * cell);
    float turn_z = (z.re * z.im_z - z.im * z.re_z) / (rest * cell);
    float rise = c - 0.56f * (c * c - s * s); // a gentle windward side and a steep lee
    return (SandRelief){.height = share * (s - 0.56f * s * c),
                        .slope = vec3(rise * turn_x, 0.0f, rise * turn_z)};
}

// ---- tongues

// Around the middle of a tongue: `across` it and `along` it, in cells. Its head is a point, its
// toe round.
typedef struct Tongue {
    float length, width; // cells
} Tongue;

// 1 - height of a tongue, in units of its own: above 1 outside; and its derivatives.
static float tongue_square(const Tongue *t, float along, float across, float *by_along,
                           float *by_across)
{
    float u = along / t->length + 0.5f; // 0 = head, 1 = toe
    float wide = t->width * (0.3f + 0.7f * fminf(fmaxf(u, 0.0f) * 2.0f, 1.0f));
    float toe = fmaxf((u - 0.92f) / 0.08f, 0.0f), head = fmaxf((0.25f - u) / 0.25f, 0.0f);
    float v = across / wide;
    *by_along = (2.0f * toe / 0.08f - 2.0f * head / 0.25f) / t->length;
    *by_across = 2.0f * v / wide;
    return v * v + toe * toe + head * head;
}

SandRelief pattern_tongues(Vec3 p, float down_x, float down_z, float length, uint32_t seed)
{
    enum { EACH = 5 }; // a cell
    const float cell = 0.6f * length;
    float x = p.x / cell, z = p.z / cell, latest = 0.0f;
    int column = (int)floorf(x), row = (int)floorf(z);
    SandRelief found = {0};
    for (int i = 0; i < 9 * EACH; i++) {
        int at_x = column + i / EACH % 3 - 1, at_z = row + i / EACH / 3 - 1;
        uint32_t hash = noise_square(at_x, at_z, seed + (uint32_t)(i % EACH) * 977u);
        float dx = x - (float)at_x - noise_unit(hash, 0),
              dz = z - (float)at_z - noise_unit(hash, 1);
        float order = noise_unit(hash, 2) + 0.001f, by_along, by_across;
        Tongue t = {.length = 0.7f + 1.1f * noise_unit(hash, 3),
                    .width = 0.025f + 0.11f * order * noise_unit(hash, 4)};
        float along = dx * down_x + dz * down_z, across = dz * down_x - dx * down_z;
        across += 0.02f * sinf(9.0f * along + 6.0f * order); // they swerve a little
        if (order < latest || fabsf(across) > t.width || fabsf(along) > 0.6f * t.length) {
            continue;
        }
        float square = tongue_square(&t, along, across, &by_along, &by_across);
        if (square >= 1.0f) {
            continue;
        }
        latest = order;
        float fall = -2.0f * (1.0f - square) / cell;
        found.height = (1.0f - square) * (1.0f - square);
        found.slope = vec3(fall * (by_along * down_x - by_across * down_z), 0.0f,
                           fall * (by_along * down_z + by_across * down_x));
        found.tone = 2.0f * noise_unit(hash, 5) - 1.0f;
    }
    return found;
}
