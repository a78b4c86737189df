#include "export/vertex.h"

#include "base/memory.h"
#include "image/tone_curve.h"
#include "render/material/pattern.h"

#include <stdlib.h>

static bool make_normals(ExportSurface *surface, Error *e)
{
    Mesh bare = *surface->mesh;
    bare.normal = NULL;
    bool done = mesh_compute_normals(&bare, e);
    surface->normal = bare.normal;
    return done;
}

static bool find_faces(ExportSurface *surface, Error *e)
{
    const Mesh *mesh = surface->mesh;
    surface->face = memory_alloc_zero(mesh->vertex_count, sizeof *surface->face, e);
    if (!surface->face) {
        return false;
    }
    // backwards, so that the first face of a vertex is kept
    for (int64_t i = mesh->face_count * mesh->face_size - 1; i >= 0; i--) {
        surface->face[mesh->index[i]] = (uint32_t)(i / mesh->face_size);
    }
    return true;
}

bool export_surface_prepare(ExportSurface *surface, const Mesh *mesh, const Material *material,
                            unsigned wants, Error *e)
{
    *surface = (ExportSurface){.mesh = mesh, .material = material, .wants = wants};
    bool done = (!(wants & EXPORT_WANTS_NORMALS) || mesh->normal || make_normals(surface, e)) &&
                (!(wants & EXPORT_WANTS_COLORS) ||
                 !(material_has_pattern(material) || material_varies(material)) ||
                 mesh->face_count == 0 || find_faces(surface, e));
    if (!done) {
        export_surface_clear(surface);
    }
    return done;
}

void export_surface_clear(ExportSurface *surface)
{
    free(surface->normal);
    free(surface->face);
    surface->normal = NULL;
    surface->face = NULL;
}

// ---- colours

void export_tangents(const Mesh *mesh, const uint32_t corner[3], Vec3 *u, Vec3 *v)
{
    Vec3 a = mesh->position[corner[0]];
    Vec3 e1 = vec3_sub(mesh->position[corner[1]], a), e2 = vec3_sub(mesh->position[corner[2]], a);
    *u = e1;
    *v = e2;
    if (!mesh->uv) {
        return;
    }
    Vec2 o = mesh->uv[corner[0]], p = mesh->uv[corner[1]], q = mesh->uv[corner[2]];
    float u1 = p.x - o.x, v1 = p.y - o.y, u2 = q.x - o.x, v2 = q.y - o.y;
    float determinant = u1 * v2 - v1 * u2;
    if (fabsf(determinant) > 1e-20f) {
        *u = vec3_scale(vec3_madd(vec3_scale(e1, v2), -v1, e2), 1.0f / determinant);
        *v = vec3_scale(vec3_madd(vec3_scale(e2, u1), -u2, e1), 1.0f / determinant);
    }
}

// The input of patterns at a vertex of a face, as in the ray tracer; the footprint is the size of
// the face.
static SurfacePoint pattern_point(const ExportSurface *surface, const Transform *place,
                                  const ExportVertex *vertex, int64_t v)
{
    const Mesh *mesh = surface->mesh;
    const uint32_t *corner = mesh->index + (int64_t)surface->face[v] * mesh->face_size;
    Vec3 a = mesh->position[corner[0]];
    Vec3 e1 = vec3_sub(mesh->position[corner[1]], a);
    Vec3 e2 = vec3_sub(mesh->position[corner[mesh->face_size - 1]], a);
    SurfacePoint point = {.position = vertex->position,
                          .lifted = vertex->position,
                          .object_position = mesh->position[v],
                          .facet_normal = vertex->normal,
                          .geometric_normal = vertex->normal,
                          .normal = vertex->normal,
                          .uv = vertex->uv,
                          .radius = vertex->radius,
                          .birth = vertex->birth,
                          .site = mesh->site ? mesh->site[v] : (Vec2){0, 0},
                          .foam = mesh->foam ? mesh->foam[v] : 0.0f,
                          .shore = mesh->shore ? mesh->shore[v] : 0.0f,
                          .young = mesh->young ? mesh->young[v] : 0.0f,
                          .withered = mesh->withered ? mesh->withered[v] : 0.0f,
                          .strata = mesh->strata};
    Vec3 u, w;
    export_tangents(mesh, (const uint32_t[3]){corner[0], corner[1], corner[mesh->face_size - 1]},
                    &u, &w);
    point.tangent_u = place ? transform_vector(place, u) : u;
    point.tangent_v = place ? transform_vector(place, w) : w;
    Vec3 across = vec3_cross(place ? transform_vector(place, e1) : e1,
                             place ? transform_vector(place, e2) : e2);
    point.footprint = sqrtf(vec3_length(across));
    return point;
}

