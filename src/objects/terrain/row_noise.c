// Noise at the samples of a landscape, row by row, which costs less than sample by sample.
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

void row_noise(const RowNoise *noise, const RowPart *part, float *n)
{
    float x[ROW_PART], z[ROW_PART];
    const Landscape *land = part->land;
    for (int k = 0; k < part->count; k++) {
        double east = land->corner + (part->first + k) * land->cell;
        double south = land->corner + part->row * land->cell;
        x[k] = (float)(noise->scale * east / noise->unit);
        z[k] = (float)(noise->scale * south / noise->unit);
    }
    sparse_noise_fractal_along(x, z, part->count, noise->octaves, noise->gain, 0.0f, noise->key, n);
}

RowPart row_part(const Landscape *land, int row, int first)
{
    int left = land->side - first;
    return (RowPart){land, row, first, left < ROW_PART ? left : ROW_PART};
}
