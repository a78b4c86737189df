// Clouds' coarse forms as trees of balls: rising columns of air bear balls on their flanks, and
// these smaller ones, as on a cauliflower (after Bouthors and Neyret, "Modeling Clouds Shape",
// Eurographics 2004).
#ifndef RAMIFY_RENDER_CLOUD_PUFFS_H
#define RAMIFY_RENDER_CLOUD_PUFFS_H

#include "base/error.h"
#include "base/vec.h"
#include "render/cloud/cloud.h"

#include <stdint.h>

typedef struct Puff {
    Vec3 center; // m
    float radius;
    float flatness; // 1 = a ball; more: its height is that much less than its width
    float softness; // 0 = growing, with a crisp border; 1 = dissolving into shreds
} Puff;

typedef struct Puffs {
    Puff *puff; // owned
    int64_t count, capacity;
    float floor;    // m: altitude of the base, below which no ball is centred
    float smallest; // m: radius
} Puffs;

// A column of air with balls on its flanks.
typedef struct Column {
    Vec3 foot;
    float radius, height; // m
    float taper;          // share by which it is narrower at its top
    float lean_x, lean_z; // m downwind a metre of height
    float softness;       // of its age
    float wear;           // how much softer dry air makes its foot and its flanks
} Column;

bool puffs_add(Puffs *puffs, Puff puff, Error *e);

// A softness that dry air has raised by a share 0..1 of what is left, or lowered by -share.
float puffs_worn(float softness, float share);

// A ball and the smaller ones on its flanks, more of them above than below: what rises bulges.
// Dry air that the bulge pushes aside is mixed in below it, not into its top. levels: of ever
// smaller balls, at most PUFF_LEVELS. Errors: ERROR_MEMORY.
enum { PUFF_LEVELS = 3 };
bool puffs_add_bulging(Puffs *puffs, Puff ball, float wear, int levels, uint64_t key, Error *e);

// Balls up a column.
bool puffs_add_column(Puffs *puffs, const Column *column, uint64_t key, Error *e);

void puffs_clear(Puffs *puffs);

#endif
