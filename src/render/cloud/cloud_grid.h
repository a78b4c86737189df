// One entry of a scene's clouds as a field of extinction: a grid of signed distances to the cloud's
// coarse form and of how soft its border is, which billows and wisps move where the field is looked
// up; and the least and greatest extinction in the cells of a coarser grid and in parts of them.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_GRID_H
#define RAMIFY_RENDER_CLOUD_CLOUD_GRID_H

#include "base/run.h"
#include "base/vec.h"
#include "render/cloud/cloud.h"
#include "render/cloud/detail.h"

#include <stdint.h>

typedef struct SparseVolume SparseVolume;

enum {
    CELL = 2,         // voxels along its side
    PARTS = 4,        // of a cell where the extinction changes much, along its side
    CELL_STEPS = 255, // of the greatest extinction
    MOST_GAP = 32,
    DISTANCE_STEPS = 256, // a voxel
    FARTHEST = -128 * DISTANCE_STEPS,
    SOFTEST = 1024,
    ICE_STEPS = 255
};

typedef struct CloudNode {
    int16_t distance; // inside the coarse form, in steps
    int16_t softness; // of the border, 0 .. SOFTEST
} CloudNode;

// Of the extinction, in steps.
typedef struct CloudBounds {
    uint8_t least, most;
} CloudBounds;

typedef struct CloudCell {
    CloudBounds bounds;
    uint8_t gap;   // cells to the nearest one with droplets, in the largest of the three
                   // directions; 0 if most > 0, else 1 .. MOST_GAP
    int32_t parts; // place of its PARTS^3 parts, times PARTS^3, z first, y last; -1 = alike
} CloudCell;

// How lookups shape the border. All in m; pairs: large and small.
typedef struct Roughness {
    float period[2]; // of the detail
    float billow[2]; // height of billows where the border is crisp
    float wisp[2];   // height of wisps where it is soft
    float edge[2];   // over which the density rises: where crisp, where soft
    float spread;    // of a soft border outward: it begins farther out than a crisp one
    float base;      // over which it rises from the condensation level; 0 = has none
} Roughness;

typedef struct CloudGrid {
    Vec3 low;               // m: position of node (0, 0, 0)
    float voxel;            // m
    int count[3], cells[3]; // nodes and cells in x, y, z: nodes are multiples of
                            // CELL, in x and z powers of two
    bool repeats;           // in x and z without end
    bool fog;               // densest at its base
    bool pooled;            // fog on a floor: densest from its thickness below its top down
    CloudNode *node;        // at cloud_grid_node; owned
    uint8_t *ice;           // at the same: share of the greatest extinction, 0 .. ICE_STEPS, less
                            // than all where droplets are frozen or ash is thinned out;
                            // CLOUD_STORM and CLOUD_PLUME, else NULL; owned
    CloudCell *cell;        // at cloud_grid_cell; owned
    CloudBounds *part;      // owned
    const DetailNoise *detail; // borrowed
    Roughness rough;
    float base, thickness, extinction;
    Vec3 albedo;     // share of the light that a particle scatters
    float scattered; // mean of these shares, exactly 1 where all are
    SparseVolume
        *voxels; // CLOUD_GRID and CLOUD_SPRAY: owned, and no nodes, detail or roughness; else NULL
    Transform to_own; // from the scene to its own space, where low and cells are
    float sample;     // m between voxels
} CloudGrid;

// The cloud's form depends on key alone. Free with cloud_grid_clear, also after a failure.
bool cloud_grid_new(CloudGrid *grid, const Cloud *cloud, const DetailNoise *detail, uint64_t key,
                    const Run *run, Error *e);
void cloud_grid_clear(CloudGrid *grid);

int64_t cloud_grid_bytes(const Cloud *cloud); // that it takes, with parts in a third of the cells,
                                              // of pooled fog in two thirds

static inline int64_t cloud_grid_node(const CloudGrid *g, int x, int y, int z)
{
    return ((int64_t)z * g->count[0] + x) * g->count[1] + y;
}

// -1 beyond a grid that does not repeat.
static inline int64_t cloud_grid_cell(const CloudGrid *g, int x, int y, int z)
{
    if (g->repeats) { // cells across are a power of two
        x &= g->cells[0] - 1;
        z &= g->cells[2] - 1;
    }
    bool inside = (unsigned)x < (unsigned)g->cells[0] && (unsigned)z < (unsigned)g->cells[2] &&
                  (unsigned)y < (unsigned)g->cells[1];
    return inside ? ((int64_t)z * g->cells[0] + x) * g->cells[1] + y : -1;
}

static inline int64_t cloud_grid_cells(const CloudGrid *g)
{
    return (int64_t)g->cells[0] * g->cells[1] * g->cells[2];
}

// A place where its detail is looked up: turned, so that the period is along no axis.
Vec3 cloud_grid_turned(Vec3 p);
extern const Vec3 cloud_grid_turned_cube; // half the box around the cube -1 .. 1 when turned

// Extinction at a place, 1/m. fine: with the small detail, too.
float cloud_grid_extinction(const CloudGrid *grid, Vec3 p, bool fine);

// Whether the extinction is greater than a level >= 0; looks no further than it takes to tell.
bool cloud_grid_exceeds(const CloudGrid *grid, Vec3 p, bool fine, float level);

// The same without wisps and small billows: what guides a denoiser must not be torn.
float cloud_grid_smooth(const CloudGrid *grid, Vec3 p);

#endif
