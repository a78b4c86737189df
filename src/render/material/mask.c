#include "render/material/mask.h"

#include <stdlib.h>

void mask_set_clear(MaskSet *set)
{
    for (int64_t i = 0; i < set->count; i++) {
        free(set->mask[i].share);
    }
    free(set->mask);
    free(set->of_part);
    *set = (MaskSet){0};
}

static int mirrored(int i, int count)
{
    int period = 2 * (count - 1);
    i %= period;
    i = i < 0 ? i + period : i;
    return i < count ? i : period - i;
}

// Samples around a coordinate and their weights.
static void find_weights(float at, int count, int sample[4], float weight[4])
{
    const float most = 1e6f; // where floats have no fraction left anyway
    at = clampf(at, -most, most);
    float whole = floorf(at), t = at - whole, s = 1.0f - t;
    for (int k = 0; k < 4; k++) {
        sample[k] = mirrored((int)whole + k - 1, count);
    }
    weight[0] = s * s * s / 6.0f;
    weight[1] = (4.0f - 6.0f * t * t + 3.0f * t * t * t) / 6.0f;
    weight[2] = (4.0f - 6.0f * s * s + 3.0f * s * s * s) / 6.0f;
    weight[3] = t * t * t / 6.0f;
}

float mask_at(const Mask *mask, float x, float z)
{
    int column[4], row[4];
    float across[4], along[4], sum = 0.0f;
    find_weights((x - mask->origin.x) / mask->cell.x, mask->columns, column, across);
    find_weights((z - mask->origin.y) / mask->cell.y, mask->rows, row, along);
    for (int j = 0; j < 4; j++) {
        const uint8_t *share = mask->share + (int64_t)row[j] * mask->columns;
        for (int i = 0; i < 4; i++) {
            sum += along[j] * across[i] * (float)share[column[i]];
        }
    }
    return sum * (1.0f / 255.0f);
}
