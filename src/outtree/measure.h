// Measures of any out-tree. Lengths in metres, angles in degrees; NAN when a tree has too few nodes
// for a measure.
#ifndef RAMIFY_OUTTREE_MEASURE_H
#define RAMIFY_OUTTREE_MEASURE_H

#include "base/measures.h"
#include "outtree/out_tree.h"

// Appends, in this order (names are the keys of JSON and of targets):
//   nodes, roots, forks, terminals, most_children
//   width, height, depth      m, of the nodes' bounding box, along x, y, z
//   length                    m, total of all branches
//   longest_path              m along the branches from a root to its furthest end
//   tortuosity                mean over all ends: path length / straight distance to the root
//   turning                   degrees, mean angle between consecutive segments of a branch
//   root_radius, tip_radius   m: the thickest root's; the ends' mean
//   branch_angle, branch_angle_spread  degrees between a side branch and the branch it leaves, mean
//                             and standard deviation
//   main_angle                degrees, mean deflection of the main branch at a fork
//   radius_exponent           e of r_parent^e = sum r_child^e, the median over the forks
//   pipe_residual             mean |sum (r_child / r_parent)^e - 1| with that e
//   murray_residual           the same with Murray's e = 3
//   asymmetry                 mean over forks of |a - b| / (a + b - 2), with a ends below the main
//                             child and b below the others: 0 = even, 1 = a fishbone
//   strahler_order, horton_number, horton_length, horton_diameter  (RB, RL, RD; see strahler.h)
//   box_dimension             of the branches, taken as lines
// and of a scanned tree the measures of its wood (measure_wood.h).
bool out_tree_measure(const OutTree *tree, MeasureList *list, Error *e);

#endif
