// The lower envelope of valley slopes: every river segment carries a trough that rises to its
// sides, and the land is the lowest trough at each place. Exact everywhere, not sampled on a grid.
#ifndef RAMIFY_OBJECTS_TERRAIN_ENVELOPE_H
#define RAMIFY_OBJECTS_TERRAIN_ENVELOPE_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

// A trough over the segment from (x, z) along the unit direction (dx, dz), rising from height h0 by
// `slope` per metre. Its height is the minimum over the segment of the river's height + gradient *
// sqrt(d^2 + width^2), d the distance, lowered to touch the river: a round floor, then straight
// slopes. slope < gradient.
typedef struct Trough {
    float x, z, dx, dz, length;
    float h0, slope, gradient, width;
    int32_t node; // the river's node at the upper end
} Trough;

// The trough's height at a place: the minimum over its river segment, in closed form.
float trough_height(const Trough *trough, float x, float z);

typedef struct TroughEnvelope TroughEnvelope;

// Copies the troughs. The square of side `size` about the origin is divided into leaves that list
// the troughs which can be lowest in them or within `margin` of them, found by branch and bound: a
// trough's height changes by at most its gradient per metre. count >= 1.
TroughEnvelope *trough_envelope_new(const Trough *trough, int64_t count, float size, float margin,
                                    const Run *run, Error *e);
void trough_envelope_free(TroughEnvelope *envelope); // NULL is fine

// The lowest trough's height at a place of the square (or up to margin beyond); *lowest: its index.
float trough_envelope_at(const TroughEnvelope *envelope, float x, float z, int32_t *lowest);

#endif
