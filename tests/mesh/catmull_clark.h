// Catmull-Clark by the book (Catmull and Clark 1978), slow and plain, for closed quad meshes: the
// yardstick for the library's refinement.
#ifndef RAMIFY_TESTS_CATMULL_CLARK_H
#define RAMIFY_TESTS_CATMULL_CLARK_H

#include "base/mesh.h"
#include "testing.h"

#include <string.h>

// The number of the edge between two vertices in a growing list.
static inline int64_t book_edge(uint32_t (*edge)[2], int64_t *count, uint32_t a, uint32_t b)
{
    for (int64_t i = 0; i < *count; i++) {
        if ((edge[i][0] == a && edge[i][1] == b) || (edge[i][0] == b && edge[i][1] == a)) {
            return i;
        }
    }
    edge[*count][0] = a;
    edge[*count][1] = b;
    return (*count)++;
}

// The vertex rule: (F + 2 R + (n - 3) P) / n, or the limit (n^2 P + 4 sum e + sum f) / (n (n + 5)).
static inline Vec3 *book_vertices(const Mesh *mesh, bool limit)
{
    Vec3 *out = calloc((size_t)mesh->vertex_count, sizeof *out);
    assert_non_null(out);
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        Vec3 p = mesh->position[v], next = vec3(0, 0, 0), far = next, faces = next;
        float n = 0.0f;
        for (int64_t i = 0; i < 4 * mesh->face_count; i++) {
            if (mesh->index[i] != (uint32_t)v) {
                continue;
            }
            const uint32_t *c = mesh->index + i / 4 * 4;
            Vec3 a = mesh->position[c[(i + 1) % 4]], b = mesh->position[c[(i + 2) % 4]];
            Vec3 d = mesh->position[c[(i + 3) % 4]];
            next = vec3_add(next, a); // every neighbour is next in exactly one face
            far = vec3_add(far, b);
            faces = vec3_madd(faces, 0.25f, vec3_add(vec3_add(p, a), vec3_add(b, d)));
            n += 1.0f;
        }
        if (limit) {
            out[v] = vec3_scale(p, n / (n + 5));
            out[v] = vec3_madd(out[v], 4 / (n * (n + 5)), next);
            out[v] = vec3_madd(out[v], 1 / (n * (n + 5)), far);
        } else {
            Vec3 edges = vec3_madd(vec3_scale(next, 0.5f), 0.5f * n, p); // n R
            out[v] = vec3_scale(p, (n - 3) / n);
            out[v] = vec3_madd(out[v], 2 / (n * n), edges);
            out[v] = vec3_madd(out[v], 1 / (n * n), faces);
        }
    }
    return out;
}

static inline Mesh *book_subdivide(const Mesh *mesh)
{
    int64_t edges = 0, v0 = mesh->vertex_count;
    uint32_t(*edge)[2] = calloc((size_t)mesh->face_count * 4, sizeof *edge);
    int64_t *side = calloc((size_t)mesh->face_count * 4, sizeof *side);
    assert_true(edge && side);
    for (int64_t i = 0; i < 4 * mesh->face_count; i++) {
        side[i] = book_edge(edge, &edges, mesh->index[i], mesh->index[i / 4 * 4 + (i + 1) % 4]);
    }
    Mesh *fine = mesh_new(4, v0 + edges + mesh->face_count, 4 * mesh->face_count, 0, NULL);
    assert_non_null(fine);
    Vec3 *moved = book_vertices(mesh, false);
    memcpy(fine->position, moved, (size_t)v0 * sizeof *moved);
    free(moved);
    for (int64_t i = 0; i < edges; i++) { // (ends + the two faces' points) / 4
        Vec3 ends = vec3_add(mesh->position[edge[i][0]], mesh->position[edge[i][1]]);
        fine->position[v0 + i] = vec3_scale(ends, 0.25f);
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        Vec3 middle = vec3(0, 0, 0);
        for (int k = 0; k < 4; k++) {
            middle = vec3_madd(middle, 0.25f, mesh->position[mesh->index[4 * f + k]]);
        }
        uint32_t centre = (uint32_t)(v0 + edges + f);
        fine->position[centre] = middle;
        for (int k = 0; k < 4; k++) {
            int64_t here = side[4 * f + k], before = side[4 * f + (k + 3) % 4];
            fine->position[v0 + here] = vec3_madd(fine->position[v0 + here], 0.25f, middle);
            uint32_t corner[4] = {mesh->index[4 * f + k], (uint32_t)(v0 + here), centre,
                                  (uint32_t)(v0 + before)};
            memcpy(fine->index + 16 * f + 4 * k, corner, sizeof corner);
        }
    }
    free(edge);
    free(side);
    return fine;
}

#endif
