// One entry of a scene's clouds as a field of extinction: a grid of signed distances to the cloud's
// coarse form and of how soft its border is, which billows and wisps move where the field is looked
// up; and the greatest extinction in each brick of the grid.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_GRID_H
#define RAMIFY_RENDER_CLOUD_CLOUD_GRID_H

#include "base/run.h"
#include "base/vec.h"
#include "render/cloud/cloud.h"
#include "render/cloud/detail.h"

#include <stdint.h>

enum {
    BRICK = 4,            // voxels along its side
    NODES_ACROSS = 512,   // in x and z
    DISTANCE_STEPS = 256, // a voxel
    FARTHEST = -128 * DISTANCE_STEPS,
    SOFTEST = 1024
};

typedef struct CloudNode {
    int16_t distance; // inside the coarse form, in steps
    int16_t softness; // of the border, 0 .. SOFTEST
} CloudNode;

// How lookups shape the border. All in m; pairs: large and small.
typedef struct Roughness {
    float period[2]; // of the detail
    float billow[2]; // height of billows where the border is crisp
    float wisp[2];   // height of wisps where it is soft
    float edge[2];   // over which the density rises: where crisp, where soft
    float base;      // over which it rises from the condensation level
} Roughness;

typedef struct CloudGrid {
    Vec3 low;                  // m: position of node (0, 0, 0)
    float voxel;               // m
    int count[3], bricks[3];   // nodes and bricks in x, y, z; multiples of BRICK
    bool repeats;              // in x and z without end
    CloudNode *node;           // at cloud_grid_node; owned
    float *bound;              // (z bricks_x + x) bricks_y + y: greatest extinction; owned
    const DetailNoise *detail; // borrowed
    Roughness rough;
    float base, thickness, extinction;
} CloudGrid;

// The cloud's form depends on key alone. Free with cloud_grid_clear, also after a failure.
bool cloud_grid_new(CloudGrid *grid, const Cloud *cloud, const DetailNoise *detail, uint64_t key,
                    const Run *run, Error *e);
void cloud_grid_clear(CloudGrid *grid);

int64_t cloud_grid_bytes(const Cloud *cloud); // that its nodes take

static inline int64_t cloud_grid_node(const CloudGrid *g, int x, int y, int z)
{
    return ((int64_t)z * g->count[0] + x) * g->count[1] + y;
}

// Farthest from a coarse border of this softness that detail moves the cloud's, m.
float cloud_grid_reach(const CloudGrid *grid, float softness);

// Extinction at a place, 1/m. fine: with the small detail, too.
float cloud_grid_extinction(const CloudGrid *grid, Vec3 p, bool fine);

// The same without wisps and small billows: what guides a denoiser must not be torn.
float cloud_grid_smooth(const CloudGrid *grid, Vec3 p);

#endif
