#include "export/pov/shade.h"

#include "base/memory.h"
#include "base/random.h"
#include "export/vertex.h"
#include "render/material/pattern.h"

#include <stdlib.h>

void pov_shades_clear(PovShades *shades)
{
    free(shades->color);
    free(shades->transmittance);
    free(shades->normal);
    *shades = (PovShades){0};
}

static bool shades_new(PovShades *shades, int64_t count, bool normals, Error *e)
{
    *shades = (PovShades){.count = count};
    shades->color = memory_alloc(count, sizeof(Vec3), e);
    shades->transmittance = shades->color ? memory_alloc(count, sizeof(Vec3), e) : NULL;
    shades->normal = shades->transmittance && normals ? memory_alloc(count, sizeof(Vec3), e) : NULL;
    bool done = shades->transmittance && (shades->normal || !normals);
    if (!done) {
        pov_shades_clear(shades);
    }
    return done;
}

static Vec3 clamp_color(Vec3 c)
{
    return vec3_max(vec3_min(c, vec3_splat(1.0f)), vec3_splat(0.0f));
}

static PatternShade shade_at(const Material *m, const SurfacePoint *point)
{
    PatternShade shade = {m->color, m->transmittance, point->normal, 0.0f, m->roughness};
    pattern_apply(m, point, &shade);
    shade.color = clamp_color(shade.color);
    shade.transmittance = clamp_color(shade.transmittance);
    return shade;
}

// ---- meshes

// A vertex as a corner of the face. The footprint is the size of the face: finer details fade into
// their mean.
static SurfacePoint vertex_point(const Mesh *mesh, uint32_t vertex, int64_t face,
                                 const Transform *place, InstanceLook look)
{
    const uint32_t *corner = mesh->index + face * mesh->face_size;
    Vec3 a = mesh->position[corner[0]];
    Vec3 across =
        vec3_cross(vec3_sub(mesh->position[corner[1]], a), vec3_sub(mesh->position[corner[2]], a));
    SurfacePoint point = {.object_position = mesh->position[vertex],
                          .normal = mesh->normal ? mesh->normal[vertex] : vec3_normalize(across),
                          .uv = mesh->uv ? mesh->uv[vertex] : (Vec2){0, 0},
                          .radius = mesh->radius ? mesh->radius[vertex] : 0.0f,
                          .birth = mesh->birth ? mesh->birth[vertex] : 0.0f,
                          .site = mesh->site ? mesh->site[vertex] : (Vec2){0, 0},
                          .variation = look.variation,
                          .season = look.season,
                          .footprint = sqrtf(vec3_length(across))};
    export_tangents(mesh, corner, &point.tangent_u, &point.tangent_v);
    point.position = place ? transform_point(place, point.object_position) : point.object_position;
    point.lifted = point.position;
    point.facet_normal = point.geometric_normal = point.normal;
    return point;
}

// One face of each vertex; -1 if it has none.
static int64_t *faces_of(const Mesh *mesh, Error *e)
{
    int64_t *face = memory_alloc(mesh->vertex_count, sizeof *face, e);
    for (int64_t v = 0; face && v < mesh->vertex_count; v++) {
        face[v] = -1;
    }
    for (int64_t i = mesh->face_count * mesh->face_size - 1; face && i >= 0; i--) {
        face[mesh->index[i]] = i / mesh->face_size;
    }
    return face;
}

bool pov_shade_mesh(const Material *m, const Mesh *mesh, const Transform *place, InstanceLook look,
                    const Run *run, PovShades *shades, Error *e)
{
    bool bumped = m->pattern_depth > 0.0f && mesh->normal;
    int64_t *face = faces_of(mesh, e);
    if (!face || !shades_new(shades, mesh->vertex_count, bumped, e)) {
        free(face);
        return false;
    }
#pragma omp parallel for schedule(dynamic, 1024) num_threads(run->threads)
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        PatternShade shade = {m->color, m->transmittance, vec3(0.0f, 1.0f, 0.0f), 0.0f,
                              m->roughness};
        if (face[v] >= 0) {
            SurfacePoint point = vertex_point(mesh, (uint32_t)v, face[v], place, look);
            shade = shade_at(m, &point);
        }
        shades->color[v] = shade.color;
        shades->transmittance[v] = shade.transmittance;
        if (bumped) {
            shades->normal[v] = shade.normal;
        }
    }
    free(face);
    return true;
}

// ---- curves

// Averages four sides of the segment's middle, for patterns that vary around it.
static Vec3 segment_color(const Material *m, const CurveSet *curves, int64_t i)
{
    Vec3 axis = vec3_sub(curves->position[i + 1], curves->position[i]);
    Vec3 along = vec3_normalize(axis), side = vec3_perpendicular(along), sum = {0, 0, 0};
    float radius = 0.5f * (curves->radius[i] + curves->radius[i + 1]);
    for (int k = 0; k < 4; k++) {
        SurfacePoint point = {.normal = side,
                              .facet_normal = side,
                              .geometric_normal = side,
                              .tangent_u = vec3_cross(along, side),
                              .tangent_v = along,
                              .radius = radius,
                              .variation = 0.5f,
                              .footprint = fmaxf(radius, 0.5f * vec3_length(axis))};
        point.position = vec3_madd(vec3_madd(curves->position[i], 0.5f, axis), radius, side);
        point.lifted = point.object_position = point.position;
        if (curves->birth) {
            point.birth = 0.5f * (curves->birth[i] + curves->birth[i + 1]);
        }
        if (curves->along) {
            point.uv.y = 0.5f * (curves->along[i] + curves->along[i + 1]);
        }
        sum = vec3_madd(sum, 0.25f, shade_at(m, &point).color);
        side = point.tangent_u;
    }
    return sum;
}

