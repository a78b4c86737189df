// Billows as a picture in space that repeats: round bumps of three sizes (inverted cell noise,
// Worley 1996), looked up instead of computed because tracking asks for it at every step.
#ifndef RAMIFY_RENDER_CLOUD_BILLOW_H
#define RAMIFY_RENDER_CLOUD_BILLOW_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct Billow Billow;

Billow *billow_new(uint64_t key, const Run *run, Error *e);
void billow_free(Billow *billow); // NULL is fine

// -1 .. 1 with a mean near 0; period 1 in each direction, four of the largest bumps on it.
float billow_at(const Billow *billow, Vec3 p);

#endif
