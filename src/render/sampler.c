#include "render/sampler.h"

#include "base/random.h"

#include <string.h>

enum { STREAM_PIXELS = 0x50b01 }; // of the seed
enum { BLOCK_BITS = 4 };          // log2 of the width of a block of pixels
enum { HIGHEST_LEVEL = 20 };

// Four dimensions of one sample, or one dimension of many.
typedef uint32_t Lanes __attribute__((vector_size(16)));
typedef int32_t SignedLanes __attribute__((vector_size(16)));
typedef float FloatLanes __attribute__((vector_size(16)));
typedef uint32_t Wide __attribute__((vector_size(4 * SAMPLER_LANES)));
typedef int32_t SignedWide __attribute__((vector_size(4 * SAMPLER_LANES)));
typedef float FloatWide __attribute__((vector_size(4 * SAMPLER_LANES)));

static uint32_t reverse_bits(uint32_t x)
{
    x = __builtin_bswap32(x);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

// Direction numbers of the first four Sobol dimensions: primitive polynomial (degree, inner
// coefficients) and initial numbers, then Sobol's recurrence. direction[i] belongs to bit i.
static void direction_numbers(int dimension, uint32_t direction[32])
{
    static const struct {
        int degree;
        uint32_t inner, start[3];
    } primitive[4] = {{0, 0, {0}}, {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}};
    int degree = primitive[dimension].degree;
    for (int i = 0; i < 32; i++) {
        if (degree == 0) {
            direction[i] = 0x80000000u >> i;
        } else if (i < degree) {
            direction[i] = primitive[dimension].start[i] << (31 - i);
        } else {
            direction[i] = direction[i - degree] ^ (direction[i - degree] >> degree);
            for (int k = 1; k < degree; k++) {
                if (primitive[dimension].inner >> (degree - 1 - k) & 1u) {
                    direction[i] ^= direction[i - k];
                }
            }
        }
    }
}

// Indices arrive and points leave with their bits reversed, the order in which the hash scrambles
// them.
static void fill_table(SobolTable *table)
{
    memset(table, 0, sizeof *table);
    for (int dimension = 0; dimension < 4; dimension++) {
        uint32_t direction[32];
        direction_numbers(dimension, direction);
        for (int bit = 0; bit < 32; bit++) {
            table->bit[bit][dimension] = reverse_bits(direction[31 - bit]);
        }
        for (int nibble = 0; nibble < 8; nibble++) {
            for (int value = 0; value < 16; value++) {
                uint32_t word = 0;
                for (int bit = 0; bit < 4; bit++) {
                    if (value >> bit & 1) {
                        word ^= direction[31 - (4 * nibble + bit)];
                    }
                }
                table->word[nibble][value][dimension] = reverse_bits(word);
            }
        }
    }
}

// The following are macros because they work on single words and on vectors of them.

#define MIX(x)              \
    do {                    \
        (x) ^= (x) >> 16;   \
        (x) *= 0x21f0aaadu; \
        (x) ^= (x) >> 15;   \
        (x) *= 0xd35a2d97u; \
        (x) ^= (x) >> 15;   \
    } while (0)

#define REVERSE(x)                                                   \
    do {                                                             \
        (x) = ((x) >> 16) | ((x) << 16);                             \
        (x) = (((x) >> 8) & 0x00ff00ffu) | (((x)&0x00ff00ffu) << 8); \
        (x) = (((x) >> 4) & 0x0f0f0f0fu) | (((x)&0x0f0f0f0fu) << 4); \
        (x) = (((x) >> 2) & 0x33333333u) | (((x)&0x33333333u) << 2); \
        (x) = (((x) >> 1) & 0x55555555u) | (((x)&0x55555555u) << 1); \
    } while (0)

// Owen scrambling of a number whose bits are reversed: every operation lets a bit depend on lower
// bits only, so it is a nested permutation of elementary intervals. Laine and Karras 2011 with the
// constants of Vegdahl 2021.
#define OWEN(x, seed)               \
    do {                            \
        (x) ^= (x)*0x3d20adeau;     \
        (x) += (seed);              \
        (x) *= ((seed) >> 16) | 1u; \
        (x) ^= (x)*0x05526c56u;     \
        (x) ^= (x)*0x53a22864u;     \
    } while (0)

void sample_plan_fill(SamplePlan *plan, uint64_t seed, int samples)
{
    fill_table(&plan->table);
    plan->seed = random_key(seed, STREAM_PIXELS);
    plan->level = 0;
    while (plan->level < HIGHEST_LEVEL && (1 << plan->level) < samples) {
        plan->level++;
    }
}

// The place of a pixel on the Z-shaped curve through its block: bits of y and x in turn.
static uint32_t morton(uint32_t x, uint32_t y)
{
    uint32_t sum = 0;
    for (int bit = 0; bit < BLOCK_BITS; bit++) {
        sum |= (x >> bit & 1u) << (2 * bit) | (y >> bit & 1u) << (2 * bit + 1);
    }
    return sum;
}

void samplers_at(const SamplePlan *plan, uint32_t x, uint32_t y, uint32_t first, int count,
                 Sampler sampler[])
{
    uint64_t block = (uint64_t)(y >> BLOCK_BITS) << 32 | x >> BLOCK_BITS;
    uint64_t block_key = random_key(plan->seed, block);
    uint32_t stretch = morton(x, y) << plan->level, key = 0;
    for (int i = 0; i < count; i++) {
        uint32_t sample = first + (uint32_t)i, rest = sample & ((1u << plan->level) - 1u);
        if (i == 0 || rest == 0) {
            key = (uint32_t)random_key(block_key, sample >> plan->level);
        }
        uint32_t index = stretch | rest, reversed = reverse_bits(index);
        sampler[i] = (Sampler){.table = &plan->table,
                               .key = key,
                               .reversed = reversed,
                               .lowest = index ? __builtin_ctz(reversed) : 32};
    }
}

Sampler sampler_at(const SamplePlan *plan, uint32_t x, uint32_t y, uint32_t sample)
{
    Sampler sampler;
    samplers_at(plan, x, y, sample, 1, &sampler);
    return sampler;
}

// What tells the scrambling of the four dimensions apart.
static const uint32_t salt[4] = {0x6a09e667u, 0xbb67ae85u, 0x3c6ef372u, 0xa54ff53au};

// The seed of a dimension from the key of a set.
#define SALTED(seed)            \
    do {                        \
        (seed) *= 0x21f0aaadu;  \
        (seed) ^= (seed) >> 15; \
        (seed) *= 0xd35a2d97u;  \
        (seed) ^= (seed) >> 16; \
    } while (0)

void sampler_draw(const Sampler *sampler, uint32_t set, float u[4])
{
    uint32_t key = sampler->key + 0x9e3779b9u * (set + 1u);
    MIX(key);
    // The point of index 0 is subtracted: this shifts all points alike, which the random scrambling
    // hides, and leaves no bit set below the lowest, so few words need to be looked up.
    uint32_t index = sampler->reversed, zero = 0;
    OWEN(index, key);
    OWEN(zero, key);
    index ^= zero;
    Lanes x = {0, 0, 0, 0};
    for (int nibble = sampler->lowest / 4; nibble < 8; nibble++) {
        const uint32_t *word = sampler->table->word[nibble][index >> (4 * nibble) & 15u];
        x ^= *(const Lanes *)__builtin_assume_aligned(word, 16);
    }
    Lanes seed = {key, key, key, key};
    seed ^= (Lanes){salt[0], salt[1], salt[2], salt[3]};
    SALTED(seed);
    OWEN(x, seed);
    REVERSE(x);
    FloatLanes unit =
        __builtin_convertvector((SignedLanes)(x >> 8), FloatLanes) * (1.0f / 16777216.0f);
    memcpy(u, &unit, sizeof unit);
}

void sampler_lanes_clear(SamplerLanes *lanes)
{
    memset(lanes, 0, sizeof *lanes);
    lanes->lowest = 32;
}

void sampler_lanes_draw(const SobolTable *table, SamplerLanes *lanes)
{
    Wide key, index, set, x[4], zero = {0};
    memcpy(&key, lanes->key, sizeof key);
    memcpy(&index, lanes->reversed, sizeof index);
    memcpy(&set, lanes->set, sizeof set);
    key += 0x9e3779b9u * (set + 1u);
    MIX(key);
    x[0] = x[1] = x[2] = x[3] = zero;
    OWEN(index, key);
    OWEN(zero, key);
    index ^= zero;
    for (int bit = lanes->lowest; bit < 32; bit++) {
        Wide chosen = (Wide)((SignedWide)(index << (31 - bit)) < 0); // all bits or none
        for (int k = 0; k < 4; k++) {
            x[k] ^= chosen & table->bit[bit][k];
        }
    }
    for (int k = 0; k < 4; k++) {
        Wide seed = key ^ salt[k];
        SALTED(seed);
        OWEN(x[k], seed);
        REVERSE(x[k]);
        FloatWide unit =
            __builtin_convertvector((SignedWide)(x[k] >> 8), FloatWide) * (1.0f / 16777216.0f);
        memcpy(lanes->u[k], &unit, sizeof unit);
    }
}
