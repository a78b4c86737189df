// Guide field of nuclei: away from the nearest nucleus, rotated about a normal by a quaternion
// (Tanaka eq. (9)-(12); Tanaka report eq. (9)-(15)).
#ifndef RAMIFY_FIELD_NUCLEI_H
#define RAMIFY_FIELD_NUCLEI_H

#include "field/guide_field.h"
#include "field/point_tree.h"

typedef struct NucleusLine {
    Vec3 from, to, normal;
} NucleusLine;

typedef struct Nuclei {
    PointTree points;
    Vec3 *normal;      // of the points; owned
    NucleusLine *line; // owned
    int line_count;
    Aabb bounds; // of the attractors
} Nuclei;

// Points with their normals; normal: NULL = +Y.
bool nuclei_init(Nuclei *nuclei, const Vec3 *position, const Vec3 *normal, int64_t count,
                 Aabb bounds, Error *e);

// Named nuclei. A surface becomes evenly spaced points.
bool nuclei_init_named(Nuclei *nuclei, const Nucleus *nucleus, int count, Aabb bounds,
                       const Run *run, Error *e);

void nuclei_free(Nuclei *nuclei);

// X_f at p, unit (zero at a nucleus). n: the surface normal at p, used if params->surface.
Vec3 nuclei_at(const Nuclei *nuclei, const FieldParams *params, Vec3 p, Vec3 n);

#endif
