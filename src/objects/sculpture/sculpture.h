// Hollow branch sculptures (Tanaka et al., section 2.4 and figure 22; after the shrub-branch shells
// of Zhang et al.): several clusters grow over an envelope's surface and merge where they meet,
// into one shell of round bars.
#ifndef RAMIFY_OBJECTS_SCULPTURE_SCULPTURE_H
#define RAMIFY_OBJECTS_SCULPTURE_SCULPTURE_H

#include "objects/common/element.h"
#include "objects/common/recipe.h"

typedef struct SculptureParams {
    ElementParams element; // its envelope is the form; attractors lie on the surface
    int clusters;          // roots, spread evenly over the surface
    int64_t attractors;    // fineness of the shell if growth.levels are omitted
    float thickness;       // of the thinnest bars, mean spacings of the finest attractors
    float contrast;        // thickest bar over thinnest
    float reach;           // reach of merging tips, mean spacings
} SculptureParams;

SculptureParams sculpture_params_default(void); // a ball of 1 m radius, 9 clusters

// The recipe (see recipe.h). Grows the clusters with radii and merges them; outtree/join.h
// describes how an out-tree represents loops. The geometry is one surface of the one material.
bool sculpture_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool sculpture_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table sculpture_table; // of its parameters

#endif
