// The space that an object grows in: its foot, or its envelope's first shape, stands at the origin
// and is not turned. What grows and is meshed there is carried into the scene afterwards, so an
// object is the same thing wherever the scene puts it: noise, level sets, guide fields and rounding
// do not see the place.
#ifndef RAMIFY_OBJECTS_COMMON_OWN_SPACE_H
#define RAMIFY_OBJECTS_COMMON_OWN_SPACE_H

#include "config/node.h"
#include "mesh/geometry.h"
#include "objects/common/element.h"

typedef struct Kind Kind; // see objects/kind.h

// Begins with own_space_enter, ends with own_space_leave.
typedef struct OwnSpace {
    const void *params; // of the object in its own space
    Transform to_scene; // a turn and a move
    bool moved;         // false: its own space is the scene's
    Arena *arena;       // what params has of its own; NULL = nothing
} OwnSpace;

// The parameters of an object of the kind.
bool own_space_enter(OwnSpace *own, const Kind *kind, const void *params, Error *e);
void own_space_leave(OwnSpace *own); // frees what params has of its own

// Carries what was made in the object's own space into the scene: an out-tree (NULL is fine), the
// parts of geometry from number first on. ERROR_INPUT where single precision is too coarse so far
// from the origin to keep its shape.
bool own_space_carry_tree(const OwnSpace *own, OutTree *tree, Error *e);
bool own_space_carry_parts(const OwnSpace *own, Geometry *geometry, int64_t first, Error *e);

// ---- for kinds, which say what of their parameters is a place (Kind.own_space)

// The foot at this place, turned about x, then y, then z (degrees). Call first.
void own_space_stand(OwnSpace *own, Vec3 place, Vec3 rotation);

// The origin of the first shape of an element's envelope and its turn about Y, since up stays up;
// the scene's space where there is no shape, or where attractors are anchored in space. Call first.
void own_space_of_element(OwnSpace *own, const ElementParams *element);
void own_space_of_shapes(OwnSpace *own, const Shape *shapes, int count);

// A copy of an array that goes with own. NULL and e when memory is short.
void *own_space_copy(OwnSpace *own, const void *of, size_t size, Error *e);

// A place and a direction of the scene in the object's own space; an azimuth (degrees, from +Z
// toward +X) where that is turned about Y only.
Vec3 own_space_place(const OwnSpace *own, Vec3 place);
Vec3 own_space_direction(const OwnSpace *own, Vec3 direction);
float own_space_azimuth(const OwnSpace *own, float degrees);

// Puts the shapes of an envelope, or all that an element knows of space, into the object's own
// space: *shapes and the element's arrays become copies.
bool own_space_take_shapes(OwnSpace *own, Shape **shapes, int count, Error *e);
bool own_space_take_element(OwnSpace *own, ElementParams *element, Error *e);

#endif
