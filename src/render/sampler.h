// Owen-scrambled Sobol points: a sample is a pure function of (pixel, sample index, set of
// dimensions, seed). Every decision of a path draws its own set of four numbers. The four numbers
// of a set are a scrambled 4-D Sobol sequence; sets are independent of each other (padding).
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
#ifndef RAMIFY_RENDER_SAMPLER_H
#define RAMIFY_RENDER_SAMPLER_H

#include <stdint.h>

// The generator matrices, folded so that four bits of the index are looked up at a time.
typedef struct SobolTable {
    uint32_t word[8][16][4] __attribute__((aligned(16)));
} SobolTable;

void sobol_table_fill(SobolTable *table);

typedef struct Sampler {
    const SobolTable *table;
    uint32_t key;      // of the pixel and the seed
    uint32_t reversed; // sample index, lowest bit first
    int lowest;        // first group of four bits of it that is not zero
} Sampler;

Sampler sampler_at(const SobolTable *table, uint64_t seed, uint32_t pixel, uint32_t sample);

// Four numbers in [0, 1). The first two are a (0, 2)-sequence over the sample index.
void sampler_draw(const Sampler *sampler, uint32_t set, float u[4]);

#endif
