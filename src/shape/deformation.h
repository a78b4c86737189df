// Deformations of space that carry what grew at rest: affine maps, bends, twists, and the motion of
// a mesh.
#ifndef RAMIFY_SHAPE_DEFORMATION_H
#define RAMIFY_SHAPE_DEFORMATION_H

#include "base/error.h"
#include "base/run.h"
#include "base/vec.h"

typedef enum DeformKind {
    DEFORM_AFFINE, // about the pivot: scaled, sheared, rotated, then moved
    DEFORM_BEND,   // along the axis from the pivot on: a circular arc over `length`, then straight
    DEFORM_TWIST,  // about the axis: by `angle` over `length`, then constant
    DEFORM_MESH    // as the vertices of mesh `rest` move to those of `posed`
} DeformKind;

typedef struct DeformParams {
    DeformKind kind;
    Vec3 pivot;    // m
    Vec3 rotation; // degrees, about x, then y, then z
    Vec3 scale;
    Vec3 shear;               // x by y, x by z, y by z
    Vec3 move;                // m
    Vec3 axis, toward;        // any length; toward: where a bend leans
    float angle;              // degrees
    float length;             // m
    const char *rest, *posed; // files; borrowed
} DeformParams;

typedef struct Deformation Deformation;

// Prepares the deformations of a list, applied in order. ERROR_INPUT for meshes that cannot be
// read, are not closed or do not match; the error's key names the entry.
Deformation *deformation_new(const DeformParams *params, int count, const Run *run, Error *e);
void deformation_free(Deformation *deformation); // NULL is fine

// Where the point goes. Thread-safe.
Vec3 deformation_carry(const Deformation *deformation, Vec3 p);

#endif
