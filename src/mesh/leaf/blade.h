// The blade of a leaf or leaflet: one sheet along a midrib.
#ifndef RAMIFY_MESH_LEAF_BLADE_H
#define RAMIFY_MESH_LEAF_BLADE_H

#include "mesh/leaf/leaf.h"
#include "mesh/quads.h"

#include <stdint.h>

// How finely a blade is drawn.
typedef enum BladeDetail {
    BLADE_KITE,   // one quad, or one a lobe
    BLADE_SMOOTH, // 8 quads, without lobes and teeth
    BLADE_PLAIN,  // about 25 quads, without teeth
    BLADE_FINE
} BladeDetail;

// Half width of an oak's blade at t in 0..1 along it, relative to the largest: an obovate oval,
// widest at 0.62, cut by the bays between the lobes.
float blade_oak_half(const LeafParams *params, float t, float phase);

// Half width of a plain blade at s in 0..1 from base to tip, relative to the largest, and where
// along the midrib that point of the margin lies (0..1; below 0 in the lobes of a heart's base).
Vec2 blade_margin(const LeafParams *params, float s);

// What a saw-toothed edge adds at s in 0..1 along it, -0.5..0.5 of a tooth's depth; teeth point to
// the tip.
float blade_tooth(const LeafParams *params, float s);

// Rows of a blade with `teeth` on each side: s in 0..1 of the notches and points of the teeth.
// Writes at most `most` values in ascending order from 0 to 1; returns their number.
int blade_rows(const LeafParams *params, int plain_rows, float *s, int most);

// A point of the blade: x across, t along the midrib, lifted by `ripple` (m); folded and curled.
Vec3 blade_point(const LeafParams *params, float x, float t, float ripple);

// Adds the blade without its stalk.
void blade_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed);

// The kinds, one file each.
void blade_oak_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed);
void blade_plain_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed);
void blade_palmate_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed);
void blade_fan_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed);
void blade_pad_add(Quads *quads, const LeafParams *params, BladeDetail detail, uint64_t seed);

#endif
