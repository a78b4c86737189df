#include "export/bounds.h"

Aabb part_shape_bounds(const Part *part)
{
    if (part->mesh) {
        return mesh_bounds(part->mesh);
    }
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < part->curves->point_count; i++) {
        Vec3 p = part->curves->position[i], r = vec3_splat(part->curves->radius[i]);
        box = aabb_add(aabb_add(box, vec3_sub(p, r)), vec3_add(p, r));
    }
    return box;
}

Aabb part_bounds(const Part *part)
{
    Aabb shape = part_shape_bounds(part), box = aabb_empty();
    if (!part->instance || aabb_is_empty(shape)) {
        return shape;
    }
    for (int64_t i = 0; i < part->instance_count; i++) {
        box = aabb_union(box, aabb_transform(shape, &part->instance[i]));
    }
    return box;
}

Aabb geometry_bounds(const Geometry *geometry)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < geometry->count; i++) {
        box = aabb_union(box, part_bounds(&geometry->part[i]));
    }
    return box;
}
