#include "export/vertex_colors.h"

#include "base/memory.h"
#include "export/vertex.h"
#include "render/material/pattern.h"
#include "render/world.h"

#include <stdlib.h>

bool vertex_colors_wanted(const ExportOptions *options, const Material *material)
{
    return (options->colors == EXPORT_COLORS_ALL || options->colors == EXPORT_COLORS_PATTERN) &&
           material_has_pattern(material);
}

// last: is it the last point of its curve?
static SurfacePoint curve_point(const CurveSet *curves, int64_t i, bool last)
{
    int64_t from = last ? i - 1 : i;
    Vec3 step = vec3_sub(curves->position[from + 1], curves->position[from]);
    Vec3 axis = vec3_normalize(step);
    axis = vec3_dot(axis, axis) > 0.0f ? axis : vec3(0, 1, 0);
    SurfacePoint point = {.position = curves->position[i], .variation = 0.5f};
    point.geometric_normal = point.facet_normal = point.normal = vec3_perpendicular(axis);
    point.lifted = point.object_position = point.position;
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
    PatternShade shade = {material->color, material->transmittance, point->normal, 0.0f,
                          material->roughness};
    pattern_apply(material, point, &shade);
    return vec3_max(vec3_min(shade.color, vec3_splat(1.0f)), vec3_splat(0.0f));
}

static bool color_mesh(const Material *material, const Part *part, const Run *run, Vec3 *color,
                       Error *e)
{
    enum { BLOCK = 8192 };
    int64_t count = part->mesh->vertex_count;
    ExportSurface surface = {0};
    ExportVertex *vertex = memory_alloc(BLOCK, sizeof *vertex, e);
    bool done = vertex && export_surface_prepare(&surface, part->mesh, material,
                                                 EXPORT_WANTS_NORMALS | EXPORT_WANTS_COLORS, e);
    for (int64_t i = 0; done && i < count && !run_is_cancelled(run); i += BLOCK) {
        int64_t most = count - i < BLOCK ? count - i : BLOCK;
        export_surface_vertices(&surface, NULL, (InstanceLook){part->instance ? -1.0f : 0.5f, 0.0f},
                                i, most, run->threads, vertex);
        for (int64_t k = 0; k < most; k++) {
            color[i + k] = vertex[k].color;
        }
    }
    export_surface_clear(&surface);
    free(vertex);
    return done;
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
        done = color_mesh(&material, part, run, color, e);
    } else if (done) {
        color_curves(&material, part->curves, run, color);
    }
    if (!done || run_is_cancelled(run)) {
        free(color);
        return done ? (run_cancel_error(e), NULL) : NULL;
    }
    return color;
}