bool pov_shade_curves(const Material *m, const CurveSet *curves, PovShades *shades, Error *e)
{
    if (!shades_new(shades, curves->point_count - curves->curve_count, false, e)) {
        return false;
    }
    int64_t n = 0;
    for (int64_t k = 0; k < curves->curve_count; k++) {
        for (int64_t i = curves->first[k]; i + 1 < curves->first[k + 1]; i++, n++) {
            if (material_has(m, TRAIT_EMISSIVE)) {
                float glow = curves->glow ? 0.5f * (curves->glow[i] + curves->glow[i + 1]) : 1.0f;
                shades->color[n] = vec3_scale(m->radiance, glow);
            } else if (material_has_pattern(m) || material_varies(m)) {
                shades->color[n] = segment_color(m, curves, i);
            } else {
                shades->color[n] = m->color;
            }
            shades->transmittance[n] = m->transmittance;
        }
    }
    return true;
}

// ---- instances

// At most this many faces are sampled for the mean of a mesh.
enum { MEAN_FACES = 32 };

// Interpolates inside of a triangle, because vertices lie on veins and edges more often than the
// surface does.
static SurfacePoint inner_point(const Mesh *mesh, int64_t face, const uint32_t corner[3],
                                const float weight[3], const Transform *place, InstanceLook look)
{
    SurfacePoint point = vertex_point(mesh, corner[0], face, place, look);
    Vec3 p = {0, 0, 0}, normal = {0, 0, 0};
    point.uv = point.site = (Vec2){0, 0};
    point.radius = point.birth = 0.0f;
    for (int k = 0; k < 3; k++) {
        uint32_t v = corner[k];
        float w = weight[k];
        p = vec3_madd(p, w, mesh->position[v]);
        normal = mesh->normal ? vec3_madd(normal, w, mesh->normal[v]) : point.normal;
        point.uv.x += mesh->uv ? w * mesh->uv[v].x : 0.0f;
        point.uv.y += mesh->uv ? w * mesh->uv[v].y : 0.0f;
        point.site.x += mesh->site ? w * mesh->site[v].x : 0.0f;
        point.site.y += mesh->site ? w * mesh->site[v].y : 0.0f;
        point.radius += mesh->radius ? w * mesh->radius[v] : 0.0f;
        point.birth += mesh->birth ? w * mesh->birth[v] : 0.0f;
    }
    point.object_position = p;
    point.position = point.lifted = place ? transform_point(place, p) : p;
    point.normal = point.facet_normal = point.geometric_normal = vec3_normalize(normal);
    return point;
}

static void mean_shade(const Material *m, const Part *part, int64_t instance, PovShades *shades)
{
    static const float inside[3][3] = {{2.0f / 3, 1.0f / 6, 1.0f / 6},
                                       {1.0f / 6, 2.0f / 3, 1.0f / 6},
                                       {1.0f / 6, 1.0f / 6, 2.0f / 3}};
    const Mesh *mesh = part->mesh;
    Vec3 color = {0, 0, 0}, transmittance = {0, 0, 0};
    float sum = 0.0f;
    InstanceLook look = part_look(part, instance);
    for (int64_t f = 0; f < mesh->face_count; f += mesh->face_count / MEAN_FACES + 1) {
        uint32_t corner[6];
        for (int t = 3 * export_face_triangles(mesh, f, false, corner) - 3; t >= 0; t -= 3) {
            Vec3 a = mesh->position[corner[t]];
            float area = vec3_length(vec3_cross(vec3_sub(mesh->position[corner[t + 1]], a),
                                                vec3_sub(mesh->position[corner[t + 2]], a)));
            for (int k = 0; k < 3; k++) {
                SurfacePoint point =
                    inner_point(mesh, f, corner + t, inside[k], &part->instance[instance], look);
                PatternShade shade = shade_at(m, &point);
                color = vec3_madd(color, area, shade.color);
                transmittance = vec3_madd(transmittance, area, shade.transmittance);
                sum += area;
            }
        }
    }
    float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    shades->color[instance] = vec3_scale(color, scale);
    shades->transmittance[instance] = vec3_scale(transmittance, scale);
}

bool pov_shade_instances(const Material *m, const Part *part, const Run *run, PovShades *shades,
                         Error *e)
{
    if (!shades_new(shades, part->instance_count, false, e)) {
        return false;
    }
#pragma omp parallel for schedule(dynamic, 256) num_threads(run->threads)
    for (int64_t i = 0; i < part->instance_count; i++) {
        mean_shade(m, part, i, shades);
    }
    return true;
}
