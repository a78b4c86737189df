// A chain's tube as a grid of rows (between rings) and columns (sides), and the blocks of faces
// through which children leave.
#ifndef RAMIFY_SKIN_GRID_H
#define RAMIFY_SKIN_GRID_H

#include "skin/plan.h"

#define SKIN_MAX_SIDES 32

// A ring and the row of faces above it. Corner k of a ring of n sides lies at 360 k / n - 45
// degrees from the chain's side; face k is between corners k and k + 1.
typedef struct SkinStation {
    float along;    // m along the chain's axis
    int sides;      // of the ring
    uint32_t taken; // bit k: face k of the row above is used by a child
} SkinStation;

// A block of size x size faces through which a child with 4 * size sides leaves.
typedef struct SkinSeat {
    int32_t child; // chain
    int64_t row;   // station of its lower edge
    int column;    // corner at its left edge; columns wrap around
    int size;
} SkinSeat;

// Reused for all chains.
typedef struct SkinGrid {
    SkinStation *station; // where sides decreases (by half), the row below is a reduction
    int64_t station_count, station_capacity;
    SkinSeat *seat;
    int64_t seat_count, seat_capacity;
    int32_t *child; // children of the current chain, set by the caller
    int64_t child_count, child_capacity;
} SkinGrid;

// Number of sides, 4 to SKIN_MAX_SIDES, that gives branches of thinnest to thickest radius faces of
// about the same width.
float skin_grid_sides(float radius, float thinnest, float thickest);

// Number of sides at the start of a root's tube: its faces are about as wide as those of branches a
// sixth as thick as the thickest.
int skin_grid_root_sides(const SkinGrid *grid, const SkinPlan *plan, int32_t chain);

// Places a chain's rings and seats each of grid->child, thick ones first, as near as possible to
// its exit. phase: radians from the axis' side to the chain's.
bool skin_grid_place(SkinGrid *grid, const SkinPlan *plan, int32_t chain, float phase, int sides,
                     Error *e);

// Azimuth of a child's exit about its parent's axis, in columns of a grid with that many sides.
float skin_grid_column(const SkinPlan *plan, int32_t parent, int32_t child, float phase, int sides);

// Marks the seat's faces as taken or not.
void skin_grid_take(SkinGrid *grid, const SkinSeat *seat, bool taken);

// Whether all faces of the seat exist and are free.
bool skin_grid_is_free(const SkinGrid *grid, const SkinSeat *seat);

void skin_grid_clear(SkinGrid *grid);

#endif
