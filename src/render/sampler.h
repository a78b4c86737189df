// Owen-scrambled Sobol points: a sample is a pure function of (pixel, sample index, set of
// dimensions, seed). Every decision of a path draws its own set of four numbers. The four numbers
// of a set are a scrambled 4-D Sobol sequence; sets are independent of each other (padding).
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
//
// The pixels of a block share one sequence, which runs through them in Morton order: each pixel has
// a stretch of it, and the stretches of neighbours complete each other at every scale. So the error
// that is left differs between neighbours (blue noise), which eye and filters average out. Ahmed
// and Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical
// Ordering of Pixels", SIGGRAPH Asia 2020.
#ifndef RAMIFY_RENDER_SAMPLER_H
#define RAMIFY_RENDER_SAMPLER_H

#include <stdint.h>

// The generator matrices: the words of each bit of the index in four dimensions, and folded so that
// four bits are looked up at a time.
typedef struct SobolTable {
    uint32_t word[8][16][4] __attribute__((aligned(16)));
    uint32_t bit[32][4];
} SobolTable;

typedef struct Sampler {
    const SobolTable *table;
    uint32_t key;      // of the block of pixels and the seed
    uint32_t reversed; // index in the block's sequence, lowest bit first
    int lowest;        // first bit of it that is not zero; 32 = none
} Sampler;

// What the samples of a picture have in common.
typedef struct SamplePlan {
    SobolTable table;
    uint64_t seed;
    int level; // log2 of the length of a pixel's stretch; further samples begin a new sequence
} SamplePlan;

// samples: per pixel, at least 1. Fewer or more may be drawn; the noise is blue after all of them.
void sample_plan_fill(SamplePlan *plan, uint64_t seed, int samples);

Sampler sampler_at(const SamplePlan *plan, uint32_t x, uint32_t y, uint32_t sample);

// Fills those of samples `first` and after: what they share is hashed once.
void samplers_at(const SamplePlan *plan, uint32_t x, uint32_t y, uint32_t first, int count,
                 Sampler sampler[]);

// Four numbers in [0, 1). The first two are a (0, 2)-sequence over the samples of a pixel, and over
// those of squares of 2, 4, 8 and 16 pixels.
void sampler_draw(const Sampler *sampler, uint32_t set, float u[4]);

// The same for SAMPLER_LANES samplers of one plan at once: u[k][i] is number k of sampler i.
enum { SAMPLER_LANES = 16 };
typedef struct SamplerLanes {
    uint32_t key[SAMPLER_LANES], reversed[SAMPLER_LANES], set[SAMPLER_LANES];
    int lowest; // least of all
    float u[4][SAMPLER_LANES];
} SamplerLanes;

void sampler_lanes_clear(SamplerLanes *lanes);

static inline void sampler_lanes_put(SamplerLanes *lanes, int i, const Sampler *sampler,
                                     uint32_t set)
{
    lanes->key[i] = sampler->key;
    lanes->reversed[i] = sampler->reversed;
    lanes->set[i] = set;
    lanes->lowest = sampler->lowest < lanes->lowest ? sampler->lowest : lanes->lowest;
}

void sampler_lanes_draw(const SobolTable *table, SamplerLanes *lanes);

static inline void sampler_lanes_get(const SamplerLanes *lanes, int i, float u[4])
{
    for (int k = 0; k < 4; k++) {
        u[k] = lanes->u[k][i];
    }
}

#endif
