// Fracture (the earlier paper, section 3.7.5): an out-tree over the base object's surface is a
// network of cracks, and the base falls into the pieces between them. A network of lines cuts
// nothing off, so the pieces are the cells of crack_cells.h: gaps in the cracks are closed, and
// inward a cell goes on as its surface does. Nothing is lost but the gap that the scene asks for.
#ifndef RAMIFY_OBJECTS_FRACTURE_FRACTURE_H
#define RAMIFY_OBJECTS_FRACTURE_FRACTURE_H

#include "mesh/pieces.h"
#include "objects/common/element.h"
#include "objects/common/recipe.h"

typedef struct FractureParams {
    ElementParams element; // its envelope is the base; growth over it makes the cracks
    int impacts;           // where cracks begin, spread over the surface
    int64_t attractors;    // how many cracks, where growth.levels are left out
    float hollow;          // m, thickness of the base's wall; 0 = solid
    float gap;             // m, width of the cracks, which the pieces lack; 0 = they fit together
    float roughness;       // of the broken faces: height over the largest extent
    float weathering;      // of the outside: height of its bumps over the largest extent
    float explode;  // how far pieces are moved apart: 0.3 = by 0.3 of their way from the middle
    float turn;     // degrees, by which pieces are turned at most
    float missing;  // 0..1: share of the pieces that are gone
    int resolution; // voxels of the level set along the largest extent
} FractureParams;

enum { FRACTURE_OUTSIDE, FRACTURE_INSIDE }; // roles of materials; inside: of the faces that broke

FractureParams fracture_params_default(void); // a ball of 1 m radius

// The recipe (see recipe.h). Grows the network of cracks on the surface. Measures pieces,
// largest_piece (its share of the base's volume), removed (the share that the pieces lack: cracks
// and dust). The geometry is the pieces.
bool fracture_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool fracture_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);
bool fracture_measure(const void *params, const Grown *grown, const Recipe *recipe,
                      MeasureList *list, Error *e);

// The pieces where they were before they moved: closed surfaces. *base (may be NULL): volume of the
// base, m^3.
bool fracture_pieces(const OutTree *network, const FractureParams *params, const Recipe *recipe,
                     MeshPieces *pieces, double *base, Error *e);

extern const struct Table fracture_table; // of its parameters

#endif
