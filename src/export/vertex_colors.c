#include "export/vertex_colors.h"

#include "base/memory.h"
#include "render/pattern.h"

#include <stdlib.h>

// Sums over the triangles around a vertex.
typedef struct VertexFrame {
    Vec3 normal;
    Vec3 tangent_u, tangent_v; // dP/du and dP/dv, times the triangles' areas
    float area, mapped_area;   // of all, and of those with tangents
    int32_t triangles;
} VertexFrame;

bool vertex_colors_vary(const World *world, const Part *part)
{
    const Material *material = &world->material[part->material];
    bool coloured = material->kind != MATERIAL_DIELECTRIC && material->kind != MATERIAL_EMISSION &&
                    material->kind != MATERIAL_THIN_FILM; // these have its bumps alone
    return coloured && material->pattern != PATTERN_NONE;
}

// dP/du and dP/dv of a triangle with these edges and steps of uv; false where uv is degenerate.
static bool tangents(Vec3 e1, Vec3 e2, const Vec2 uv[3], Vec3 *u, Vec3 *v)
{
    float u1 = uv[1].x - uv[0].x, v1 = uv[1].y - uv[0].y;
    float u2 = uv[2].x - uv[0].x, v2 = uv[2].y - uv[0].y;
    float determinant = u1 * v2 - v1 * u2;
    if (fabsf(determinant) < 1e-20f) {
        return false;
    }
    *u = vec3_scale(vec3_madd(vec3_scale(e1, v2), -v1, e2), 1.0f / determinant);
    *v = vec3_scale(vec3_madd(vec3_scale(e2, u1), -u2, e1), 1.0f / determinant);
    return true;
}

static void add_triangle(const Mesh *mesh, uint32_t a, uint32_t b, uint32_t c, VertexFrame *frame)
{
    Vec3 e1 = vec3_sub(mesh->position[b], mesh->position[a]);
    Vec3 e2 = vec3_sub(mesh->position[c], mesh->position[a]);
    Vec3 u = {0}, v = {0};
    Vec3 across = vec3_cross(e1, e2);
    float area = 0.5f * vec3_length(across);
    bool mapped = false;
    if (mesh->uv) {
        mapped = tangents(e1, e2, (Vec2[]){mesh->uv[a], mesh->uv[b], mesh->uv[c]}, &u, &v);
    }
    const uint32_t corner[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        VertexFrame *at = &frame[corner[i]];
        at->normal = vec3_add(at->normal, across);
        at->area += area;
        at->triangles++;
        if (mapped) {
            at->tangent_u = vec3_madd(at->tangent_u, area, u);
            at->tangent_v = vec3_madd(at->tangent_v, area, v);
            at->mapped_area += area;
        }
    }
}

static VertexFrame *mesh_frames(const Mesh *mesh, Error *e)
{
    VertexFrame *frame = memory_alloc_zero(mesh->vertex_count, sizeof *frame, e);
    for (int64_t f = 0; frame && f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        for (int k = 2; k < mesh->face_size; k++) {
            add_triangle(mesh, corner[0], corner[k - 1], corner[k], frame);
        }
    }
    return frame;
}

static void set_frame(SurfacePoint *point, Vec3 normal)
{
    point->geometric_normal = point->facet_normal = point->normal = normal;
    point->lifted = point->object_position = point->position;
}

static SurfacePoint mesh_point(const Mesh *mesh, const VertexFrame *frame, int64_t i)
{
    const VertexFrame *at = &frame[i];
    SurfacePoint point = {.position = mesh->position[i], .variation = 0.5f};
    Vec3 normal = vec3_normalize(mesh->normal ? mesh->normal[i] : at->normal);
    set_frame(&point, vec3_dot(normal, normal) > 0.0f ? normal : vec3(0, 1, 0));
    if (at->mapped_area > 0.0f) {
        point.tangent_u = vec3_scale(at->tangent_u, 1.0f / at->mapped_area);
        point.tangent_v = vec3_scale(at->tangent_v, 1.0f / at->mapped_area);
    } else {
        point.tangent_u = vec3_perpendicular(point.normal);
        point.tangent_v = vec3_cross(point.normal, point.tangent_u);
    }
    point.footprint = at->triangles > 0 ? sqrtf(2.0f * at->area / (float)at->triangles) : 0.0f;
    point.uv = mesh->uv ? mesh->uv[i] : (Vec2){0, 0};
    point.radius = mesh->radius ? mesh->radius[i] : 0.0f;
    point.birth = mesh->birth ? mesh->birth[i] : 0.0f;
    point.site = mesh->site ? mesh->site[i] : (Vec2){0, 0};
    return point;
}

// last: of the point's curve.
static SurfacePoint curve_point(const CurveSet *curves, int64_t i, bool last)
{
    int64_t from = last ? i - 1 : i;
    Vec3 step = vec3_sub(curves->position[from + 1], curves->position[from]);
    Vec3 axis = vec3_normalize(step);
    axis = vec3_dot(axis, axis) > 0.0f ? axis : vec3(0, 1, 0);
    SurfacePoint point = {.position = curves->position[i], .variation = 0.5f};
    set_frame(&point, vec3_perpendicular(axis));
    point.tangent_v = axis;
    point.tangent_u = vec3_cross(axis, point.normal);
    point.footprint = vec3_length(step);
    point.uv.y = curves->along ? curves->along[i] : 0.0f;
    point.radius = curves->radius[i];
    point.birth = curves->birth ? curves->birth[i] : 0.0f;
    return point;
}

static Vec3 color_at(const Material *material, const SurfacePoint *point)
{
    PatternShade shade = {material->color, material->transmittance, point->normal};
    pattern_apply(material, point, &shade);
    return vec3_max(vec3_min(shade.color, vec3_splat(1.0f)), vec3_splat(0.0f));
}

static bool color_mesh(const Material *material, const Mesh *mesh, const Run *run, Vec3 *color,
                       Error *e)
{
    VertexFrame *frame = mesh_frames(mesh, e);
    if (!frame) {
        return false;
    }
#pragma omp parallel for num_threads(run->threads) schedule(dynamic, 4096)
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        if (!run_is_cancelled(run)) {
            SurfacePoint point = mesh_point(mesh, frame, i);
            color[i] = color_at(material, &point);
        }
    }
    free(frame);
    return true;
}

static void color_curves(const Material *material, const CurveSet *curves, const Run *run,
                         Vec3 *color)
{
#pragma omp parallel for num_threads(run->threads) schedule(dynamic, 1024)
    for (int64_t k = 0; k < curves->curve_count; k++) {
        int64_t end = curves->first[k + 1];
        for (int64_t i = curves->first[k]; i < end && !run_is_cancelled(run); i++) {
            SurfacePoint point = curve_point(curves, i, i + 1 == end);
            color[i] = color_at(material, &point);
        }
    }
}

Vec3 *vertex_colors(const World *world, const Part *part, const Run *run, Error *e)
{
    Material material = world->material[part->material];
    if (part->instance) {
        material.variation = 0.0f;
    }
    int64_t count = part->mesh ? part->mesh->vertex_count : part->curves->point_count;
    Vec3 *color = memory_alloc(count, sizeof *color, e);
    bool done = color;
    if (done && part->mesh) {
        done = color_mesh(&material, part->mesh, run, color, e);
    } else if (done) {
        color_curves(&material, part->curves, run, color);
    }
    if (!done || run_is_cancelled(run)) {
        free(color);
        return done ? (run_cancel_error(e), NULL) : NULL;
    }
    return color;
}
