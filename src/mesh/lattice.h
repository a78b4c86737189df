// Skins a graph of round bars (an out-tree, or one with loops) with one smooth closed surface,
// through a level set: bars blend where they meet. For graphs with loops, which skin.h does not
// support.
#ifndef RAMIFY_MESH_LATTICE_H
#define RAMIFY_MESH_LATTICE_H

#include "base/mesh.h"
#include "base/run.h"
#include "outtree/out_tree.h"

// A bar from a to b whose radius is interpolated linearly from radius_a to radius_b. m.
typedef struct Bar {
    Vec3 a, b;
    float radius_a, radius_b;
} Bar;

typedef struct Lattice {
    Bar *bar; // owned
    int64_t count, capacity;
} Lattice;

bool lattice_add(Lattice *lattice, Bar bar, Error *e);

// Adds a bar for every node with a parent, with the tree's radii; a ball for a root without
// children.
bool lattice_add_tree(Lattice *lattice, const OutTree *tree, Error *e);
void lattice_clear(Lattice *lattice);

// Builds the union of the bars as a closed surface with normals. voxel: m; bars below about 1.5
// voxels in radius vanish. smoothing: steps of Laplacian flow that round the junctions; radii are
// enlarged beforehand by what the flow takes from a cylinder. Errors: those of level_set_fits;
// ERROR_CANCELLED. The caller frees the mesh with mesh_free.
Mesh *lattice_surface(const Lattice *lattice, float voxel, int smoothing, const Run *run, Error *e);

#endif