static Vec3 pattern_color(const ExportSurface *surface, const Transform *place, InstanceLook look,
                          const ExportVertex *vertex, int64_t v)
{
    Material material = *surface->material;
    SurfacePoint point = pattern_point(surface, place, vertex, v);
    point.variation = look.variation < 0.0f ? 0.5f : look.variation;
    point.season = look.season;
    material.variation = look.variation < 0.0f ? 0.0f : material.variation;
    material.pattern_depth = 0.0f; // only the colour is used
    PatternShade shade = {material.color, material.transmittance, point.normal, 0.0f,
                          material.roughness};
    pattern_apply(&material, &point, &shade);
    return shade.color;
}

static Vec3 clamp_color(Vec3 color)
{
    color = vec3_finite(color) ? color : vec3_splat(0.0f);
    return vec3_max(vec3_min(color, vec3_splat(1.0f)), vec3_splat(0.0f));
}

// ---- vertices

static Vec3 vertex_normal(const ExportSurface *surface, const Transform *inverse, int64_t v)
{
    const Vec3 *normal = surface->normal ? surface->normal : surface->mesh->normal;
    if (!normal) {
        return vec3(0, 1, 0);
    }
    Vec3 n = vec3_normalize(inverse ? transform_normal(inverse, normal[v]) : normal[v]);
    return vec3_dot(n, n) > 0.5f ? n : vec3(0, 1, 0); // faces without area have none
}

void export_surface_vertices(const ExportSurface *surface, const Transform *place,
                             InstanceLook look, int64_t first, int64_t count, int threads,
                             ExportVertex *out)
{
    const Mesh *mesh = surface->mesh;
    Transform inverse;
    bool turned = place && transform_inverse(place, &inverse);
    bool patterned = surface->face != NULL;
    float per_radius = surface->largest_radius > 0.0f ? 1.0f / surface->largest_radius : 0.0f;
#pragma omp parallel for schedule(dynamic, 1024) num_threads(threads) if (patterned && count > 4096)
    for (int64_t i = 0; i < count; i++) {
        int64_t v = first + i;
        ExportVertex *vertex = &out[i];
        vertex->position = place ? transform_point(place, mesh->position[v]) : mesh->position[v];
        vertex->normal = vertex_normal(surface, turned ? &inverse : NULL, v);
        vertex->uv = mesh->uv ? mesh->uv[v] : (Vec2){0, 0};
        vertex->radius = mesh->radius ? mesh->radius[v] : 0.0f;
        vertex->birth = mesh->birth ? mesh->birth[v] : 0.0f;
        vertex->glow = surface->glow ? surface->glow[v] : 1.0f;
        vertex->growth = clamp_color(vec3(vertex->birth, vertex->radius * per_radius, 0.0f));
        vertex->color = clamp_color(patterned ? pattern_color(surface, place, look, vertex, v)
                                              : surface->material->color);
    }
}

bool export_is_mirror(const Transform *t)
{
    Vec3 x = vec3(t->m[0][0], t->m[1][0], t->m[2][0]);
    Vec3 y = vec3(t->m[0][1], t->m[1][1], t->m[2][1]);
    Vec3 z = vec3(t->m[0][2], t->m[1][2], t->m[2][2]);
    return vec3_dot(x, vec3_cross(y, z)) < 0.0f;
}

int export_face_triangles(const Mesh *mesh, int64_t face, bool mirrored, uint32_t corner[6])
{
    static const int split[6] = {0, 1, 3, 2, 3, 1};
    const uint32_t *own = mesh->index + face * mesh->face_size;
    int corners = 3 * (mesh->face_size - 2);
    for (int k = 0; k < corners; k++) {
        int from = mirrored ? corners - 1 - k : k;
        corner[k] = own[corners == 3 ? from : split[from]];
    }
    return corners / 3;
}

uint8_t export_srgb8(float linear)
{
    return (uint8_t)(255.0f * tone_srgb_from_linear(linear) + 0.5f);
}
