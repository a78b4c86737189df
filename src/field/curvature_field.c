#include "field/curvature_field.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define UMBILIC 0.05f // relative difference of the principal curvatures below which all are alike

// A symmetric 3 x 3 matrix: xx, yy, zz, xy, xz, yz.
typedef struct Tensor {
    double m[6];
} Tensor;

static void add_product(Tensor *t, double weight, Vec3 a, Vec3 b) // weight (a b^T + b a^T) / 2
{
    t->m[0] += weight * (double)(a.x * b.x);
    t->m[1] += weight * (double)(a.y * b.y);
    t->m[2] += weight * (double)(a.z * b.z);
    t->m[3] += weight * 0.5 * (double)(a.x * b.y + a.y * b.x);
    t->m[4] += weight * 0.5 * (double)(a.x * b.z + a.z * b.x);
    t->m[5] += weight * 0.5 * (double)(a.y * b.z + a.z * b.y);
}

static double between(const Tensor *t, Vec3 a, Vec3 b) // a^T T b
{
    double x = (double)a.x, y = (double)a.y, z = (double)a.z;
    return (double)b.x * (t->m[0] * x + t->m[3] * y + t->m[4] * z) +
           (double)b.y * (t->m[3] * x + t->m[1] * y + t->m[5] * z) +
           (double)b.z * (t->m[4] * x + t->m[5] * y + t->m[2] * z);
}

// Least squares for the second fundamental form (ku, kuv, kv) in the frame u, v, such that it maps
// each edge to the difference of the normals along it: the normal equations by Cramer's rule.
static bool fit_form(const Vec3 edge[3], const Vec3 change[3], Vec3 u, Vec3 v, double form[3])
{
    double uu = 0, uv = 0, vv = 0, right[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        double eu = (double)vec3_dot(edge[i], u), ev = (double)vec3_dot(edge[i], v);
        double cu = (double)vec3_dot(change[i], u), cv = (double)vec3_dot(change[i], v);
        uu += eu * eu;
        uv += eu * ev;
        vv += ev * ev;
        right[0] += cu * eu;
        right[1] += cu * ev + cv * eu;
        right[2] += cv * ev;
    }
    // [uu uv 0; uv uu+vv uv; 0 uv vv] form = right
    double middle = uu + vv;
    double determinant = uu * (middle * vv - uv * uv) - uv * uv * vv;
    if (!(fabs(determinant) > 1e-9 * middle * middle * middle)) {
        return false;
    }
    form[0] =
        (right[0] * (middle * vv - uv * uv) - uv * (right[1] * vv - uv * right[2])) / determinant;
    form[1] = (uu * (right[1] * vv - uv * right[2]) - right[0] * uv * vv) / determinant;
    form[2] = (uu * (middle * right[2] - right[1] * uv) - uv * uv * right[2] + uv * uv * right[0]) /
              determinant;
    return true;
}

// The face's curvature tensor, weighted by its area.
static void add_face(const Mesh *mesh, const uint32_t *corner, Tensor *at_vertex)
{
    Vec3 p[3], n[3], edge[3], change[3];
    for (int i = 0; i < 3; i++) {
        p[i] = mesh->position[corner[i]];
        n[i] = mesh->normal[corner[i]];
    }
    for (int i = 0; i < 3; i++) {
        edge[i] = vec3_sub(p[(i + 2) % 3], p[(i + 1) % 3]);
        change[i] = vec3_sub(n[(i + 2) % 3], n[(i + 1) % 3]);
    }
    Vec3 across = vec3_cross(edge[0], edge[1]);
    double form[3], area = 0.5 * (double)vec3_length(across);
    if (!(area > 0.0)) {
        return;
    }
    Vec3 u = vec3_normalize(edge[0]), v = vec3_normalize(vec3_cross(across, u));
    if (!fit_form(edge, change, u, v, form)) {
        return;
    }
    Tensor own = {0};
    add_product(&own, area * form[0], u, u);
    add_product(&own, 2.0 * area * form[1], u, v);
    add_product(&own, area * form[2], v, v);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 6; k++) {
            at_vertex[corner[i]].m[k] += own.m[k];
        }
    }
}

// The eigenvector of the tensor in the tangent plane.
static Vec3 principal(const Tensor *t, Vec3 normal, bool least)
{
    Vec3 u = vec3_perpendicular(normal), v = vec3_cross(normal, u);
    double a = between(t, u, u), b = between(t, u, v), c = between(t, v, v);
    double half = 0.5 * (a - c), radius = sqrt(half * half + b * b);
    double largest = fabs(0.5 * (a + c)) + radius;
    if (!(radius > 0.5 * (double)UMBILIC * largest)) {
        return vec3(0, 0, 0);
    }
    // of the two forms of the eigenvector to (a + c) / 2 + radius, the one without cancellation
    Vec3 greatest = half >= 0.0 ? vec3_add(vec3_scale(u, (float)((half + radius) / largest)),
                                           vec3_scale(v, (float)(b / largest)))
                                : vec3_add(vec3_scale(u, (float)(b / largest)),
                                           vec3_scale(v, (float)((radius - half) / largest)));
    greatest = vec3_normalize(greatest);
    return least ? vec3_cross(normal, greatest) : greatest;
}

bool curvature_field_init(CurvatureField *field, const Mesh *surface, bool least, Error *e)
{
    *field = (CurvatureField){0};
    int64_t count = surface->vertex_count;
    Tensor *tensor = memory_alloc_zero(count, sizeof *tensor, e);
    field->direction = memory_alloc(count, sizeof *field->direction, e);
    bool done =
        tensor && field->direction && point_tree_init(&field->tree, surface->position, count, e);
    for (int64_t f = 0; done && f < surface->face_count; f++) {
        add_face(surface, surface->index + 3 * f, tensor);
    }
    for (int64_t i = 0; done && i < count; i++) {
        field->direction[i] = principal(&tensor[i], surface->normal[i], least);
    }
    free(tensor);
    return done;
}

void curvature_field_free(CurvatureField *field)
{
    point_tree_free(&field->tree);
    free(field->direction);
    *field = (CurvatureField){0};
}

Vec3 curvature_field_at(const CurvatureField *field, Vec3 p, Vec3 toward)
{
    const TreePoint *nearest = point_tree_nearest(&field->tree, p, -1);
    Vec3 direction = nearest ? field->direction[nearest->index] : vec3(0, 0, 0);
    return vec3_dot(direction, toward) < 0.0f ? vec3_scale(direction, -1.0f) : direction;
}
