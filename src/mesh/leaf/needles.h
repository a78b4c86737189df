// Pieces of conifers' shoots: needles along a piece of twig, rosettes of needles, sprays of scales.
#ifndef RAMIFY_MESH_LEAF_NEEDLES_H
#define RAMIFY_MESH_LEAF_NEEDLES_H

#include "mesh/leaf/leaf.h"
#include "mesh/quads.h"

#include <stdint.h>

// Is the shape one of these?
static inline bool leaf_has_needles(const LeafParams *params)
{
    return params->shape == LEAF_NEEDLES || params->shape == LEAF_TUFT ||
           params->shape == LEAF_SCALES;
}

// A stride: each shoot of a branchlet is one quad.
enum { NEEDLES_AS_SHOOTS = 1 << 20 };

// Are there side shoots?
static inline bool needles_branch(const LeafParams *params)
{
    return params->shape == LEAF_NEEDLES && params->side_shoots > 0;
}

// Is there growth of this year, paler than the rest?
static inline bool needles_flush(const LeafParams *params)
{
    return params->shape == LEAF_NEEDLES && params->flush > 0.0f;
}

// Adds the piece along +Y with every needle whose number is a multiple of stride, `widen` times as
// wide. prisms: needles are three-sided, else flat.
void needles_add(Quads *quads, const LeafParams *params, int stride, float widen, bool prisms,
                 uint64_t seed);

#endif
