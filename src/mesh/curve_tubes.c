#include "mesh/curve_tubes.h"

#include "base/exact_math.h"

#include <stddef.h>

typedef struct TubeBuilder {
    const CurveSet *curves;
    Mesh *mesh;
    int sides;
    float cosine[CURVE_TUBE_SIDES_MOST], sine[CURVE_TUBE_SIDES_MOST];
    int64_t vertex, triangle; // number written so far
} TubeBuilder;

void curve_tubes_count(const CurveSet *curves, int64_t first, int64_t count, int sides,
                       int64_t *vertices, int64_t *triangles)
{
    int64_t points = curves->first[first + count] - curves->first[first];
    *vertices = points * sides + 2 * count;
    *triangles = 2 * (points - count) * sides + 2 * count * sides;
}

static void add_vertex(TubeBuilder *builder, int64_t point, Vec3 position, Vec3 normal, Vec2 uv,
                       float radius)
{
    Mesh *mesh = builder->mesh;
    int64_t v = builder->vertex++;
    mesh->position[v] = position;
    mesh->normal[v] = normal;
    mesh->uv[v] = uv;
    mesh->radius[v] = radius;
    mesh->birth[v] = builder->curves->birth[point];
}

static void add_triangle(TubeBuilder *builder, int64_t a, int64_t b, int64_t c)
{
    uint32_t *corner = builder->mesh->index + 3 * builder->triangle++;
    corner[0] = (uint32_t)a;
    corner[1] = (uint32_t)b;
    corner[2] = (uint32_t)c;
}

// x is perpendicular to the unit direction.
static void add_ring(TubeBuilder *builder, int64_t point, Vec3 direction, Vec3 x, float radius)
{
    const CurveSet *curves = builder->curves;
    int sides = builder->sides;
    Vec3 y = vec3_cross(direction, x);
    float side = 2.0f * PI_F * radius / (float)sides;
    for (int k = 0; k < sides; k++) {
        Vec3 out = vec3_madd(vec3_scale(x, builder->cosine[k]), builder->sine[k], y);
        int around = k <= sides - k ? k : sides - k;
        add_vertex(builder, point, vec3_madd(curves->position[point], radius, out), out,
                   (Vec2){side * (float)around, curves->along[point]}, radius);
    }
}

static void add_cap(TubeBuilder *builder, int64_t point, Vec3 direction, float radius)
{
    add_vertex(builder, point, vec3_madd(builder->curves->position[point], radius, direction),
               direction, (Vec2){0.0f, builder->curves->along[point]}, radius);
}

// Unit direction from point i to point i + 1 of a curve with points first .. last; `before` if the
// two coincide.
static Vec3 segment_direction(const CurveSet *curves, int64_t i, Vec3 before)
{
    Vec3 step = vec3_sub(curves->position[i + 1], curves->position[i]);
    return vec3_dot(step, step) > 0.0f ? vec3_normalize(step) : before;
}

static Vec3 first_direction(const CurveSet *curves, int64_t first, int64_t last)
{
    Vec3 direction = vec3_splat(0.0f);
    for (int64_t i = first; i < last && vec3_dot(direction, direction) <= 0.0f; i++) {
        direction = segment_direction(curves, i, direction);
    }
    return vec3_dot(direction, direction) > 0.0f ? direction : vec3(0, 1, 0);
}

// Mean of two unit directions; the second if they are opposite.
static Vec3 mean_direction(Vec3 a, Vec3 b)
{
    Vec3 sum = vec3_add(a, b);
    return vec3_dot(sum, sum) > 1e-6f ? vec3_normalize(sum) : b;
}

static float least_radius(const CurveSet *curves, int64_t first, int64_t last)
{
    float largest = 0.0f;
    for (int64_t i = first; i <= last; i++) {
        largest = curves->radius[i] > largest ? curves->radius[i] : largest;
    }
    return largest > 0.0f ? 0.01f * largest : 1e-6f;
}

static void join_rings(TubeBuilder *builder, int64_t ring, int64_t next)
{
    for (int k = 0; k < builder->sides; k++) {
        int other = k + 1 < builder->sides ? k + 1 : 0;
        add_triangle(builder, ring + k, ring + other, next + other);
        add_triangle(builder, ring + k, next + other, next + k);
    }
}

static void close_ends(TubeBuilder *builder, int64_t base, int64_t ring, int64_t tip)
{
    for (int k = 0; k < builder->sides; k++) {
        int other = k + 1 < builder->sides ? k + 1 : 0;
        add_triangle(builder, base, base + 1 + other, base + 1 + k);
        add_triangle(builder, ring + k, ring + other, tip);
    }
}

static void add_tube(TubeBuilder *builder, int64_t curve)
{
    const CurveSet *curves = builder->curves;
    int64_t first = curves->first[curve], last = curves->first[curve + 1] - 1;
    int64_t base = builder->vertex, ring = base + 1;
    float least = least_radius(curves, first, last);
    Vec3 behind = first_direction(curves, first, last), x = vec3_perpendicular(behind);
    add_cap(builder, first, vec3_neg(behind), fmaxf(curves->radius[first], least));
    for (int64_t i = first; i <= last; i++) {
        Vec3 ahead = i < last ? segment_direction(curves, i, behind) : behind;
        Vec3 direction = i > first ? mean_direction(behind, ahead) : ahead;
        x = vec3_madd(x, -vec3_dot(x, direction), direction); // rotation-minimising
        x = vec3_dot(x, x) > 1e-6f ? vec3_normalize(x) : vec3_perpendicular(direction);
        add_ring(builder, i, direction, x, fmaxf(curves->radius[i], least));
        if (i > first) {
            join_rings(builder, ring, ring + builder->sides);
            ring += builder->sides;
        }
        behind = ahead;
    }
    add_cap(builder, last, behind, fmaxf(curves->radius[last], least));
    close_ends(builder, base, ring, builder->vertex - 1);
}

Mesh *curve_tubes(const CurveSet *curves, int64_t first, int64_t count, int sides, Error *e)
{
    int64_t vertices, triangles;
    curve_tubes_count(curves, first, count, sides, &vertices, &triangles);
    if (vertices > UINT32_MAX) {
        error_set(
            e, ERROR_INPUT,
            "curves with %lld vertices as tubes; a mesh holds fewer than 2^32: fewer sides or "
            "fewer curves would be right",
            (long long)vertices);
        return NULL;
    }
    TubeBuilder builder = {.curves = curves, .sides = sides};
    builder.mesh =
        mesh_new(3, vertices, triangles, MESH_NORMAL | MESH_UV | MESH_RADIUS | MESH_BIRTH, e);
    for (int k = 0; builder.mesh && k < sides; k++) {
        exact_sincos(2.0f * PI_F * (float)k / (float)sides, &builder.sine[k], &builder.cosine[k]);
    }
    for (int64_t i = first; builder.mesh && i < first + count; i++) {
        add_tube(&builder, i);
    }
    return builder.mesh;
}

void curve_tubes_spread(const CurveSet *curves, int64_t first, int64_t count, int sides,
                        const float *of_point, float *of_vertex)
{
    for (int64_t i = first; i < first + count; i++) {
        int64_t last = curves->first[i + 1] - 1;
        *of_vertex++ = of_point[curves->first[i]]; // caps and rings in the order of add_tube
        for (int64_t point = curves->first[i]; point <= last; point++) {
            for (int k = 0; k < sides; k++) {
                *of_vertex++ = of_point[point];
            }
        }
        *of_vertex++ = of_point[last];
    }
}
