#include "mesh/geometry_measure.h"

#include <math.h>

Aabb part_bounds(const Part *part)
{
    if (part->kind == PART_MESH) {
        return mesh_bounds(part->mesh);
    }
    Aabb box = aabb_empty();
    const CurveSet *curves = part->curves;
    for (int64_t i = 0; i < curves->point_count; i++) {
        Vec3 p = curves->position[i], radius = vec3_splat(curves->radius[i]);
        box = aabb_add(aabb_add(box, vec3_sub(p, radius)), vec3_add(p, radius));
    }
    return box;
}

Aabb geometry_bounds(const Geometry *geometry, int64_t first)
{
    Aabb box = aabb_empty();
    for (int64_t i = first; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        Aabb own = part_bounds(part);
        if (!part->instance) {
            box = aabb_union(box, own);
        }
        for (int64_t k = 0; part->instance && k < part->instance_count && !aabb_is_empty(own);
             k++) {
            box = aabb_union(box, aabb_transform(own, &part->instance[k]));
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
