#include "shape/volume.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

Volume *volume_new(const int size[3], int components, Error *e)
{
    Volume *volume = memory_alloc_zero(1, sizeof *volume, e);
    int64_t count = (int64_t)size[0] * size[1] * size[2] * components;
    if (volume && (volume->value = memory_alloc_zero(count, sizeof *volume->value, e))) {
        memcpy(volume->size, size, sizeof volume->size);
        volume->components = components;
        return volume;
    }
    free(volume);
    return NULL;
}

void volume_free(Volume *volume)
{
    if (volume) {
        free(volume->value);
        free(volume);
    }
}

void volume_at(const Volume *v, Vec3 p, float *value)
{
    Vec3 at = transform_point(&v->to_index, p);
    const float place[3] = {at.x, at.y, at.z};
    int low[3];
    float share[3];
    for (int i = 0; i < 3; i++) {
        if (!(place[i] > -1.0f && place[i] < (float)v->size[i])) {
            memcpy(value, v->background, sizeof(float) * (size_t)v->components);
            return;
        }
        float floor = floorf(place[i]);
        low[i] = (int)floor;
        share[i] = place[i] - floor;
    }
    for (int c = 0; c < v->components; c++) {
        value[c] = 0.0f;
    }
    for (int corner = 0; corner < 8; corner++) {
        const float *found = v->background;
        int64_t index = 0;
        float weight = 1.0f;
        for (int i = 2; i >= 0; i--) {
            int k = low[i] + (corner >> i & 1);
            weight *= corner >> i & 1 ? share[i] : 1.0f - share[i];
            index = k < 0 || k >= v->size[i] || index < 0 ? -1 : index * v->size[i] + k;
        }
        found = index >= 0 ? v->value + index * v->components : found;
        for (int c = 0; c < v->components; c++) {
            value[c] += weight * found[c];
        }
    }
}
