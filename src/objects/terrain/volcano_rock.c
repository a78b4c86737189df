// The rock of a volcano's flanks: old flows, welded tephra and dykes radiate from the summit, with
// loose tephra between them. So rock is strong and weak in strips down the flanks, which part into
// more strips the farther they are from the summit: rain cuts barrancos between ribs.
#include "base/random.h"
#include "objects/terrain/noise.h"
#include "objects/terrain/volcano.h"

#include <math.h>

enum { RIB_OCTAVES = 8 };

// About -1..1, negative on ribs. r: m from the summit; (x, z): unit, the direction from it.
static float ribs(float r, float x, float z, float relief, uint64_t key)
{
    const float turn = 6.2831853f, narrow = 55.0f, wide = 420.0f; // m
    float sum = 0.0f, squares = 0.0f, count = 8.0f;               // of strips about the summit
    for (int i = 0; i < RIB_OCTAVES; i++, count *= 2.0f) {
        float width = turn * r / count;
        float share =
            smoothstepf(narrow, 2.0f * narrow, width) * smoothstepf(2.0f * wide, wide, width);
        if (share <= 0.0f) {
            continue;
        }
        // a strip is about six times as long as wide where r is the relief
        float scale = count / turn * (1.0f + 0.17f * r / relief);
        sum += share * sparse_noise(scale * x, scale * z, key + (uint64_t)i);
        squares += share * share;
    }
    return squares > 0.0f ? sum / sqrtf(fmaxf(squares, 1.0f)) : 0.0f;
}

void volcano_find_weakness(Volcano *v, const Landscape *land, const Run *run)
{
    uint64_t key = random_key(v->terrain->seed, STREAM_WEAKNESS);
    uint64_t rib_key = random_key(key, 1);
    float relief = (float)v->relief;
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            float x = (float)(land->corner + column * land->cell) / relief;
            float z = (float)(land->corner + row * land->cell) / relief;
            Away away = volcano_away(land, &v->summit, i);
            float r = (float)(away.r > 1.0 ? away.r : 1.0);
            float rib = ribs(r, (float)away.dx / r, (float)away.dz / r, relief, rib_key);
            float n = sparse_noise_fractal(5.0f * x, 5.0f * z, 5, 0.7f, 0.0f, key);
            v->weakness[i] = clampf(1.0f + 0.2f * n + 0.45f * rib, 0.25f, 2.2f);
        }
    }
}
