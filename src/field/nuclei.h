// Guide field of nuclei: away from the nearest nucleus, rotated about a normal by a quaternion
// (Tanaka eq. (9)-(12); Tanaka report eq. (9)-(15)).
#ifndef RAMIFY_FIELD_NUCLEI_H
#define RAMIFY_FIELD_NUCLEI_H

#include "field/guide_field.h"

typedef struct Nuclei {
    Vec3 *position, *normal; // owned
    int64_t count;
    Aabb bounds; // of the attractors
} Nuclei;

bool nuclei_init(Nuclei *nuclei, const Vec3 *position, const Vec3 *normal, int64_t count,
                 Aabb bounds, Error *e);
void nuclei_free(Nuclei *nuclei);

// X_f at p, unit (zero at a nucleus). n: the surface normal at p, used if params->surface.
Vec3 nuclei_at(const Nuclei *nuclei, const FieldParams *params, Vec3 p, Vec3 n);

#endif
