#include "shape/deformation.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "shape/import.h"
#include "shape/mean_value.h"

#include <stdlib.h>
#include <string.h>

typedef struct Deform {
    DeformKind kind;
    Vec3 pivot;
    Transform affine;        // about the pivot
    Vec3 axis, toward, side; // unit, right-handed
    float angle, length;     // radians, m
    Mesh *rest, *posed;      // owned
} Deform;

struct Deformation {
    Deform *deform;
    int count;
};

// ---- making

static Transform affine_of(const DeformParams *p)
{
    Transform turn = transform_compose(p->move, p->rotation, vec3_splat(1));
    Transform shear = transform_identity();
    shear.m[0][1] = p->shear.x;
    shear.m[0][2] = p->shear.y;
    shear.m[1][2] = p->shear.z;
    Transform scale = transform_compose(vec3_splat(0), vec3_splat(0), p->scale);
    Transform both = transform_multiply(&shear, &scale);
    return transform_multiply(&turn, &both);
}

static Mesh *read_closed(const char *file, const char *key, int number, const Run *run, Error *e)
{
    MeshTopology topology;
    Mesh *mesh = mesh_import(file, run, e);
    if (mesh && mesh_topology(mesh, &topology, e) &&
        (topology.open_edges == 0 && topology.overused_edges == 0)) {
        return mesh;
    }
    if (mesh && e && e->code == ERROR_NONE) {
        error_set(e, ERROR_INPUT,
                  "the mesh has %lld open edges; only a closed mesh carries what is in and around "
                  "it",
                  (long long)topology.open_edges + (long long)topology.overused_edges);
    }
    mesh_free(mesh);
    error_key(e, "%d.%s", number, key);
    return NULL;
}

static bool read_meshes(Deform *deform, const DeformParams *p, int number, const Run *run, Error *e)
{
    deform->rest = read_closed(p->rest, "rest", number, run, e);
    deform->posed = deform->rest ? read_closed(p->posed, "posed", number, run, e) : NULL;
    const Mesh *a = deform->rest, *b = deform->posed;
    if (!a || !b) {
        return false;
    }
    if (a->vertex_count == b->vertex_count && a->face_count == b->face_count &&
        memcmp(a->index, b->index, sizeof *a->index * 3 * (size_t)a->face_count) == 0) {
        return true;
    }
    error_set(e, ERROR_INPUT,
              "the meshes do not match: %lld vertices and %lld faces at rest, %lld and %lld posed; "
              "they must have the same vertices in the same order",
              (long long)a->vertex_count, (long long)a->face_count, (long long)b->vertex_count,
              (long long)b->face_count);
    return error_key(e, "%d.posed", number);
}

static bool prepare(Deform *deform, const DeformParams *p, int number, const Run *run, Error *e)
{
    *deform = (Deform){.kind = p->kind,
                       .pivot = p->pivot,
                       .affine = affine_of(p),
                       .axis = vec3_normalize(p->axis),
                       .angle = p->angle * RADIANS_PER_DEGREE,
                       .length = p->length};
    Vec3 across = vec3_madd(p->toward, -vec3_dot(p->toward, deform->axis), deform->axis);
    deform->toward =
        vec3_dot(across, across) > 0.0f ? vec3_normalize(across) : vec3_perpendicular(deform->axis);
    deform->side = vec3_cross(deform->axis, deform->toward);
    return p->kind != DEFORM_MESH || read_meshes(deform, p, number, run, e);
}

Deformation *deformation_new(const DeformParams *params, int count, const Run *run, Error *e)
{
    Deformation *made = memory_alloc_zero(1, sizeof *made, e);
    bool done = made && (made->deform = memory_alloc_zero(count, sizeof *made->deform, e));
    for (int i = 0; done && i < count; i++) {
        made->count++;
        done = prepare(&made->deform[i], &params[i], i, run, e);
    }
    if (!done) {
        deformation_free(made);
        return NULL;
    }
    return made;
}

void deformation_free(Deformation *deformation)
{
    if (deformation) {
        for (int i = 0; deformation->deform && i < deformation->count; i++) {
            mesh_free(deformation->deform[i].rest);
            mesh_free(deformation->deform[i].posed);
        }
        free(deformation->deform);
        free(deformation);
    }
}

// ---- carrying

// The axis becomes an arc that keeps its length; what is beside it keeps its distance from it.
static Vec3 bend(const Deform *d, Vec3 p)
{
    Vec3 from = vec3_sub(p, d->pivot);
    float along = vec3_dot(from, d->axis), out = vec3_dot(from, d->toward);
    float turned = clampf(along, 0.0f, d->length), s, c;
    float curvature = d->angle / d->length, beyond = along - turned;
    exact_sincos(curvature * turned, &s, &c);
    bool straight = fabsf(curvature * d->length) < 1e-6f;
    float rise = straight ? turned : s / curvature;
    float lean = straight ? 0.0f : (1.0f - c) / curvature;
    // the tangent is (c axis + s toward), the outward normal (c toward - s axis)
    Vec3 q = vec3_madd(d->pivot, rise + beyond * c - out * s, d->axis);
    q = vec3_madd(q, lean + beyond * s + out * c, d->toward);
    return vec3_madd(q, vec3_dot(from, d->side), d->side);
}

static Vec3 twist(const Deform *d, Vec3 p)
{
    Vec3 from = vec3_sub(p, d->pivot);
    float along = vec3_dot(from, d->axis), x = vec3_dot(from, d->toward),
          y = vec3_dot(from, d->side), s, c;
    exact_sincos(d->angle * clampf(along / d->length, 0.0f, 1.0f), &s, &c);
    Vec3 q = vec3_madd(d->pivot, along, d->axis);
    q = vec3_madd(q, c * x - s * y, d->toward);
    return vec3_madd(q, s * x + c * y, d->side);
}

Vec3 deformation_carry(const Deformation *deformation, Vec3 p)
{
    for (int i = 0; i < deformation->count; i++) {
        const Deform *d = &deformation->deform[i];
        switch (d->kind) {
        case DEFORM_AFFINE:
            p = vec3_add(d->pivot, transform_point(&d->affine, vec3_sub(p, d->pivot)));
            break;
        case DEFORM_BEND:
            p = bend(d, p);
            break;
        case DEFORM_TWIST:
            p = twist(d, p);
            break;
        case DEFORM_MESH:
            p = mean_value_carry(d->rest, d->posed, p);
            break;
        }
    }
    return p;
}
