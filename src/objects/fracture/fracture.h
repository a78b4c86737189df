// Fracture (the earlier paper, section 3.7.5): an out-tree over the base object's surface is a
// network of cracks, and the base falls into the pieces between them. A network of lines does not
// separate a body, so the pieces are the cells of crack_cells.h: gaps in the cracks are closed, and
// cells extend inward from the surface. No volume is lost except the gap that the scene asks for.
#ifndef RAMIFY_OBJECTS_FRACTURE_FRACTURE_H
#define RAMIFY_OBJECTS_FRACTURE_FRACTURE_H

#include "mesh/pieces.h"
#include "objects/common/element.h"
#include "objects/common/recipe.h"

typedef struct FractureParams {
    ElementParams element; // its envelope is the base; growth on it is the cracks
    int impacts;           // starting points of cracks, spread over the surface
    int64_t attractors;    // number of cracks if growth.levels are omitted
    float hollow;          // m, thickness of the base's wall; 0 = solid
    float gap;             // m, width of the cracks, removed from the pieces; 0 = they fit together
    float roughness;       // of the broken faces: height over the largest extent
    float weathering;      // of the outside: height of its bumps over the largest extent
    float explode;         // displacement of pieces over their distance from the middle
    float turn;            // degrees, largest rotation of a piece
    float missing;         // 0..1: share of the pieces left out
    int resolution;        // voxels of the level set along the largest extent
} FractureParams;

enum { FRACTURE_OUTSIDE, FRACTURE_INSIDE }; // roles of materials; inside: the fracture faces

FractureParams fracture_params_default(void); // a ball of 1 m radius

// The recipe (see recipe.h). Grows the network of cracks on the surface. Measures pieces,
// largest_piece (its share of the base's volume), removed (the share lost to cracks and dust). The
// geometry is the pieces.
bool fracture_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool fracture_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);
bool fracture_measure(const void *params, const Grown *grown, const Recipe *recipe,
                      MeasureList *list, Error *e);

// The pieces at their original places: closed surfaces. *base (may be NULL): volume of the base,
// m^3.
bool fracture_pieces(const OutTree *network, const FractureParams *params, const Recipe *recipe,
                     MeshPieces *pieces, double *base, Error *e);

extern const struct Table fracture_table; // of its parameters

#endif
