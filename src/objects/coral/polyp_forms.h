// The few meshes of which all cups of a coral are copies, and how each copy stands.
#ifndef RAMIFY_OBJECTS_CORAL_POLYP_FORMS_H
#define RAMIFY_OBJECTS_CORAL_POLYP_FORMS_H

#include "objects/coral/polyps.h"

// A place for a cup.
typedef struct PolypPlace {
    Vec3 position, normal, along; // along: toward the tip; zero when unknown
    float youth;
    float size; // relative to the other cups
    bool axial; // at the end of a branch
} PolypPlace;

// Tubes: by age. Noses: by age and variant; then the same with tentacles; then axial ones.
int polyp_form_count(const PolypPlaces *places);

// The form of a cup with this key of random numbers.
int polyp_form(const PolypPlace *place, const PolypPlaces *places, uint64_t key);

// The caller frees it with mesh_free.
Mesh *polyp_form_mesh(int form, const PolypPlaces *places, Error *e);

// From the mesh to the skin: axis +Y, that of a tube leaned from the normal toward the tip, random
// size.
Transform polyp_frame(const PolypPlace *place, const PolypPlaces *places, uint64_t key);

#endif
