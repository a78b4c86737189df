#include "field/nuclei.h"

#include "base/exact_math.h"

// The point of the nuclei that is nearest to p, and its normal. Of equally near ones, points come
// before lines, and the first of the list before the others.
typedef struct Near {
    Vec3 position, normal;
    float distance2;
} Near;

static Vec3 nearest_on(const NucleusLine *line, Vec3 p)
{
    Vec3 along = vec3_sub(line->to, line->from);
    float share = vec3_dot(vec3_sub(p, line->from), along) / vec3_dot(along, along);
    return vec3_madd(line->from, clampf(share, 0.0f, 1.0f), along);
}

static void take_nearer(Near *near, Vec3 p, Vec3 position, Vec3 normal)
{
    Vec3 v = vec3_sub(p, position);
    float d = vec3_dot(v, v);
    if (d < near->distance2) {
        *near = (Near){position, normal, d};
    }
}

static Near nearest_nucleus(const Nuclei *nuclei, Vec3 p)
{
    Near near = {.position = p, .normal = {0, 1, 0}, .distance2 = INFINITY};
    const TreePoint *point = point_tree_nearest(&nuclei->points, p, -1);
    if (point) {
        take_nearer(&near, p, point->position, nuclei->normal[point->index]);
    }
    for (int i = 0; i < nuclei->line_count; i++) {
        take_nearer(&near, p, nearest_on(&nuclei->line[i], p), nuclei->line[i].normal);
    }
    return near;
}

static Vec3 across(Vec3 v, Vec3 axis)
{
    return vec3_madd(v, -vec3_dot(v, axis), axis);
}

// Distance from the nucleus to the farthest side of the bounds, measured perpendicular to the axis:
// the rim.
static float rim_distance(const Nuclei *nuclei, Vec3 nucleus, Vec3 axis)
{
    Vec3 below = vec3_sub(nucleus, nuclei->bounds.low);
    Vec3 above = vec3_sub(nuclei->bounds.high, nucleus);
    Vec3 reach = vec3_max(below, above);
    float x = reach.x * sqrtf(clampf(1.0f - axis.x * axis.x, 0.0f, 1.0f));
    float y = reach.y * sqrtf(clampf(1.0f - axis.y * axis.y, 0.0f, 1.0f));
    float z = reach.z * sqrtf(clampf(1.0f - axis.z * axis.z, 0.0f, 1.0f));
    float r = x > y ? x : y;
    return r > z ? r : z;
}

// Tangent of the local angle of a streamline that sweeps `turn` in total. In the plane, r dtheta/dr
// = tan, so tan = t r / r_max sweeps t from the nucleus to the rim; on a sphere, sin(phi)
// dtheta/dphi = tan, so tan = t sin(phi) / pi sweeps t from pole to pole.
static float swept_tangent(const Nuclei *nuclei, const FieldParams *params, Vec3 nucleus, Vec3 p,
                           Vec3 axis)
{
    float turn = params->turn * RADIANS_PER_DEGREE;
    if (params->spherical) {
        Vec3 a = vec3_normalize(vec3_sub(nucleus, params->center));
        Vec3 b = vec3_normalize(vec3_sub(p, params->center));
        return turn * vec3_length(vec3_cross(a, b)) / PI_F;
    }
    float rim = params->rim > 0.0f ? params->rim : rim_distance(nuclei, nucleus, axis);
    return rim > 0.0f ? turn * vec3_length(across(vec3_sub(p, nucleus), axis)) / rim : 0.0f;
}

// Turns the angle (c, s) further, so that the field added to an outward pull of length k has that
// angle: by the law of sines, the field's angle from the sum then has the sine k s. A pull longer
// than the field leaves the sum an angle of at most the sine 1 / k.
static void turn_against_pull(float k, float *c, float *s)
{
    if (k * fabsf(*s) > 1.0f) {
        *s = (*s < 0.0f ? -1.0f : 1.0f) / k;
        *c = sqrtf(1.0f - *s * *s);
    }
    float sine = k * *s, cosine = sqrtf(clampf(1.0f - sine * sine, 0.0f, 1.0f));
    float turned = *c * cosine - *s * sine;
    *s = *s * cosine + *c * sine;
    *c = turned;
}

// Computes q X q* with q = cos(t/2) + N sin(t/2), N not necessarily unit (Tanaka eq. (10)-(11)): w
// = cos(t/2), v = N sin(t/2).
static Vec3 turn_by_quaternion(Vec3 x, Vec3 v, float w)
{
    Vec3 turned = vec3_scale(x, w * w - vec3_dot(v, v));
    turned = vec3_madd(turned, 2.0f * vec3_dot(v, x), v);
    return vec3_madd(turned, 2.0f * w, vec3_cross(v, x));
}

Vec3 nuclei_at(const Nuclei *nuclei, const FieldParams *params, Vec3 p, Vec3 n)
{
    Near near = nearest_nucleus(nuclei, p);
    Vec3 away = vec3_sub(p, near.position);
    Vec3 normal = params->surface ? n : params->vector;
    if (vec3_dot(normal, normal) == 0.0f) {
        normal = near.normal;
    }
    Vec3 axis = vec3_normalize(normal);
    away = vec3_normalize(params->surface ? across(away, axis) : away); // Tanaka eq. (9)
    float s, c;
    if (params->profile == PROFILE_CONSTANT) {
        exact_sincos(0.5f * params->turn * RADIANS_PER_DEGREE, &s, &c);
        // Tanaka eq. (10)-(12)
        return vec3_normalize(turn_by_quaternion(away, vec3_scale(normal, s), c));
    }
    float tangent = swept_tangent(nuclei, params, near.position, p, axis) * vec3_length(normal);
    c = 1.0f / sqrtf(1.0f + tangent * tangent);
    s = tangent * c;
    if (params->profile == PROFILE_GROWN) {
        turn_against_pull(params->pull, &c, &s);
    }
    return vec3_normalize(vec3_rotate(away, axis, c, s));
}
