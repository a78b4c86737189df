// The smooth surface between the vertices of a mesh, and how its stems run.
#include "mesh/dice_surface.h"

#include <math.h>

// The tangent at the end of an edge: the edge laid into the plane of the normal, of the length that
// makes the cubic of an arc of a circle meet the circle in its middle (after Vlachos 2001).
static Vec3 end_tangent(Vec3 edge, Vec3 normal)
{
    Vec3 flat = vec3_madd(edge, -vec3_dot(edge, normal), normal);
    float length2 = vec3_dot(edge, edge);
    float cosine = length2 > 0.0f ? sqrtf(vec3_dot(flat, flat) / length2) : 1.0f;
    cosine = fmaxf(cosine, 0.5f);
    return vec3_scale(flat, 2.0f / (cosine * (1.0f + cosine)));
}

DicePoint dice_middle(const DicePoint *a, const DicePoint *b)
{
    Vec3 edge = vec3_sub(b->position, a->position);
    Vec3 middle = vec3_scale(vec3_add(a->position, b->position), 0.5f);
    Vec3 sum = vec3_add(a->normal, b->normal);
    const float crease = 0.5f; // cosine: there edges stay straight
    if (vec3_dot(a->normal, b->normal) > crease) {
        Vec3 from = end_tangent(edge, a->normal), to = end_tangent(edge, b->normal);
        middle = vec3_madd(middle, 0.125f, vec3_sub(from, to));
        Vec3 along = vec3_madd(vec3_scale(edge, 1.5f), -0.25f, vec3_add(from, to));
        float length2 = vec3_dot(along, along);
        sum = length2 > 0.0f ? vec3_madd(sum, -vec3_dot(sum, along) / length2, along) : sum;
    }
    return (DicePoint){.position = middle,
                       .normal = vec3_normalize(sum),
                       .along = vec3_normalize(vec3_add(a->along, b->along)),
                       .uv = {0.5f * (a->uv.x + b->uv.x), 0.5f * (a->uv.y + b->uv.y)},
                       .site = {0.5f * (a->site.x + b->site.x), 0.5f * (a->site.y + b->site.y)},
                       .shore = 0.5f * (a->shore + b->shore),
                       .radius = 0.5f * (a->radius + b->radius),
                       .birth = 0.5f * (a->birth + b->birth)};
}

// The gradient of v over a triangle; 0 where it has none.
static Vec3 gradient_v(const Mesh *mesh, const uint32_t corner[3])
{
    Vec3 e1 = vec3_sub(mesh->position[corner[1]], mesh->position[corner[0]]);
    Vec3 e2 = vec3_sub(mesh->position[corner[2]], mesh->position[corner[0]]);
    float v1 = mesh->uv[corner[1]].y - mesh->uv[corner[0]].y;
    float v2 = mesh->uv[corner[2]].y - mesh->uv[corner[0]].y;
    Vec3 n = vec3_cross(e1, e2);
    // Perpendicular to n, with these products with e1 and e2; times |n|^2.
    return vec3_add(vec3_scale(vec3_cross(e2, n), v1), vec3_scale(vec3_cross(n, e1), v2));
}

void dice_split_faces(const Mesh *mesh, uint32_t *triangle)
{
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + f * mesh->face_size;
        static const int first[6] = {0, 1, 3, 2, 3, 1};
        for (int k = 0; k < (mesh->face_size == 4 ? 6 : 3); k++) {
            *triangle++ = c[mesh->face_size == 4 ? first[k] : k];
        }
    }
}

void dice_fill_points(const Mesh *mesh, const uint32_t *triangle, int64_t triangle_count,
                      DicePoint *point)
{
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        point[i] = (DicePoint){.position = mesh->position[i],
                               .normal = mesh->normal[i],
                               .uv = mesh->uv ? mesh->uv[i] : (Vec2){0, 0},
                               .site = mesh->site ? mesh->site[i] : (Vec2){0, 0},
                               .shore = mesh->shore ? mesh->shore[i] : 0.0f,
                               .radius = mesh->radius ? mesh->radius[i] : 0.0f,
                               .birth = mesh->birth ? mesh->birth[i] : 0.0f};
    }
    for (int64_t i = 0; mesh->uv && i < triangle_count; i++) {
        const uint32_t *corner = triangle + 3 * i;
        Vec3 way = vec3_normalize(gradient_v(mesh, corner));
        for (int k = 0; k < 3; k++) {
            point[corner[k]].along = vec3_add(point[corner[k]].along, way);
        }
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        point[i].along = vec3_normalize(point[i].along);
    }
}

static int arrays_of(const Mesh *mesh)
{
    return MESH_NORMAL | (mesh->uv ? MESH_UV : 0) | (mesh->radius ? MESH_RADIUS : 0) |
           (mesh->birth ? MESH_BIRTH : 0) | (mesh->site ? MESH_SITE : 0) |
           (mesh->shore ? MESH_SHORE_ARRAY : 0);
}

Mesh *dice_mesh_of(const Mesh *like, const DicePoint *point, int64_t point_count,
                   int64_t face_count, Error *e)
{
    Mesh *mesh = mesh_new(3, point_count, face_count, arrays_of(like), e);
    for (int64_t i = 0; mesh && i < point_count; i++) {
        mesh->position[i] = point[i].position;
        mesh->normal[i] = point[i].normal;
        if (mesh->uv) {
            mesh->uv[i] = point[i].uv;
        }
        if (mesh->shore) {
            mesh->shore[i] = point[i].shore;
        }
        if (mesh->site) {
            mesh->site[i] = point[i].site;
        }
        if (mesh->radius) {
            mesh->radius[i] = point[i].radius;
        }
        if (mesh->birth) {
            mesh->birth[i] = point[i].birth;
        }
    }
    return mesh;
}
