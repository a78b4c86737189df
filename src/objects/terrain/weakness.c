// Where rock is weak: along joints and shear zones, which noise of many scales stands for.
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

enum { AT_ONCE = 256 }; // samples of a row

static void set_part(Landscape *land, const WeaknessNoise *noise, uint64_t key, int row, int first)
{
    float x[AT_ONCE], z[AT_ONCE], n[AT_ONCE];
    int count = land->side - first < AT_ONCE ? land->side - first : AT_ONCE;
    for (int k = 0; k < count; k++) {
        x[k] = noise->scale * (float)((land->corner + (first + k) * land->cell) / noise->unit);
        z[k] = noise->scale * (float)((land->corner + row * land->cell) / noise->unit);
    }
    sparse_noise_fractal_along(x, z, count, noise->octaves, noise->gain, 0.0f, key, n);
    float *weakness = land->weakness + (int64_t)row * land->side + first;
    for (int k = 0; k < count; k++) {
        weakness[k] = clampf(1.0f + noise->strength * n[k], noise->least, 2.5f);
    }
}

void terrain_set_weakness(Landscape *land, const WeaknessNoise *noise, uint64_t key, const Run *run)
{
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int first = 0; first < land->side; first += AT_ONCE) {
            set_part(land, noise, key, row, first);
        }
    }
}
