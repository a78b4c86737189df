// Where on a mesh of tiles (tile_mesh.h) a place lies: the height of the triangle that is drawn
// there.
#ifndef RAMIFY_LAND_TILE_PLACES_H
#define RAMIFY_LAND_TILE_PLACES_H

#include "base/mesh.h"

// The faces of a tile: two for each cell but the outermost, row by row, then those of the rim.
typedef struct DrawnTile {
    int cells; // a side
    int64_t first_face, face_count;
} DrawnTile;

typedef struct TilePlaces {
    double origin[2], side; // m: x and z of the north-west corner of all tiles; of a tile
    int count;              // tiles a side
    DrawnTile *tile;        // owned, row by row
} TilePlaces;

void tile_places_clear(TilePlaces *places); // {0} is fine

// The height at a place of the mesh that the places were made with; beside all tiles, as the
// nearest of their triangles goes on.
float tile_places_height(const TilePlaces *places, const Mesh *mesh, float x, float z);

#endif
