// The free ends of a closed net of veins: stubs that growth has left, and veinlets that end in the
// areoles.
#ifndef RAMIFY_GROW_VENATION_VEINLETS_H
#define RAMIFY_GROW_VENATION_VEINLETS_H

#include "grow/venation/venation.h"

// Removes free ends (those that join no other vein) shorter than `length` m, until there are none.
bool veins_trim(OutTree *tree, float length, Error *e);

// Adds veinlets of two to five steps, some forked at their end, to veins grown with these
// parameters: at most one in about two births each way, in this share (0 to 1) of the places. They
// keep half a birth away from the net, or stop.
bool veins_add_veinlets(OutTree *tree, const VeinParams *params, float share, const Run *run,
                        Error *e);

#endif
