// Radii of an out-tree.
#ifndef RAMIFY_OUTTREE_RADII_H
#define RAMIFY_OUTTREE_RADII_H

#include "base/error.h"
#include "outtree/out_tree.h"

// Pipe model (Murray 1926), r_parent^exponent = sum of r_child^exponent, from tip_radius (m) at the
// tips. If root_radius > 0, all radii are then mapped monotonically (r -> tip (r/tip)^k) so that
// the thickest root has root_radius and tips keep tip_radius. A tree without forks tapers evenly
// from root_radius to tip_radius. exponent and tip_radius > 0.
void out_tree_pipe_radii(OutTree *tree, float exponent, float tip_radius, float root_radius);

// By birth (Tanaka 5.1): the radius falls from root_radius at the oldest node to tip_radius at the
// youngest, and never increases from parent to child.
void out_tree_birth_radii(OutTree *tree, float tip_radius, float root_radius);

// Enlarges radii near the ground: r *= 1 + flare up to `ground` (m along the branches from the
// root), above that r *= 1 + flare (1 - d / height)^2 with the distance d from there, up to
// `height`.
void out_tree_root_flare(OutTree *tree, float flare, float ground, float height);

#endif
