#include "objects/mesh/bend.h"

#include "base/exact_math.h"

// A point of the curve: along and aside of the straight axis, and its turn toward +z.
typedef struct BentAxis {
    float x, z, sine, cosine;
} BentAxis;

// At the distance s >= 0 from the middle, on the arc that turns by `angle` (radians) over `length`.
static BentAxis bent_axis(float s, float length, float angle)
{
    BentAxis at = {.x = s};
    float turn = angle * s / length;
    exact_sincos(turn, &at.sine, &at.cosine);
    if (fabsf(turn) > 1e-3f) {
        at.x = s * at.sine / turn;
        at.z = s * (1.0f - at.cosine) / turn;
    } else {
        at.z = 0.5f * s * turn;
    }
    return at;
}

void mesh_bend(Mesh *mesh, float front, float back)
{
    Aabb box = mesh_bounds(mesh);
    float half = 0.5f * (box.high.x - box.low.x), middle = box.low.x + half;
    if ((front == 0.0f && back == 0.0f) || !(half > 0.0f)) {
        return;
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        float way = p.x < middle ? -1.0f : 1.0f;
        float angle = (way < 0.0f ? back : front) * RADIANS_PER_DEGREE;
        BentAxis at = bent_axis(way * (p.x - middle), half, angle);
        float sine = way * at.sine; // of the turn that carries +x toward +z
        mesh->position[i] = vec3(middle + way * at.x - sine * p.z, p.y, at.z + at.cosine * p.z);
        if (mesh->normal) {
            Vec3 n = mesh->normal[i];
            mesh->normal[i] = vec3(at.cosine * n.x - sine * n.z, n.y, sine * n.x + at.cosine * n.z);
        }
    }
}
