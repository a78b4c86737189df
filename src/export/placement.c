#include "export/placement.h"

#include "shape/affine.h"

// The quaternion of a rotation given by its columns. Computed from its largest component, so that
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

static void unit_quaternion(Vec3 x, Vec3 y, Vec3 z, float q[4])
{
    quaternion(x, y, z, q);
    float length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++) {
        q[i] /= length;
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
    unit_quaternion(x, y, z, placement->rotation);
    return true;
}

// Of the column of a 3 x 3 matrix.
static Vec3 column_of(const double m[3][3], int k)
{
    return vec3((float)m[0][k], (float)m[1][k], (float)m[2][k]);
}

// The singular value decomposition t = axes * length * turn.
bool placement_of_turned(const Transform *t, float turn[4], Placement *placement)
{
    double m[3][4], axes[3][3], length[3], back[3][3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            m[i][k] = (double)t->m[i][k];
        }
    }
    affine_principal_axes(m, axes, length);
    double most = fmax(length[0], fmax(length[1], length[2]));
    double least = fmin(length[0], fmin(length[1], length[2]));
    if (!(isfinite(most) && least > 1e-5 * most)) {
        return false;
    }
    Vec3 x = column_of(axes, 0), y = column_of(axes, 1), z = column_of(axes, 2);
    double sign = vec3_dot(x, vec3_cross(y, z)) < 0.0f ? -1.0 : 1.0; // makes both factors rotations
    for (int i = 0; i < 3; i++) {
        axes[i][0] *= sign;
    }
    length[0] *= affine_determinant(m) < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            back[i][k] =
                (axes[0][i] * m[0][k] + axes[1][i] * m[1][k] + axes[2][i] * m[2][k]) / length[i];
        }
    }
    placement->position = vec3(t->m[0][3], t->m[1][3], t->m[2][3]);
    placement->scale = vec3((float)length[0], (float)length[1], (float)length[2]);
    unit_quaternion(column_of(axes, 0), y, z, placement->rotation);
    unit_quaternion(column_of(back, 0), column_of(back, 1), column_of(back, 2), turn);
    return true;
}
