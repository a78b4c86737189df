// Measures of a tree's wood, as foresters and laser scans have them: wood of radius 1 cm and more.
// An axis goes on along the child with most wood (volume) beyond it.
#ifndef RAMIFY_OUTTREE_MEASURE_WOOD_H
#define RAMIFY_OUTTREE_MEASURE_WOOD_H

#include "base/measures.h"
#include "outtree/out_tree.h"

// Appends, in this order, for a tree that stands on level ground at height `ground` (m), without
// roots; NAN where there is too little wood:
//   diameter              m, of the stem 1.3 m above the ground
//   height_per_diameter   height over that
//   crown_width_per_height   mean of the extents along x and z over the height
//   branch_per_height     m of wood, stem and branches, per m of height
//   tips                  ends of that wood
//   path_fraction         mean way along the branches from the base to a tip over the longest
//   straightness          chord / length, median over the branches that leave the stem
//   limb_straightness     the same median over their length: half of it is in branches of at most
//                         this straightness, so stubs hardly count
//   stem_share            of the wood's volume
//   form_factor           volume over that of a cylinder of this diameter and height
bool out_tree_measure_wood(const OutTree *tree, float ground, MeasureList *list, Error *e);

#endif
