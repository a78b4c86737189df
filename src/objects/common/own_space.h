// The object's own space, in which it grows: its foot, or its envelope's first shape, is at the
// origin and not rotated. Growth and meshes are transformed into the scene afterwards, so an object
// does not depend on its place in the scene: noise, level sets, guide fields and rounding are the
// same everywhere.
#ifndef RAMIFY_OBJECTS_COMMON_OWN_SPACE_H
#define RAMIFY_OBJECTS_COMMON_OWN_SPACE_H

#include "config/node.h"
#include "mesh/geometry.h"
#include "objects/common/element.h"

typedef struct Kind Kind; // see objects/kind.h

// Begins with own_space_enter, ends with own_space_leave.
typedef struct OwnSpace {
    const void *params; // in the object's own space
    Transform to_scene; // a rotation and a translation
    bool moved;         // false: its own space is the scene space
    Arena *arena;       // owns the copied arrays of params; NULL = none
} OwnSpace;

// Transforms the parameters of an object of the kind into its own space.
bool own_space_enter(OwnSpace *own, const Kind *kind, const void *params, Error *e);
void own_space_leave(OwnSpace *own); // frees the copied arrays of params

// Transforms an out-tree (NULL is fine), or the parts of geometry from number first on, from the
// object's own space into the scene. ERROR_INPUT if single precision is too coarse at that distance
// from the origin to keep the shape.
bool own_space_carry_tree(const OwnSpace *own, OutTree *tree, Error *e);
bool own_space_carry_parts(const OwnSpace *own, Geometry *geometry, int64_t first, Error *e);

// ---- for kinds: which of their parameters are places (Kind.own_space)

// Sets the origin to the foot at `place`, rotated about x, then y, then z (degrees). Call first.
void own_space_stand(OwnSpace *own, Vec3 place, Vec3 rotation);

// Sets the origin to that of the first shape of an element's envelope, with its rotation about Y
// alone, so that up stays up. Scene space if there is no shape or if attractors are anchored in
// space. Call first.
void own_space_of_element(OwnSpace *own, const ElementParams *element);
void own_space_of_shapes(OwnSpace *own, const Shape *shapes, int count);

// A copy of an array, owned by own. NULL and e if memory is short.
void *own_space_copy(OwnSpace *own, const void *of, size_t size, Error *e);

// A place, direction or azimuth (degrees, from +Z toward +X) of the scene in the object's own
// space; the azimuth only if that is rotated about Y alone.
Vec3 own_space_place(const OwnSpace *own, Vec3 place);
Vec3 own_space_direction(const OwnSpace *own, Vec3 direction);
float own_space_azimuth(const OwnSpace *own, float degrees);

// Transforms the shapes of an envelope, or all places of an element, into the object's own space:
// *shapes and the element's arrays become copies.
bool own_space_take_shapes(OwnSpace *own, Shape **shapes, int count, Error *e);
bool own_space_take_element(OwnSpace *own, ElementParams *element, Error *e);

#endif
