#include "export/placement.h"

// The quaternion of a rotation given by its columns; from the largest of its parts, so that
// nothing is divided by a small number (Shepperd 1978).
static void quaternion(Vec3 x, Vec3 y, Vec3 z, float out[4])
{
    float w = 1.0f + x.x + y.y + z.z;
    if (w > 1.0f) {
        float r = 0.5f / sqrtf(w);
        out[0] = (y.z - z.y) * r;
        out[1] = (z.x - x.z) * r;
        out[2] = (x.y - y.x) * r;
        out[3] = 0.5f * sqrtf(w);
        return;
    }
    const Vec3 column[3] = {x, y, z};
    int a = y.y > x.x ? 1 : 0;
    a = z.z > (a ? y.y : x.x) ? 2 : a;
    int b = (a + 1) % 3, c = (a + 2) % 3;
    const float m[3][3] = {{column[0].x, column[1].x, column[2].x},
                           {column[0].y, column[1].y, column[2].y},
                           {column[0].z, column[1].z, column[2].z}};
    float root = sqrtf(fmaxf(1.0f + m[a][a] - m[b][b] - m[c][c], 0.0f));
    float r = 0.5f / root;
    out[a] = 0.5f * root;
    out[b] = (m[a][b] + m[b][a]) * r;
    out[c] = (m[a][c] + m[c][a]) * r;
    out[3] = (m[c][b] - m[b][c]) * r;
    for (int i = 0; i < 4 && out[3] < 0.0f; i++) {
        out[i] = -out[i];
    }
}

bool placement_from_transform(const Transform *t, Placement *placement)
{
    Vec3 x = vec3(t->m[0][0], t->m[1][0], t->m[2][0]);
    Vec3 y = vec3(t->m[0][1], t->m[1][1], t->m[2][1]);
    Vec3 z = vec3(t->m[0][2], t->m[1][2], t->m[2][2]);
    Vec3 scale = vec3(vec3_length(x), vec3_length(y), vec3_length(z));
    if (!(scale.x > 0.0f && scale.y > 0.0f && scale.z > 0.0f)) {
        return false;
    }
    scale.x = vec3_dot(x, vec3_cross(y, z)) < 0.0f ? -scale.x : scale.x;
    x = vec3_scale(x, 1.0f / scale.x);
    y = vec3_scale(y, 1.0f / scale.y);
    z = vec3_scale(z, 1.0f / scale.z);
    const float most = 1e-4f; // cosine between axes
    if (fabsf(vec3_dot(x, y)) > most || fabsf(vec3_dot(y, z)) > most ||
        fabsf(vec3_dot(z, x)) > most) {
        return false;
    }
    placement->position = vec3(t->m[0][3], t->m[1][3], t->m[2][3]);
    placement->scale = scale;
    quaternion(x, y, z, placement->rotation);
    float *q = placement->rotation;
    float length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++) {
        q[i] /= length;
    }
    return true;
}
