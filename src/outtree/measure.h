// What can be measured on any out-tree. Lengths in metres, angles in degrees; NAN where a tree has
// too little of what a measure needs.
#ifndef RAMIFY_OUTTREE_MEASURE_H
#define RAMIFY_OUTTREE_MEASURE_H

#include "base/measures.h"
#include "outtree/out_tree.h"

// Appends, in this order (names are the keys of JSON and of targets):
//   nodes, roots, forks, terminals, most_children
//   width, height, depth      m, of the box about the nodes, along x, y, z
//   length                    m, of all branches together
//   longest_path              m along the branches from a root to its furthest end
//   tortuosity                mean over all ends: way along the branches / straight way to the root
//   turning                   degrees, mean change of direction from one step to the next along a
//                             branch
//   root_radius, tip_radius   m: the thickest root's; the ends' mean
//   branch_angle, branch_angle_spread  degrees between a side branch and the branch it leaves, mean
//                             and standard deviation
//   main_angle                degrees that the branch itself is deflected at a fork, mean
//   radius_exponent           e of r_parent^e = sum r_child^e, the median over the forks
//   pipe_residual             mean |sum (r_child / r_parent)^e - 1| with that e
//   murray_residual           the same with Murray's e = 3
//   asymmetry                 mean over forks of |a - b| / (a + b - 2), a ends on the main child's
//                             side, b on the others': 0 = even, 1 = a fishbone
//   strahler_order, horton_number, horton_length, horton_diameter  (RB, RL, RD; see strahler.h)
//   box_dimension             of the branches as lines
bool out_tree_measure(const OutTree *tree, MeasureList *list, Error *e);

#endif
