// The small forms of clouds as pictures in space that repeat, looked up instead of computed because
// tracking asks for them at every step: billows, which bulge outward and meet in creases (inverted
// cell noise, Worley 1996), and wisps, torn by eddies (gradient noise moved along a curl: Bridson,
// Houriham and Nordenstam, "Curl-Noise for Procedural Fluid Flow", SIGGRAPH 2007).
#ifndef RAMIFY_RENDER_CLOUD_DETAIL_H
#define RAMIFY_RENDER_CLOUD_DETAIL_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct DetailNoise DetailNoise;

// Both -1 .. 1 with a mean near 0.
typedef struct Detail {
    float billow, wisp;
} Detail;

DetailNoise *detail_new(uint64_t key, const Run *run, Error *e);
void detail_free(DetailNoise *noise); // NULL is fine

// Period 1 in each direction, DETAIL_CELLS of the largest billows and wisps on it.
enum { DETAIL_CELLS = 6 };
Detail detail_at(const DetailNoise *noise, Vec3 p);

// Bounds of both.
typedef struct DetailRange {
    Detail low, high;
} DetailRange;

// Bounds in the box from middle - half to middle + half.
DetailRange detail_range(const DetailNoise *noise, Vec3 middle, Vec3 half);
DetailRange detail_range_whole(const DetailNoise *noise); // everywhere

#endif
