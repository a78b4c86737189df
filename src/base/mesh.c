#include "base/mesh.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/strata.h"
#include "base/waves.h"

#include <stdlib.h>
#include <string.h>

Mesh *mesh_new(int face_size, int64_t vertex_count, int64_t face_count, int arrays, Error *e)
{
    if (vertex_count < 0 || vertex_count > UINT32_MAX) {
        error_set(e, ERROR_MEMORY, "a mesh of %lld vertices; fewer than 2^32 are possible",
                  (long long)vertex_count);
        return NULL;
    }
    Mesh *mesh = memory_alloc_zero(1, sizeof *mesh, e);
    if (!mesh) {
        return NULL;
    }
    mesh->face_size = face_size;
    mesh->vertex_count = vertex_count;
    mesh->face_count = face_count;
    mesh->index = memory_alloc_zero(face_count, sizeof(uint32_t) * (size_t)face_size, e);
    mesh->position = memory_alloc_zero(vertex_count, sizeof(Vec3), e);
    bool made = mesh->index && mesh->position;
    if (made && (arrays & MESH_NORMAL)) {
        made = (mesh->normal = memory_alloc_zero(vertex_count, sizeof(Vec3), e));
    }
    if (made && (arrays & MESH_UV)) {
        made = (mesh->uv = memory_alloc_zero(vertex_count, sizeof(Vec2), e));
    }
    if (made && (arrays & MESH_RADIUS)) {
        made = (mesh->radius = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (made && (arrays & MESH_BIRTH)) {
        made = (mesh->birth = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (made && (arrays & MESH_SITE)) {
        made = (mesh->site = memory_alloc_zero(vertex_count, sizeof(Vec2), e));
    }
    if (made && (arrays & MESH_FOAM)) {
        made = (mesh->foam = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (made && (arrays & MESH_SHORE_ARRAY)) {
        made = (mesh->shore = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (made && (arrays & MESH_YOUNG)) {
        made = (mesh->young = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (made && (arrays & MESH_WITHERED)) {
        made = (mesh->withered = memory_alloc_zero(vertex_count, sizeof(float), e));
    }
    if (!made) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

void mesh_free(Mesh *mesh)
{
    if (mesh) {
        free(mesh->index);
        free(mesh->position);
        free(mesh->normal);
        free(mesh->uv);
        free(mesh->radius);
        free(mesh->birth);
        free(mesh->site);
        free(mesh->foam);
        free(mesh->shore);
        free(mesh->young);
        free(mesh->withered);
        strata_free(mesh->strata);
        waves_free(mesh->waves);
        free(mesh);
    }
}

Aabb mesh_bounds(const Mesh *mesh)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        box = aabb_add(box, mesh->position[i]);
    }
    return box;
}

bool mesh_compute_normals(Mesh *mesh, Error *e)
{
    if (!mesh->normal) {
        mesh->normal = memory_alloc(mesh->vertex_count, sizeof(Vec3), e);
        if (!mesh->normal) {
            return false;
        }
    }
    memset(mesh->normal, 0, sizeof(Vec3) * (size_t)mesh->vertex_count);
    int n = mesh->face_size;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * n;
        for (int k = 0; k < n; k++) {
            Vec3 here = mesh->position[corner[k]];
            Vec3 ahead = vec3_sub(mesh->position[corner[(k + 1) % n]], here);
            Vec3 back = vec3_sub(mesh->position[corner[(k + n - 1) % n]], here);
            Vec3 across = vec3_cross(ahead, back);
            float sine = vec3_length(across);
            if (sine > 0.0f) {
                float weight = exact_atan2(sine, vec3_dot(ahead, back)) / sine;
                mesh->normal[corner[k]] = vec3_madd(mesh->normal[corner[k]], weight, across);
            }
        }
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 unit = vec3_normalize(mesh->normal[i]);
        mesh->normal[i] = vec3_dot(unit, unit) > 0.0f ? unit : vec3(0, 1, 0);
    }
    return true;
}

static void turn_faces_round(Mesh *mesh)
{
    int n = mesh->face_size;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        uint32_t *corner = mesh->index + f * n;
        uint32_t swapped = corner[1];
        corner[1] = corner[n - 1];
        corner[n - 1] = swapped;
    }
}

bool mesh_transform(Mesh *mesh, const Transform *t, Error *e)
{
    Transform inverse;
    if (!transform_inverse(t, &inverse)) {
        return error_set(e, ERROR_INPUT,
                         "the transform flattens the mesh; no scale may be 0 on any axis");
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        mesh->position[i] = transform_point(t, mesh->position[i]);
        if (mesh->normal) {
            mesh->normal[i] = vec3_normalize(transform_normal(&inverse, mesh->normal[i]));
        }
    }
    if (transform_determinant(t) < 0.0f) {
        turn_faces_round(mesh);
    }
    return true;
}
