#include "objects/venation/vein_curves.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "outtree/join.h"

#include <math.h>
#include <stdlib.h>

Vec3 venation_bend(const VenationParams *params, Vec3 p)
{
    float sine, cosine;
    exact_sincos(params->fold * RADIANS_PER_DEGREE, &sine, &cosine);
    float side = fabsf(p.x), z = p.z + side * sine;
    float x = p.x * cosine, length = params->outline.length;
    float angle = params->curl * RADIANS_PER_DEGREE;
    if (angle == 0.0f) {
        return vec3(x, p.y, z);
    }
    float radius = length / angle; // of the circle that the midrib follows
    float turn = p.y > 0.0f ? p.y / radius : 0.0f;
    exact_sincos(turn, &sine, &cosine);
    float y = p.y > 0.0f ? (radius + z) * sine : p.y;
    return vec3(x, y, (radius + z) * cosine - radius);
}

// ---- smoothing ----

// What drawing needs to know about the nodes.
typedef struct Course {
    Vec3 *position; // smoothed
    Vec3 *next;     // of the pass in work
    int32_t *main;  // the thickest child, or -1
    bool *fixed;    // shares its place with another node
} Course;

static void course_free(Course *course)
{
    free(course->position);
    free(course->next);
    free(course->main);
    free(course->fixed);
}

static bool course_init(Course *course, const OutTree *tree, Error *e)
{
    int64_t n = tree->count;
    course->position = memory_alloc(n, sizeof *course->position, e);
    course->next = memory_alloc(n, sizeof *course->next, e);
    course->main = memory_alloc(n, sizeof *course->main, e);
    course->fixed = out_tree_find_joined(tree, e);
    if (!course->position || !course->next || !course->main || !course->fixed) {
        return false;
    }
    for (int64_t i = 0; i < n; i++) {
        course->position[i] = tree->position[i];
        course->main[i] = -1;
        int32_t parent = tree->parent[i];
        if (parent >= 0 &&
            (course->main[parent] < 0 || tree->radius[i] > tree->radius[course->main[parent]])) {
            course->main[parent] = (int32_t)i;
        }
    }
    return true;
}

// Moves every node half-way to the middle of its neighbours along the thickest way.
static void smooth(Course *course, const OutTree *tree)
{
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = course->position[i];
        int32_t parent = tree->parent[i], child = course->main[i];
        if (parent >= 0 && child >= 0 && !course->fixed[i]) {
            Vec3 middle = vec3_lerp(course->position[parent], course->position[child], 0.5f);
            p = vec3_lerp(p, middle, 0.5f);
        }
        course->next[i] = p;
    }
    Vec3 *old = course->position;
    course->position = course->next;
    course->next = old;
}

// Clear the course after a failure, too.
static bool course_smoothed(Course *course, const OutTree *tree, int passes, Error *e)
{
    if (!course_init(course, tree, e)) {
        return false;
    }
    for (int pass = 0; pass < passes; pass++) {
        smooth(course, tree);
    }
    return true;
}

// ---- curves ----

// Does a vein of this radius lie in the blade?
static bool is_embedded(const VenationParams *params, float radius)
{
    return params->blade && radius < params->embedded;
}

// The radius of the tube: a vein sinks into the blade as it gets thinner, so that none ends in it
// with a step.
static float tube_radius(const VenationParams *params, float radius)
{
    if (!params->blade || params->embedded == 0.0f) {
        return radius;
    }
    float e = fminf(params->embedded, radius), least = 0.02f * radius;
    return fmaxf(sqrtf(radius * radius - e * e), least);
}

// Is there a tube for the piece up to this node? A vein in the blade is painted on it, and one that
// insects have eaten with the blade is gone.
static bool is_tube(const OutTree *tree, const Course *course, const VenationParams *params,
                    const Relief *relief, int64_t node)
{
    int32_t parent = tree->parent[node];
    return parent >= 0 && !is_embedded(params, tree->radius[node]) &&
           !(blade_wear_depth(&relief->wear, course->position[node]) > 0.0f) &&
           !(blade_wear_depth(&relief->wear, course->position[parent]) > 0.0f);
}

static CurveSet *make_curves(const OutTree *tree, const Course *course,
                             const VenationParams *params, const Relief *relief,
                             const Transform *place, Error *e)
{
    int64_t pieces = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        pieces += is_tube(tree, course, params, relief, i);
    }
    CurveSet *curves = curves_new(2 * pieces, pieces, e);
    int64_t last = tree->count > 0 ? tree->birth[tree->count - 1] : 0, point = 0;
    for (int64_t i = 0; curves && i < tree->count; i++) {
        if (!is_tube(tree, course, params, relief, i)) {
            continue;
        }
        const int64_t end[2] = {tree->parent[i], i};
        for (int k = 0; k < 2; k++, point++) {
            bool tapers = params->smoothing > 0 && course->main[end[0]] == i;
            Vec3 p = course->position[end[k]];
            p.z += relief_at(relief, p);
            curves->position[point] = transform_point(place, venation_bend(params, p));
            // a branch begins with its own radius, not with that of the vein it leaves
            curves->radius[point] = tube_radius(params, tree->radius[tapers ? end[k] : i]);
            curves->birth[point] = last > 0 ? (float)tree->birth[end[k]] / (float)last : 0.0f;
            curves->along[point] = tree->position[end[k]].y;
            curves->first[point / 2 + 1] = point + 1;
        }
    }
    return curves;
}

Vec3 *venation_smoothed(const OutTree *tree, int passes, Error *e)
{
    Course course = {0};
    Vec3 *position = NULL;
    if (course_smoothed(&course, tree, passes, e)) {
        position = course.position;
        course.position = NULL;
    }
    course_free(&course);
    return position;
}

CurveSet *venation_curves(const OutTree *tree, const VenationParams *params, const Relief *relief,
                          const Transform *place, Error *e)
{
    Course course = {0};
    CurveSet *curves = NULL;
    if (course_smoothed(&course, tree, params->smoothing, e)) {
        curves = make_curves(tree, &course, params, relief, place, e);
    }
    course_free(&course);
    return curves;
}
