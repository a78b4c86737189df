#include "objects/terrain/envelope.h"

#include "base/memory.h"
#include "objects/terrain/lowest_lists.h"

#include <stdlib.h>
#include <string.h>

struct TroughEnvelope {
    Trough *trough;
    LowestLists *lists;
};

float trough_height(const Trough *t, float x, float z)
{
    float px = x - t->x, pz = z - t->z;
    float along = px * t->dx + pz * t->dz, across = px * t->dz - pz * t->dx;
    float y2 = across * across + t->width * t->width;
    float steep = t->gradient * t->gradient - t->slope * t->slope;
    float foot = along - t->slope * sqrtf(y2 / steep);
    foot = foot < 0.0f ? 0.0f : foot > t->length ? t->length : foot;
    float ahead = along - foot;
    return t->h0 + t->slope * foot + t->gradient * sqrtf(ahead * ahead + y2) -
           t->width * sqrtf(steep);
}

static void trough_bounds(const void *functions, int32_t i, float x, float z, float r, float *low,
                          float *high)
{
    const Trough *t = (const Trough *)functions + i;
    float h = trough_height(t, x, z), reach = t->gradient * r;
    *low = h - reach;
    *high = h + reach;
}

TroughEnvelope *trough_envelope_new(const Trough *trough, int64_t count, float size, float margin,
                                    const Run *run, Error *e)
{
    TroughEnvelope *envelope = memory_alloc_zero(1, sizeof *envelope, e);
    if (!envelope) {
        return NULL;
    }
    envelope->trough = memory_alloc(count, sizeof *trough, e);
    if (envelope->trough) {
        memcpy(envelope->trough, trough, sizeof *trough * (size_t)count);
        envelope->lists =
            lowest_lists_new(trough_bounds, trough, count, 3e38f, size, margin, run, e);
    }
    if (!envelope->lists) {
        trough_envelope_free(envelope);
        return NULL;
    }
    return envelope;
}

void trough_envelope_free(TroughEnvelope *envelope)
{
    if (envelope) {
        lowest_lists_free(envelope->lists);
        free(envelope->trough);
        free(envelope);
    }
}

float trough_envelope_at(const TroughEnvelope *envelope, float x, float z, int32_t *lowest)
{
    int32_t count;
    const int32_t *list = lowest_lists_at(envelope->lists, x, z, &count);
    float best = 3e38f;
    for (int32_t i = 0; i < count; i++) {
        float h = trough_height(&envelope->trough[list[i]], x, z);
        if (h < best) {
            best = h;
            *lowest = list[i];
        }
    }
    return best;
}
