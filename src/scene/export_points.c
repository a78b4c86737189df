#include "scene/export_points.h"

#include "scene/making.h"

static void carry_points(const OwnSpace *own, PointSet *points)
{
    for (int64_t i = 0; own->moved && i < points->count; i++) {
        points->position[i] = transform_point(&own->to_scene, points->position[i]);
        points->normal[i] = transform_vector(&own->to_scene, points->normal[i]);
    }
}

PointSet *scene_points(const Scene *scene, int index, const Run *run, Error *e)
{
    Making m;
    PointSet *points = points_new(e);
    bool done = making_begin(&m, scene, index, run, e) && points &&
                making_grow(&m, (Shared){0}, e) && m.kind->points(&m.grown, points, e);
    if (done) {
        carry_points(&m.own, points);
    }
    if (!making_end(&m, done, e)) {
        points_free(points);
        return NULL;
    }
    return points;
}
