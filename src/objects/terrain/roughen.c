// The ground on which streams and creep begin: without bumps water would find no way to take.
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

void terrain_roughen(Landscape *land, float relief, double wavelength, float bumps, uint64_t key)
{
    for (int64_t i = 0; i < landscape_count(land); i++) {
        int64_t column = i % land->side, row = i / land->side;
        float x = (float)((double)column * land->cell / wavelength);
        float z = (float)((double)row * land->cell / wavelength);
        float n = sparse_noise_fractal(x, z, 6, 0.6f, 0.0f, key);
        land->rock[i] = 0.02 * (double)relief * (double)(2.0f + bumps * n);
    }
}
