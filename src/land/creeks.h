// Creeks that drain a marsh at ebb tide: a tree of them from each shore into the land, along the
// ways of least cost; each creek as wide as the area it drains asks. The widths of tidal channels
// grow as a power of their tidal prism, which is in proportion to that area (Rinaldo et al. 1999,
// Water Resources Research 35, 3905-3917).
#ifndef RAMIFY_LAND_CREEKS_H
#define RAMIFY_LAND_CREEKS_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef enum CreekGround {
    CREEK_NONE,  // no creek comes here
    CREEK_MARSH, // drained
    CREEK_WATER  // creeks end in it
} CreekGround;

// A grid of samples; lengths are in their distance.
typedef struct CreekPlain {
    int columns, rows;
    const uint8_t *ground; // CreekGround
    const float *cost;     // above 0, of the way over a sample
    float least;           // samples drained by the smallest creek
    float width;           // of that
    float most;            // width of the widest
} CreekPlain;

// A piece of a creek, a straight line.
typedef struct CreekReach {
    Vec2 from, to;
    float half_from, half_to; // half of its width
} CreekReach;

typedef struct Creeks {
    CreekReach *reach;
    int64_t count;
    int columns, rows; // of blocks of CREEK_BLOCK samples
    int32_t *first;    // of each block in `list`, and the end
    int32_t *list;     // reaches near the block
} Creeks;

enum { CREEK_BLOCK = 4 };

// Half-widths from a creek's middle up to which creeks_beside finds it.
#define CREEK_REACH 3.0f

// Free with creeks_free.
Creeks *creeks_grow(const CreekPlain *plain, Error *e);
void creeks_free(Creeks *creeks); // NULL is fine

// The distance of a place from the middle of the creek that it is the farthest inside of, in
// half-widths; INFINITY beyond CREEK_REACH. *half: that creek's half-width there.
float creeks_beside(const Creeks *creeks, Vec2 at, float *half);

#endif
