// Small vectors, 3x4 affine transforms and boxes: plain values, single precision, + - * / sqrt
// only, so that results are the same on every machine.
#ifndef RAMIFY_BASE_VEC_H
#define RAMIFY_BASE_VEC_H

#include <math.h>
#include <stdbool.h>

#define PI_F 3.14159265358979f
#define RADIANS_PER_DEGREE (PI_F / 180.0f)

typedef struct Vec2 {
    float x, y;
} Vec2;

typedef struct Vec3 {
    float x, y, z;
} Vec3;

// Maps points p to (row0.p + t0, row1.p + t1, row2.p + t2); m is row-major, column 3 is the
// translation.
typedef struct Transform {
    float m[3][4];
} Transform;

// Axis-aligned box; empty when low > high.
typedef struct Aabb {
    Vec3 low, high;
} Aabb;

static inline float clampf(float x, float low, float high)
{
    return x < low ? low : (x > high ? high : x);
}

static inline float lerpf(float a, float b, float t)
{
    return a + (b - a) * t;
}

// Hermite step from 0 at edge0 to 1 at edge1.
static inline float smoothstepf(float edge0, float edge1, float x)
{
    float t = clampf((x - edge0) / (edge1 - edge0), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static inline Vec3 vec3(float x, float y, float z)
{
    return (Vec3){x, y, z};
}

static inline Vec3 vec3_splat(float s)
{
    return (Vec3){s, s, s};
}

static inline Vec3 vec3_add(Vec3 a, Vec3 b)
{
    return vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline Vec3 vec3_sub(Vec3 a, Vec3 b)
{
    return vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline Vec3 vec3_mul(Vec3 a, Vec3 b)
{
    return vec3(a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline Vec3 vec3_scale(Vec3 a, float s)
{
    return vec3(a.x * s, a.y * s, a.z * s);
}

// a + s b
static inline Vec3 vec3_madd(Vec3 a, float s, Vec3 b)
{
    return vec3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

static inline Vec3 vec3_neg(Vec3 a)
{
    return vec3(-a.x, -a.y, -a.z);
}

// Component of an axis: 0 = x, 1 = y, 2 = z.
static inline float vec3_axis(Vec3 v, int axis)
{
    return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

static inline float vec3_dot(Vec3 a, Vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline Vec3 vec3_cross(Vec3 a, Vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline float vec3_length(Vec3 a)
{
    return sqrtf(vec3_dot(a, a));
}

static inline float vec3_distance(Vec3 a, Vec3 b)
{
    return vec3_length(vec3_sub(a, b));
}

// Unit vector along a; the zero vector stays zero.
static inline Vec3 vec3_normalize(Vec3 a)
{
    float length = vec3_length(a);
    return length > 0.0f ? vec3_scale(a, 1.0f / length) : a;
}

static inline Vec3 vec3_lerp(Vec3 a, Vec3 b, float t)
{
    return vec3_madd(a, t, vec3_sub(b, a));
}

static inline Vec3 vec3_min(Vec3 a, Vec3 b)
{
    return vec3(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}

static inline Vec3 vec3_max(Vec3 a, Vec3 b)
{
    return vec3(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

// The largest of the coordinates' magnitudes.
static inline float vec3_largest(Vec3 a)
{
    float x = fabsf(a.x), y = fabsf(a.y), z = fabsf(a.z), yz = y > z ? y : z;
    return x > yz ? x : yz;
}

static inline bool vec3_finite(Vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

// A unit vector perpendicular to the unit vector n.
static inline Vec3 vec3_perpendicular(Vec3 n)
{
    Vec3 axis = fabsf(n.x) < 0.57735f ? vec3(1, 0, 0)
                                      : (fabsf(n.y) < 0.57735f ? vec3(0, 1, 0) : vec3(0, 0, 1));
    return vec3_normalize(vec3_cross(n, axis));
}

// Rotates v about the unit axis by the angle with this cosine and sine (Rodrigues).
static inline Vec3 vec3_rotate(Vec3 v, Vec3 axis, float cosine, float sine)
{
    Vec3 along = vec3_scale(axis, vec3_dot(axis, v) * (1.0f - cosine));
    return vec3_add(vec3_madd(vec3_scale(v, cosine), sine, vec3_cross(axis, v)), along);
}

static inline Transform transform_identity(void)
{
    return (Transform){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

// Determinant of the 3 x 3 part: the factor on volumes; negative when it mirrors.
static inline float transform_determinant(const Transform *t)
{
    return vec3_dot(vec3(t->m[0][0], t->m[0][1], t->m[0][2]),
                    vec3_cross(vec3(t->m[1][0], t->m[1][1], t->m[1][2]),
                               vec3(t->m[2][0], t->m[2][1], t->m[2][2])));
}

// Transform with columns x, y, z (need not be unit or orthogonal) and translation origin.
static inline Transform transform_from_axes(Vec3 x, Vec3 y, Vec3 z, Vec3 origin)
{
    return (Transform){
        {{x.x, y.x, z.x, origin.x}, {x.y, y.y, z.y, origin.y}, {x.z, y.z, z.z, origin.z}}};
}

static inline Vec3 transform_point(const Transform *t, Vec3 p)
{
    return vec3(t->m[0][0] * p.x + t->m[0][1] * p.y + t->m[0][2] * p.z + t->m[0][3],
                t->m[1][0] * p.x + t->m[1][1] * p.y + t->m[1][2] * p.z + t->m[1][3],
                t->m[2][0] * p.x + t->m[2][1] * p.y + t->m[2][2] * p.z + t->m[2][3]);
}

static inline Vec3 transform_vector(const Transform *t, Vec3 v)
{
    return vec3(t->m[0][0] * v.x + t->m[0][1] * v.y + t->m[0][2] * v.z,
                t->m[1][0] * v.x + t->m[1][1] * v.y + t->m[1][2] * v.z,
                t->m[2][0] * v.x + t->m[2][1] * v.y + t->m[2][2] * v.z);
}

// Composition, b first: transform_point(ab, p) = transform_point(a, transform_point(b, p)).
Transform transform_multiply(const Transform *a, const Transform *b);

// Inverse of t; false when t is singular.
bool transform_inverse(const Transform *t, Transform *inverse);

// Direction of a transformed surface normal: inverse transpose times n, not normalised. Takes the
// *inverse* of the transform.
static inline Vec3 transform_normal(const Transform *inverse, Vec3 n)
{
    return vec3(inverse->m[0][0] * n.x + inverse->m[1][0] * n.y + inverse->m[2][0] * n.z,
                inverse->m[0][1] * n.x + inverse->m[1][1] * n.y + inverse->m[2][1] * n.z,
                inverse->m[0][2] * n.x + inverse->m[1][2] * n.y + inverse->m[2][2] * n.z);
}

// Scales, then rotates about x, y and z (degrees, in that order), then translates.
Transform transform_compose(Vec3 translate, Vec3 rotate_degrees, Vec3 scale);

static inline Aabb aabb_empty(void)
{
    return (Aabb){vec3_splat(INFINITY), vec3_splat(-INFINITY)};
}

static inline Aabb aabb_add(Aabb box, Vec3 p)
{
    return (Aabb){vec3_min(box.low, p), vec3_max(box.high, p)};
}

static inline Aabb aabb_union(Aabb a, Aabb b)
{
    return (Aabb){vec3_min(a.low, b.low), vec3_max(a.high, b.high)};
}

static inline Aabb aabb_common(Aabb a, Aabb b)
{
    return (Aabb){vec3_max(a.low, b.low), vec3_min(a.high, b.high)};
}

// Length of the longest side.
static inline float aabb_extent(Aabb box)
{
    Vec3 size = vec3_sub(box.high, box.low);
    return fmaxf(size.x, fmaxf(size.y, size.z));
}

static inline bool aabb_is_empty(Aabb box)
{
    return box.low.x > box.high.x;
}

// Bounding box of the transformed corners of a non-empty box.
Aabb aabb_transform(Aabb box, const Transform *t);

#endif
