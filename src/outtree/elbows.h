// Elbows: limbs that run straight from one turn to the next, as those of old trees whose leaders
// were lost and replaced, in place of the bends in which they grew.
#ifndef RAMIFY_OUTTREE_ELBOWS_H
#define RAMIFY_OUTTREE_ELBOWS_H

#include "base/error.h"
#include "outtree/out_tree.h"

// Straightens each chain (from a fork along the thickest child) between elbows: nodes of radius r
// (m) move by at most `most` * sqrt(r * (thick - r)) onto the straight way between two that stay
// (Douglas and Peucker 1973): by half of `most` trunk radii at most, those of limbs, and thin ones
// by more of their own radii. The trunk itself, of radius `thick` (m), moves by less, as if
// thick - r were thick / 10. What grows from a node moves with it. Nothing changes if most is 0.
// Radii must be set.
bool out_tree_elbows(OutTree *tree, float most, float thick, Error *e);

#endif
