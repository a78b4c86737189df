// The papers' guide field: away from the nearest nucleus, turned about a normal by a quaternion
// (Tanaka et al., eq. (9)-(12); 003 eq. (9)-(15)).
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

// X_f at p, unit (zero at a nucleus). n: the surface normal there, used when params->surface.
Vec3 nuclei_at(const Nuclei *nuclei, const FieldParams *params, Vec3 p, Vec3 n);

#endif
