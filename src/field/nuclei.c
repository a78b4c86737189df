#include "field/nuclei.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

bool nuclei_init(Nuclei *nuclei, const Vec3 *position, const Vec3 *normal, int64_t count,
                 Aabb bounds, Error *e)
{
    *nuclei = (Nuclei){.count = count, .bounds = bounds};
    nuclei->position = memory_alloc(count, sizeof(Vec3), e);
    nuclei->normal = memory_alloc(count, sizeof(Vec3), e);
    if (!nuclei->position || !nuclei->normal) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        nuclei->position[i] = position[i];
        nuclei->normal[i] = normal ? normal[i] : vec3(0, 1, 0);
    }
    return true;
}

void nuclei_free(Nuclei *nuclei)
{
    free(nuclei->position);
    free(nuclei->normal);
    *nuclei = (Nuclei){0};
}

static int64_t nearest_nucleus(const Nuclei *nuclei, Vec3 p)
{
    int64_t nearest = 0;
    float best = INFINITY;
    for (int64_t i = 0; i < nuclei->count; i++) {
        Vec3 v = vec3_sub(p, nuclei->position[i]);
        float d = vec3_dot(v, v);
        if (d < best) {
            best = d;
            nearest = i;
        }
    }
    return nearest;
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
    float rim = params->scale > 0.0f ? params->scale : rim_distance(nuclei, nucleus, axis);
    return rim > 0.0f ? turn * vec3_length(across(vec3_sub(p, nucleus), axis)) / rim : 0.0f;
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
    if (nuclei->count == 0) {
        return vec3(0, 0, 0);
    }
    int64_t i = nearest_nucleus(nuclei, p);
    Vec3 nucleus = nuclei->position[i], away = vec3_sub(p, nucleus);
    Vec3 normal = params->surface ? n : params->vector;
    if (vec3_dot(normal, normal) == 0.0f) {
        normal = nuclei->normal[i];
    }
    Vec3 axis = vec3_normalize(normal);
    away = vec3_normalize(params->surface ? across(away, axis) : away); // Tanaka eq. (9)
    float s, c;
    if (params->profile == PROFILE_CONSTANT) {
        exact_sincos(0.5f * params->turn * RADIANS_PER_DEGREE, &s, &c);
        // Tanaka eq. (10)-(12)
        return vec3_normalize(turn_by_quaternion(away, vec3_scale(normal, s), c));
    }
    float tangent = swept_tangent(nuclei, params, nucleus, p, axis) * vec3_length(normal);
    c = 1.0f / sqrtf(1.0f + tangent * tangent);
    s = tangent * c;
    return vec3_normalize(vec3_rotate(away, axis, c, s));
}
