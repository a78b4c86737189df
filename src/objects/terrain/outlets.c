#include "base/random.h"
#include "objects/terrain/internal.h"

void terrain_open_outlets(const Terrain *terrain, int outlets, Landscape *land)
{
    uint64_t key = random_key(terrain->seed, STREAM_OUTLETS);
    int last = land->side - 1;
    for (int n = 0; n < outlets; n++) {
        // In turn over the sides, so that no two are neighbours by chance.
        float at = random_range(random_key(key, (uint64_t)n), 0.15f, 0.85f);
        int side = (n + (int)(key >> 60)) % 4, place = (int)(at * (float)last + 0.5f);
        for (int k = -1; k <= 1; k++) {
            int column = side == 0 ? 0 : side == 1 ? last : place + k;
            int row = side == 2 ? 0 : side == 3 ? last : place + k;
            if (column >= 0 && row >= 0 && column <= last && row <= last) {
                landscape_set_base(land, (int64_t)row * land->side + column, 0.0);
            }
        }
    }
}
