// A walk through the cells of a cloud's grid that a ray meets and through their parts (Amanatides
// and Woo 1987), which crosses gaps between clouds in leaps.
#ifndef RAMIFY_RENDER_CLOUD_WALK_H
#define RAMIFY_RENDER_CLOUD_WALK_H

#include "render/cloud/cloud_grid.h"
#include "render/cloud/clouds.h"

// Where a walk through one size of boxes is.
typedef struct Steps {
    int at[3];     // in whole boxes
    float next[3]; // m along the ray: to the next border
} Steps;

typedef struct Walk {
    const CloudGrid *grid;
    const CloudBounds *part; // of the cell; NULL = none
    Steps cells, parts;      // parts: within the cell
    int step[3];
    float delta[3], rate[3]; // m along the ray between borders of cells, and its inverse
    float still[3];          // cells: the ray's place along axes that it does not move along
    bool whole;
    float near, far;     // m: of the part, cell or gap
    float cell_far, end; // m: of the cell or gap, of the ray
    float least, most;   // 1/m: bounds there
} Walk;

// Enters the first cell or part; false if the ray does not meet the grid. whole: parts are left
// out.
bool walk_begin(Walk *walk, const CloudGrid *grid, const CloudRay *ray, bool whole);

// Enters the next one; false at the end.
bool walk_on(Walk *walk);

#endif
