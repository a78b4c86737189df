// Radii of an out-tree.
#ifndef RAMIFY_OUTTREE_RADII_H
#define RAMIFY_OUTTREE_RADII_H

#include "base/error.h"
#include "outtree/out_tree.h"

// Pipe model (Murray), r_parent^exponent = sum of r_child^exponent, from tip_radius (m) at the
// tips; then, when root_radius > 0, all radii are mapped monotonically (r -> tip (r/tip)^k) so that
// the thickest root has root_radius and tips keep tip_radius. A tree that never branches tapers
// evenly from root_radius to tip_radius. exponent and tip_radius > 0.
void out_tree_pipe_radii(OutTree *tree, float exponent, float tip_radius, float root_radius);

// By birth (Tanaka 5.1): radius falls from root_radius at the oldest node to tip_radius at the
// youngest, and never grows from parent to child.
void out_tree_birth_radii(OutTree *tree, float tip_radius, float root_radius);

// Swells radii near the ground: r *= 1 + flare up to `ground` (m along the branches from the root),
// and above that 1 + flare (1 - d / height)^2, where d is the distance from there, up to `height`.
void out_tree_root_flare(OutTree *tree, float flare, float ground, float height);

#endif
