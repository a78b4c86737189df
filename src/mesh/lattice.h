// Skins any graph of round bars (an out-tree, or one with loops) with one smooth closed surface,
// through a level set: bars that meet flow into each other. For what skin.h cannot do because it is
// no tree.
#ifndef RAMIFY_MESH_LATTICE_H
#define RAMIFY_MESH_LATTICE_H

#include "base/mesh.h"
#include "base/run.h"
#include "outtree/out_tree.h"

// A bar from a to b whose radius runs evenly from radius_a to radius_b. m.
typedef struct Bar {
    Vec3 a, b;
    float radius_a, radius_b;
} Bar;

typedef struct Lattice {
    Bar *bar; // owned
    int64_t count, capacity;
} Lattice;

bool lattice_add(Lattice *lattice, Bar bar, Error *e);

// A bar for every node with a parent, radii as the tree has them; a ball for a root without
// children.
bool lattice_add_tree(Lattice *lattice, const OutTree *tree, Error *e);
void lattice_clear(Lattice *lattice);

// The union of the bars as a closed surface with normals. voxel: m; bars thinner than about 1.5
// voxels in radius are lost. smoothing: steps of Laplacian flow that round off where bars meet;
// radii are enlarged beforehand by what the flow takes from a cylinder. Errors: those of
// level_set_fits, ERROR_CANCELLED.
Mesh *lattice_surface(const Lattice *lattice, float voxel, int smoothing, const Run *run, Error *e);

#endif
