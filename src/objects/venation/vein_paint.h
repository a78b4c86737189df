// Veins and areoles as pictures of the blade: row by row from the tip, every row as wide as the
// blade.
#ifndef RAMIFY_OBJECTS_VENATION_VEIN_PAINT_H
#define RAMIFY_OBJECTS_VENATION_VEIN_PAINT_H

#include "objects/venation/blade_grid.h"
#include "objects/venation/venation.h"

typedef struct Canvas {
    const VenationParams *params; // borrowed
    int width, height;
    float *pixel;   // borrowed, width * height
    BladeRow *rows; // owned
} Canvas;

// How a vein is painted: as a round bar; as a furrow with soft edges, in which it lies; as a flat
// line; as the band about it that stays green in autumn, of thick veins only.
typedef enum VeinProfile { VEIN_BAR, VEIN_FURROW, VEIN_LINE, VEIN_GREEN } VeinProfile;

// How much paler than the greenest areole the palest is; lines are 1.
#define VEIN_UNEVEN 0.3f

// pixel: width * height floats. Clear it after a failure, too.
bool canvas_init(Canvas *canvas, const VenationParams *params, int width, int height, float *pixel,
                 Error *e);
void canvas_clear(Canvas *canvas);

// Sets all pixels to the largest value of the veins over them, 0 beside veins. at: places of the
// nodes on the flat leaf.
void canvas_paint_veins(const Canvas *canvas, const OutTree *tree, const Vec3 *at,
                        VeinProfile profile);

// Gives every areole between painted lines a value of its own, 0 to VEIN_UNEVEN.
bool canvas_vary_areoles(const Canvas *canvas, Error *e);

#endif
