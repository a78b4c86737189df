#include "mesh/geometry_measure.h"

#include <math.h>

static void take_in(Aabb *box, Vec3 p)
{
    box->low = vec3_min(box->low, p);
    box->high = vec3_max(box->high, p);
}

static Aabb own_bounds(const Part *part)
{
    Aabb box = aabb_empty();
    if (part->kind == PART_MESH) {
        return mesh_bounds(part->mesh);
    }
    const CurveSet *curves = part->curves;
    for (int64_t i = 0; i < curves->point_count; i++) {
        Vec3 radius = vec3_splat(curves->radius[i]);
        take_in(&box, vec3_sub(curves->position[i], radius));
        take_in(&box, vec3_add(curves->position[i], radius));
    }
    return box;
}

// Extends the box by an instance: the corners of its own box, transformed.
static void take_in_instance(Aabb *box, Aabb own, const Transform *instance)
{
    for (int i = 0; i < 8; i++) {
        Vec3 corner = {i & 1 ? own.high.x : own.low.x, i & 2 ? own.high.y : own.low.y,
                       i & 4 ? own.high.z : own.low.z};
        take_in(box, transform_point(instance, corner));
    }
}

Aabb geometry_bounds(const Geometry *geometry, int64_t first)
{
    Aabb box = aabb_empty();
    for (int64_t i = first; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        Aabb own = own_bounds(part);
        if (aabb_is_empty(own)) {
            continue;
        }
        if (!part->instance) {
            take_in(&box, own.low);
            take_in(&box, own.high);
        }
        for (int64_t k = 0; part->instance && k < part->instance_count; k++) {
            take_in_instance(&box, own, &part->instance[k]);
        }
    }
    return box;
}

static int64_t count_materials(const Geometry *geometry)
{
    int64_t count = 0;
    for (int64_t i = 0; i < geometry->count; i++) {
        int64_t first = 0;
        while (geometry->part[first].material != geometry->part[i].material) {
            first++;
        }
        count += first == i;
    }
    return count;
}

static bool add(MeasureList *list, const char *name, double value, const char *unit, Error *e)
{
    return measures_add(list, name, value, unit, (double)NAN, (double)NAN, e);
}

bool geometry_measure(const Geometry *geometry, MeasureList *list, Error *e)
{
    GeometryCounts counts = geometry_counts(geometry);
    Aabb box = geometry_bounds(geometry, 0);
    Vec3 size = aabb_is_empty(box) ? vec3(0, 0, 0) : vec3_sub(box.high, box.low);
    return add(list, "parts", (double)geometry->count, "", e) &&
           add(list, "triangles", (double)counts.triangles, "", e) &&
           add(list, "curve_segments", (double)counts.curve_segments, "", e) &&
           add(list, "instances", (double)counts.instances, "", e) &&
           add(list, "materials", (double)count_materials(geometry), "", e) &&
           add(list, "width", (double)size.x, "m", e) &&
           add(list, "height", (double)size.y, "m", e) &&
           add(list, "depth", (double)size.z, "m", e);
}
