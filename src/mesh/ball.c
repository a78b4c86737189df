#include "mesh/ball.h"

#include "base/exact_math.h"

#include <stddef.h>

static void add_face(Mesh *mesh, int64_t *face, int a, int b, int c)
{
    uint32_t *corner = mesh->index + 3 * (*face)++;
    corner[0] = (uint32_t)a;
    corner[1] = (uint32_t)b;
    corner[2] = (uint32_t)c;
}

Mesh *ball_mesh(int rings, Error *e)
{
    int around = 2 * rings, last = around * (rings - 1) + 1;
    Mesh *mesh = mesh_new(3, last + 1, 2 * (int64_t)around * (rings - 1), MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    mesh->position[0] = vec3(0, 1, 0);
    mesh->position[last] = vec3(0, -1, 0);
    for (int r = 1; r < rings; r++) {
        float across, up;
        exact_sincos(PI_F * (float)r / (float)rings, &across, &up);
        for (int k = 0; k < around; k++) {
            float s, c;
            exact_sincos(2.0f * PI_F * (float)k / (float)around, &s, &c);
            mesh->position[1 + (r - 1) * around + k] = vec3(across * s, up, across * c);
        }
    }
    int64_t face = 0;
    for (int k = 0; k < around; k++) {
        int next = (k + 1) % around;
        add_face(mesh, &face, 0, 1 + k, 1 + next);
        for (int r = 0; r + 2 < rings; r++) {
            int here = 1 + r * around, below = here + around;
            add_face(mesh, &face, here + k, below + k, below + next);
            add_face(mesh, &face, here + k, below + next, here + next);
        }
        add_face(mesh, &face, last, last - around + next, last - around + k);
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        mesh->normal[i] = mesh->position[i];
    }
    return mesh;
}
