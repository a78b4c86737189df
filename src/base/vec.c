#include "base/vec.h"

#include "base/exact_math.h"

Transform transform_multiply(const Transform *a, const Transform *b)
{
    Transform r;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            r.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                        a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0.0f);
        }
    }
    return r;
}

bool transform_inverse(const Transform *t, Transform *inverse)
{
    Vec3 x = vec3(t->m[0][0], t->m[1][0], t->m[2][0]);
    Vec3 y = vec3(t->m[0][1], t->m[1][1], t->m[2][1]);
    Vec3 z = vec3(t->m[0][2], t->m[1][2], t->m[2][2]);
    Vec3 origin = vec3(t->m[0][3], t->m[1][3], t->m[2][3]);
    float determinant = vec3_dot(x, vec3_cross(y, z));
    if (!(fabsf(determinant) > 0.0f) || !isfinite(determinant)) {
        return false;
    }
    Vec3 rows[3] = {vec3_cross(y, z), vec3_cross(z, x), vec3_cross(x, y)};
    for (int i = 0; i < 3; i++) {
        Vec3 row = vec3_scale(rows[i], 1.0f / determinant);
        inverse->m[i][0] = row.x;
        inverse->m[i][1] = row.y;
        inverse->m[i][2] = row.z;
        inverse->m[i][3] = -vec3_dot(row, origin);
    }
    return true;
}

static Transform rotation_about(int axis, float degrees)
{
    float s, c;
    exact_sincos(degrees * RADIANS_PER_DEGREE, &s, &c);
    int j = (axis + 1) % 3, k = (axis + 2) % 3;
    Transform r = transform_identity();
    r.m[j][j] = c;
    r.m[j][k] = -s;
    r.m[k][j] = s;
    r.m[k][k] = c;
    return r;
}

Transform transform_compose(Vec3 translate, Vec3 rotate_degrees, Vec3 scale)
{
    Transform r = transform_identity();
    r.m[0][0] = scale.x;
    r.m[1][1] = scale.y;
    r.m[2][2] = scale.z;
    float degrees[3] = {rotate_degrees.x, rotate_degrees.y, rotate_degrees.z};
    for (int axis = 0; axis < 3; axis++) {
        Transform turn = rotation_about(axis, degrees[axis]);
        r = transform_multiply(&turn, &r);
    }
    r.m[0][3] = translate.x;
    r.m[1][3] = translate.y;
    r.m[2][3] = translate.z;
    return r;
}

Aabb aabb_transform(Aabb box, const Transform *t)
{
    Aabb out = aabb_empty();
    for (int corner = 0; corner < 8; corner++) {
        Vec3 p = vec3(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                      corner & 4 ? box.high.z : box.low.z);
        out = aabb_add(out, transform_point(t, p));
    }
    return out;
}
