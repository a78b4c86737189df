#include "render/accel/accel_detail.h"

// Thinner curves become tubes: in units of the detail. The outline of a tube of CURVE_TUBE_SIDES is
// then off by less than the detail.
#define THIN 5.0f

static float nearest_view(const Views *views, Vec3 p)
{
    float nearest = INFINITY;
    for (int i = 0; i < views->count; i++) {
        Vec3 way = vec3_sub(views->eye[i], p);
        nearest = fminf(nearest, vec3_dot(way, way));
    }
    return sqrtf(nearest);
}

static Vec3 column(const Transform *t, int i)
{
    return vec3(t->m[0][i], t->m[1][i], t->m[2][i]);
}

// Largest factor by which the transform stretches one of the axes.
static float largest_scale(const Transform *t)
{
    float largest = 0.0f;
    for (int i = 0; i < 3; i++) {
        Vec3 axis = column(t, i);
        largest = fmaxf(largest, vec3_dot(axis, axis));
    }
    return sqrtf(largest);
}

float detail_reach(const Mesh *mesh)
{
    float reach = 0.0f;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        reach = fmaxf(reach, vec3_dot(mesh->position[i], mesh->position[i]));
    }
    return sqrtf(reach);
}

int detail_level(const Part *part, int64_t instance, float reach, const Views *views)
{
    if (views->count == 0 || views->detail <= 0.0f) {
        return 0;
    }
    const Transform *t = &part->instance[instance];
    float scale = largest_scale(t);
    float distance = nearest_view(views, column(t, 3)) - scale * reach;
    float most = views->detail * views->pixel_angle * distance;
    int level = 0;
    while (level < PART_COARSE_MOST && part->coarse[level].mesh &&
           part->coarse[level].error * scale < most) {
        level++;
    }
    return level;
}

static bool all_thin(const CurveSet *curves, const Views *views)
{
    float pixels = THIN * views->detail * views->pixel_angle;
    for (int64_t i = 0; i < curves->point_count; i++) {
        if (curves->radius[i] > pixels * nearest_view(views, curves->position[i])) {
            return false;
        }
    }
    return true;
}

bool detail_is_thin(const Part *part, const Views *views)
{
    const CurveSet *curves = part->curves;
    if (views->count == 0 || views->detail <= 0.0f) {
        return false;
    }
    if (!part->instance) {
        return all_thin(curves, views);
    }
    float reach = 0.0f, thickest = 0.0f;
    for (int64_t i = 0; i < curves->point_count; i++) {
        reach = fmaxf(reach, vec3_length(curves->position[i]));
        thickest = fmaxf(thickest, curves->radius[i]);
    }
    for (int64_t i = 0; i < part->instance_count; i++) {
        const Transform *t = &part->instance[i];
        float scale = largest_scale(t);
        float distance = nearest_view(views, column(t, 3)) - scale * reach;
        if (thickest * scale > THIN * views->detail * views->pixel_angle * distance) {
            return false;
        }
    }
    return true;
}
