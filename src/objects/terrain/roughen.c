// The ground on which streams and creep begin: without bumps water would find no way to take.
#include "base/random.h"
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

void terrain_add_lumps(Landscape *land, double height, double wavelength, uint64_t seed,
                       const Run *run)
{
    enum { AT_ONCE = 256 };
    uint64_t key = random_key(random_key(seed, STREAM_LUMPS), (uint64_t)land->side);
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        float x[AT_ONCE], z[AT_ONCE], n[AT_ONCE];
        for (int first = 0; first < land->side; first += AT_ONCE) {
            int count = land->side - first < AT_ONCE ? land->side - first : AT_ONCE;
            for (int k = 0; k < count; k++) {
                x[k] = (float)((double)(first + k) * land->cell / wavelength);
                z[k] = (float)((double)row * land->cell / wavelength);
            }
            sparse_noise_fractal_along(x, z, count, 2, 0.5f, 0.0f, key, n);
            for (int k = 0; k < count; k++) {
                int64_t i = (int64_t)row * land->side + first + k;
                land->rock[i] += land->base[i] ? 0.0 : height * (double)n[k];
            }
        }
    }
}
