#include "objects/terrain/noise.h"

#include "base/random.h"

#include <math.h>

enum { STREAM_COUNT = 1000 }; // of a cell, and those behind it; kernel i uses stream i

// exp(-SPARSE_NOISE_DENSITY)
static const float NO_KERNEL = 0.049787068f;

int sparse_noise_count(uint64_t cell_key)
{
    // Knuth: uniform numbers are multiplied until they fall below exp(-mean).
    enum { MOST = 24 };
    float product = random_unit(random_key(cell_key, STREAM_COUNT));
    int count = 0;
    while (count < MOST && product > NO_KERNEL) {
        count++;
        product *= random_unit(random_key(cell_key, STREAM_COUNT + (uint64_t)count));
    }
    return count;
}

// (1 - r^2)^3 (1 - 5 r^2) inside r < 1: falls to 0 smoothly, integral over the disc 0.
static float kernel(float r2)
{
    float s = 1.0f - r2;
    return s * s * s * (1.0f - 5.0f * r2);
}

static float cell_sum(int32_t column, int32_t row, float x, float y, uint64_t seed)
{
    uint64_t key = random_key(random_key(seed, (uint64_t)(uint32_t)column), (uint32_t)row);
    int count = sparse_noise_count(key);
    float sum = 0.0f;
    for (int i = 0; i < count; i++) {
        uint64_t bits = random_mix(random_key(key, (uint64_t)i)); // three numbers of 21 bits
        const float unit = 1.0f / 2097152.0f;
        float dx = x - (float)column - (float)(bits & 0x1fffff) * unit;
        float dy = y - (float)row - (float)(bits >> 21 & 0x1fffff) * unit;
        float r2 = dx * dx + dy * dy;
        if (r2 < 1.0f) {
            sum += (2.0f * (float)(bits >> 42 & 0x1fffff) * unit - 1.0f) * kernel(r2);
        }
    }
    return sum;
}

float sparse_noise(float x, float y, uint64_t seed)
{
    // Campbell's theorem: variance = density * mean square weight (1/3) * integral of kernel^2,
    // which is pi (1/7 - 10/56 + 25/252).
    const float scale = 1.0f / 0.4466164f; // the root of 3 / 3 * 0.1994662
    float floor_x = (float)(int32_t)x - (x < (float)(int32_t)x ? 1.0f : 0.0f);
    float floor_y = (float)(int32_t)y - (y < (float)(int32_t)y ? 1.0f : 0.0f);
    float sum = 0.0f;
    for (int row = -1; row <= 1; row++) {
        for (int column = -1; column <= 1; column++) {
            sum += cell_sum((int32_t)floor_x + column, (int32_t)floor_y + row, x, y, seed);
        }
    }
    return sum * scale;
}

float sparse_noise_fractal(float x, float y, int iterations, float gain, float ridged,
                           uint64_t seed)
{
    const float mean = 0.79f; // of the absolute value
    float sum = 0.0f, height = 1.0f;
    for (int i = 0; i < iterations; i++) {
        float n = sparse_noise(x, y, random_key(seed, (uint64_t)i));
        float crest = (mean - fabsf(n)) * 1.65f; // rescaled to variance 1
        sum += height * lerpf(n, crest, ridged);
        height *= gain;
        float turned = 1.6f * x - 1.2f * y; // twice the frequency, 37 degrees
        y = 1.2f * x + 1.6f * y + 17.3f;
        x = turned + 5.7f;
    }
    return sum;
}
