#include "render/accel/accel_relief.h"

#include "render/material/relief.h"

// Triangles of all: about 250 bytes each with their vertices and Embree's tree.
enum { MOST_FACES = 8000000 };

// Relief fades from bumps to geometry while its height grows between these numbers of pixels.
#define LEAST_HEIGHT 1.0f
#define WHOLE_HEIGHT 2.5f

// Longest edges, in pixels at the default detail of 0.3; how much longer what is out of the picture
// or turned away may be: it is seen by light alone.
#define LONGEST_EDGE 1.5f
#define OUTSIDE 8.0f
#define TURNED_AWAY 3.0f

typedef struct ReliefRule {
    const ReliefView *view;
    const Part *part;
    const Material *material;
    float edge; // pixels
} ReliefRule;

static float nearest_eye(const Views *views, Vec3 p)
{
    float nearest = INFINITY;
    for (int i = 0; i < views->count; i++) {
        Vec3 way = vec3_sub(views->eye[i], p);
        nearest = fminf(nearest, vec3_dot(way, way));
    }
    return sqrtf(nearest);
}

static float share_of(float size, float pixel)
{
    return smoothstepf(LEAST_HEIGHT, WHOLE_HEIGHT, size / pixel);
}

// May something within `reach` of p be in the picture?
static bool may_show(const ReliefView *view, Vec3 p, float reach)
{
    const CameraFrame *frame = view->frame;
    Vec3 way = vec3_sub(p, frame->position);
    float depth = vec3_dot(way, frame->forward);
    if (depth < reach) {
        return depth > -reach;
    }
    Vec3 at = vec3_sub(vec3_scale(way, 1.0f / depth), frame->corner);
    float pixel2 = vec3_dot(frame->across, frame->across);
    float x = vec3_dot(at, frame->across) / pixel2, y = vec3_dot(at, frame->down) / pixel2;
    float lens = vec3_length(frame->lens_x) * fabsf(depth / frame->focus - 1.0f);
    float room = (reach + lens) / (depth * frame->pixel_angle) + 0.04f * (float)view->width;
    return x > -room && y > -room && x < (float)view->width + room &&
           y < (float)view->height + room;
}

static bool turns_away(const Views *views, const DicePoint *p)
{
    bool away = true;
    for (int i = 0; away && i < views->count; i++) {
        Vec3 way = vec3_sub(views->eye[i], p->position);
        away = vec3_dot(way, p->normal) < -0.35f * vec3_length(way);
    }
    return away;
}

static float longest_edge(const void *user, const DicePoint *a, const DicePoint *b)
{
    const ReliefRule *rule = user;
    const Views *views = rule->view->views;
    if (relief_spares(rule->material, a->normal, b->normal)) {
        return INFINITY;
    }
    Vec3 middle = vec3_scale(vec3_add(a->position, b->position), 0.5f);
    float size = relief_size(rule->material, fmaxf(a->radius, b->radius));
    float reach = 0.5f * vec3_distance(a->position, b->position);
    float pixel = views->pixel_angle * fmaxf(nearest_eye(views, middle) - reach, 1e-3f);
    if (share_of(size, pixel) <= 0.0f) {
        return INFINITY;
    }
    float factor = 1.0f;
    if (rule->view->frame && !may_show(rule->view, middle, reach + size)) {
        factor = OUTSIDE;
    } else if (turns_away(views, a) && turns_away(views, b)) {
        factor = TURNED_AWAY;
    }
    return factor * rule->edge * pixel;
}

// The pattern is taken as of wider pixels where edges are longer, or its finest octaves alias.
static float height_at(const void *user, const DicePoint *p, float coarsening, float *share)
{
    const ReliefRule *rule = user;
    float pixel = rule->view->views->pixel_angle * nearest_eye(rule->view->views, p->position);
    *share = share_of(relief_size(rule->material, p->radius), pixel);
    if (*share <= 0.0f) {
        return 0.0f;
    }
    SurfacePoint point = {.position = p->position,
                          .lifted = p->position,
                          .object_position = p->position,
                          .facet_normal = p->normal,
                          .geometric_normal = p->normal,
                          .smooth_normal = p->normal,
                          .normal = p->normal,
                          .along = p->along,
                          .uv = p->uv,
                          .has_uv = rule->part->mesh->uv,
                          .radius = p->radius,
                          .birth = p->birth,
                          .site = p->site,
                          .shore = p->shore,
                          .strata = rule->part->mesh->strata,
                          .footprint = coarsening * pixel,
                          .material = rule->part->material,
                          .object = rule->part->object};
    point.tangent_u = vec3_cross(p->along, p->normal);
    point.tangent_v = p->along;
    return *share * relief_height(rule->view->set, &point);
}

// Radius of the thickest stem; 0 without stems.
static float thickest(const Mesh *mesh)
{
    float most = 0.0f;
    for (int64_t i = 0; mesh->radius && i < mesh->vertex_count; i++) {
        most = fmaxf(most, mesh->radius[i]);
    }
    return most;
}

static bool is_near(const ReliefRule *rule, float size)
{
    const Views *views = rule->view->views;
    Aabb box = mesh_bounds(rule->part->mesh);
    bool near = false;
    for (int i = 0; !near && i < views->count; i++) {
        Vec3 eye = views->eye[i];
        Vec3 clamped = vec3_min(vec3_max(eye, box.low), box.high);
        near = size > LEAST_HEIGHT * views->pixel_angle * vec3_distance(eye, clamped);
    }
    return near;
}

bool accel_relief_dice(const ReliefView *view, const Part *part, const Run *run, DicedMesh *diced,
                       Error *e)
{
    const Material *material = &view->material[part->material];
    ReliefRule rule = {.view = view, .part = part, .material = material, .edge = LONGEST_EDGE};
    *diced = (DicedMesh){.coarsening = 1.0f};
    if (part->kind != PART_MESH || part->instance || !part->mesh->normal ||
        relief_size(material, 1.0f) <= 0.0f || view->views->count == 0 ||
        !is_near(&rule, relief_size(material, thickest(part->mesh)))) {
        return true;
    }
    if (view->views->detail > 0.0f) {
        rule.edge *= view->views->detail / 0.3f;
    }
    const DiceRule dice = {longest_edge, height_at, &rule, MOST_FACES};
    if (!mesh_dice(part->mesh, &dice, run, diced, e)) {
        return false;
    }
    if (diced->coarsening > 1.0f) {
        run_warn(run,
                 "material '%s': its relief near the camera needs more than %d million triangles; "
                 "their edges are %.1f times as long as wanted",
                 material->name, MOST_FACES / 1000000, (double)diced->coarsening);
    }
    return true;
}
