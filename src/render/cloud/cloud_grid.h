// One entry of a scene's clouds as a field of extinction: a grid of signed distances to the cloud's
// coarse form, whose border billows move where the field is looked up, and the greatest extinction
// in each brick of the grid.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_GRID_H
#define RAMIFY_RENDER_CLOUD_CLOUD_GRID_H

#include "base/run.h"
#include "base/vec.h"
#include "render/cloud/billow.h"
#include "render/cloud/cloud.h"

#include <stdint.h>

enum { BRICK = 8 }; // voxels along its side

typedef struct CloudGrid {
    Vec3 low;                // m: position of node (0, 0, 0)
    float voxel;             // m
    int count[3], bricks[3]; // nodes and bricks in x, y, z; multiples of BRICK
    bool repeats;            // in x and z without end
    int16_t
        *distance; // (z count_x + x) count_y + y: distance inside, DISTANCE_STEPS a voxel; owned
    float *bound;  // (z bricks_x + x) bricks_y + y: greatest extinction; owned
    const Billow *billow;       // borrowed
    float period[2], height[2]; // m: of the billows, large and small
    float edge;                 // m over which the density rises to 1
    float
        frozen; // altitude in shares of the thickness above which ice softens the border; 2 = none
    float base, thickness, extinction;
} CloudGrid;

enum { DISTANCE_STEPS = 256 };

// The cloud's form depends on key alone. Free with cloud_grid_clear, also after a failure.
bool cloud_grid_fill(CloudGrid *grid, const Cloud *cloud, const Billow *billow, uint64_t key,
                     const Run *run, Error *e);
void cloud_grid_clear(CloudGrid *grid);

int64_t cloud_grid_bytes(const Cloud *cloud); // that its distances take

// Extinction at a place, 1/m.
float cloud_grid_extinction(const CloudGrid *grid, Vec3 p);

#endif
