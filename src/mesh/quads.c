#include "mesh/quads.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

uint32_t quads_vertex(Quads *quads, Vec3 position, Vec2 uv)
{
    int64_t v = quads->vertex_count;
    if (quads->failed ||
        !memory_reserve(&quads->position, &quads->position_capacity, v + 1, sizeof *quads->position,
                        quads->e) ||
        !memory_reserve(&quads->uv, &quads->uv_capacity, v + 1, sizeof *quads->uv, quads->e) ||
        (quads->ages && !memory_reserve(&quads->youth, &quads->youth_capacity, v + 1,
                                        sizeof *quads->youth, quads->e))) {
        quads->failed = true;
        return 0;
    }
    quads->position[v] = quads->place ? transform_point(quads->place, position) : position;
    quads->uv[v] = uv;
    if (quads->ages) {
        quads->youth[v] = quads->young;
    }
    quads->vertex_count++;
    return (uint32_t)v;
}

void quads_face(Quads *quads, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    int64_t first = 4 * quads->face_count;
    if (quads->failed || !memory_reserve(&quads->index, &quads->index_capacity, first + 4,
                                         sizeof *quads->index, quads->e)) {
        quads->failed = true;
        return;
    }
    uint32_t *corner = quads->index + first;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    corner[3] = d;
    quads->face_count++;
}

void quads_grid(Quads *quads, uint32_t first, int rows, int columns)
{
    for (int r = 0; r + 1 < rows; r++) {
        for (int c = 0; c + 1 < columns; c++) {
            uint32_t v = first + (uint32_t)(r * columns + c), up = v + (uint32_t)columns;
            quads_face(quads, v, v + 1, up + 1, up);
        }
    }
}

// Faces between rings of `sides` vertices.
static void join_rings(Quads *quads, uint32_t first, int count, int sides)
{
    for (int i = 0; i + 1 < count; i++) {
        uint32_t ring = first + (uint32_t)(i * sides), next = ring + (uint32_t)sides;
        for (int k = 0; k < sides; k++) {
            uint32_t a = (uint32_t)k, b = (uint32_t)((k + 1) % sides);
            quads_face(quads, ring + a, next + a, next + b, ring + b);
        }
    }
}

void quads_tube(Quads *quads, const Vec3 *axis, const float *radius, int count, int sides, Vec2 uv)
{
    uint32_t first = (uint32_t)quads->vertex_count;
    Vec3 side = vec3(0, 0, 0);
    for (int i = 0; i < count; i++) {
        Vec3 along =
            vec3_normalize(vec3_sub(axis[i + 1 < count ? i + 1 : i], axis[i > 0 ? i - 1 : i]));
        side = vec3_madd(side, -vec3_dot(side, along), along);
        side = vec3_dot(side, side) > 1e-6f ? vec3_normalize(side) : vec3_perpendicular(along);
        Vec3 other = vec3_cross(side, along);
        for (int k = 0; k < sides; k++) {
            float sine, cosine;
            exact_sincos(2.0f * PI_F * (float)k / (float)sides, &sine, &cosine);
            Vec3 p = vec3_madd(axis[i], radius[i] * cosine, side);
            quads_vertex(quads, vec3_madd(p, radius[i] * sine, other), uv);
        }
    }
    join_rings(quads, first, count, sides);
}

void quads_revolve(Quads *quads, const Vec2 *profile, int count, int sides)
{
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < sides; k++) {
            float u = (float)k / (float)sides, sine, cosine;
            exact_sincos(2.0f * PI_F * u, &sine, &cosine);
            quads_vertex(quads, vec3(profile[i].x * cosine, profile[i].y, profile[i].x * sine),
                         (Vec2){u, (float)i / (float)(count - 1)});
        }
    }
    join_rings(quads, first, count, sides);
}

void quads_clear(Quads *quads)
{
    free(quads->position);
    free(quads->uv);
    free(quads->youth);
    free(quads->index);
    *quads = (Quads){.e = quads->e, .failed = quads->failed};
}

Mesh *quads_mesh(Quads *quads)
{
    int arrays = MESH_NORMAL | MESH_UV | (quads->ages ? MESH_YOUNG : 0);
    Mesh *mesh = quads->failed
                     ? NULL
                     : mesh_new(4, quads->vertex_count, quads->face_count, arrays, quads->e);
    if (mesh) {
        size_t vertices = (size_t)quads->vertex_count;
        memcpy(mesh->position, quads->position, vertices * sizeof *mesh->position);
        memcpy(mesh->uv, quads->uv, vertices * sizeof *mesh->uv);
        if (mesh->young) {
            memcpy(mesh->young, quads->youth, vertices * sizeof *mesh->young);
        }
        memcpy(mesh->index, quads->index, 4 * (size_t)quads->face_count * sizeof *mesh->index);
    }
    quads_clear(quads);
    if (mesh && !mesh_compute_normals(mesh, quads->e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
