#include "shape/mesh_nearest.h"

#include "base/triangle.h"

#include <math.h>

bool mesh_nearest(const Mesh *mesh, Vec3 *p, Vec3 *normal)
{
    float best = INFINITY;
    Vec3 nearest = *p;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        for (int k = 1; k + 1 < mesh->face_size; k++) {
            Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[k]],
                 c = mesh->position[corner[k + 1]];
            Vec3 at = triangle_nearest(a, b, c, *p);
            float distance = vec3_distance(at, *p);
            Vec3 out = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
            if (distance < best && vec3_dot(out, out) > 0.0f) {
                best = distance;
                nearest = at;
                *normal = vec3_normalize(out);
            }
        }
    }
    *p = nearest;
    return best < INFINITY;
}
