// Where rock is weak: along joints and shear zones, which noise of many scales stands for.
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

void terrain_set_weakness(Landscape *land, const WeaknessNoise *noise, uint64_t key, const Run *run)
{
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            float x = (float)((land->corner + column * land->cell) / noise->unit);
            float z = (float)((land->corner + row * land->cell) / noise->unit);
            float n = sparse_noise_fractal(noise->scale * x, noise->scale * z, noise->octaves,
                                           noise->gain, 0.0f, key);
            land->weakness[(int64_t)row * land->side + column] =
                clampf(1.0f + noise->strength * n, noise->least, 2.5f);
        }
    }
}
