// A leaf and its veins (Runions et al. 2005), as geometry (a translucent blade with raised veins,
// or the veins alone: a skeleton leaf) and as a texture.
#ifndef RAMIFY_OBJECTS_VENATION_VENATION_H
#define RAMIFY_OBJECTS_VENATION_VENATION_H

#include "objects/common/recipe.h"
#include "outtree/out_tree.h"
#include "shape/leaf_outline.h"

typedef struct VenationParams {
    Vec3 position;       // m, of the blade's base
    Vec3 rotation;       // degrees about x, y, z; without it the leaf is upright, facing +Z
    LeafOutline outline; // width 0 = half of the length; its key: see params_of
    bool closed;         // veins with loops; otherwise a tree
    bool marginal;       // the blade grows at its margin; otherwise evenly
    int secondaries;     // on each half, looped near the margin; 0 = grown as all others
    int tertiaries;      // from each secondary vein to the next; 0 = grown as all others
    int detail;          // meshes of the net along the leaf's length
    int rows;            // of the blade's grid; 0 = by the detail
    int smoothing;       // passes that round the veins' bends; with any, radii change gradually
    float midrib;        // m, radius at the base; 0 = 0.008 of the length
    float vein;          // m, radius of the finest; 0 = 0.06 of a mesh
    float embedded;      // m: thinner veins (radius) lie in the blade, as lighter lines
    float petiole;       // m, length of the stalk; 0 = none
    float veinlets;      // share of areoles with a free-ending veinlet; above 0, stubs are cleared
    float relief;        // m: depth of the furrow of the midrib; lesser veins have lesser ones
    float wave;          // m: height of the waves on the margin
    float hairs;         // m: length of the hairs at the margin; 0 = none; only of a blade
    float vein_hairs;    // m: length of those on the thick veins; 0 = none; only of a blade
    float wear;          // 0..1: holes and bites; only of a blade
    float spots;         // 0..1: dead spots and yellow patches; only of a blade
    float autumn;        // 0..1: how far the blade has turned; only of a blade
    float curl;          // degrees that the blade bends back along its length
    float fold;          // degrees that each half folds up about the midrib
    bool blade;          // with the blade between the veins
} VenationParams;

enum { VENATION_VEINS, VENATION_BLADE }; // roles of materials

VenationParams venation_params_default(void); // closed, 0.1 m

// Fills in numbers that are 0, in proportion to the others.
VenationParams venation_params_resolve(const VenationParams *given);

// The same of a leaf that has grown, with the key of its outline.
VenationParams venation_params_of(const VenationParams *given, const OutTree *tree);

// The recipe (see recipe.h). Grows the veins flat in the plane z = 0, the base at the origin: the
// geometry bends and places them. Nodes below the base are the petiole's. Measures areoles (meshes
// of the net; 0 in open venation), areole_area in mm^2 (of the blade, a mesh), vein_density in mm
// of veins to the mm^2 of blade.
bool venation_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool venation_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                     Error *e);
bool venation_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);
bool venation_measure(const void *params, const Grown *grown, const Recipe *recipe,
                      MeasureList *list, Error *e);

// The veins as a texture for leaves: their relief, 0 between veins and 1 in the middle of the
// midrib, as width x height pixels row by row from the tip. The blade fills the whole width of
// every row, as the uv of leaf meshes does. pixel: width * height floats.
bool venation_paint(const void *params, const OutTree *tree, int width, int height, float *pixel,
                    Error *e);

extern const struct Table venation_table; // of its parameters

#endif
