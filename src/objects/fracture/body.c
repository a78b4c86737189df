#include "objects/fracture/body.h"

#include "base/noise.h"
#include "base/random.h"

#include <math.h>
#include <stddef.h>

enum { BUMP_OCTAVES = 4, FINEST = 480 }; // FINEST: voxels across, unless the scene asks for more

#define FINER 1.5f       // voxels across over those of the last try
#define LOST_MOST 0.004  // of the surface: what may be thinner than the voxels can show
#define THINNEST 2.0f    // voxels of a part that a level set is sure to hold
#define WALL_VOXELS 3.0f // through a hollow body's wall

// ---- distances ----

double fracture_body_outer(const FractureBody *body, Vec3 p)
{
    float d = envelope_distance(body->envelope, p), height = body->bumps;
    if (d <= -0.9f * envelope_band(body->envelope)) {
        d = -body->depth->deepest * depth_field_at(body->depth, p);
    }
    Vec3 q = vec3_scale(p, 1.0f / body->wavelength);
    for (uint64_t k = 0; k < BUMP_OCTAVES && height > 0.0f && fabsf(d) < 3.0f * height; k++) {
        d += height * noise_space(q, random_key(body->seed, k));
        q = vec3_scale(q, 2.1f);
        height *= 0.5f;
    }
    return (double)d;
}

double fracture_body_distance(const FractureBody *body, Vec3 p)
{
    double d = fracture_body_outer(body, p);
    double inner = -(d + (double)body->hollow);
    return body->hollow > 0.0f && inner > d ? inner : d;
}

// ---- resolution ----

// Share of the envelope's surface with no body THINNEST voxels below it: a grid of such voxels may
// miss these parts.
static double lost_share(const FractureBody *body)
{
    const Mesh *mesh = envelope_surface(body->envelope);
    double lost = 0.0, all = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + (int64_t)mesh->face_size * f;
        for (int k = 1; k + 1 < mesh->face_size; k++) {
            Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[k]];
            Vec3 c = mesh->position[corner[k + 1]];
            Vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
            Vec3 middle = vec3_scale(vec3_add(a, vec3_add(b, c)), 1.0f / 3.0f);
            float area = vec3_length(n);
            if (area > 0.0f) {
                Vec3 under = vec3_madd(middle, -THINNEST * body->voxel / area, n);
                all += (double)area;
                lost += envelope_distance(body->envelope, under) >= 0.0f ? (double)area : 0.0;
            }
        }
    }
    return all > 0.0 ? lost / all : 0.0;
}

// ---- making ----

static bool make_envelope(FractureBody *body, const FractureParams *params, float voxel,
                          const Run *run, Error *e)
{
    Shape ball = {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()};
    EnvelopeParams form = {.shapes = params->element.shapes,
                           .shape_count = params->element.shape_count,
                           .voxel = voxel};
    if (form.shape_count == 0) {
        form.shapes = &ball;
        form.shape_count = 1;
    }
    envelope_free(body->envelope);
    body->envelope = envelope_new(&form, run, e);
    return body->envelope;
}

static void measure_envelope(FractureBody *body, const FractureParams *params)
{
    body->box = envelope_bounds(body->envelope);
    body->extent = aabb_extent(body->box);
    body->bumps = params->weathering * body->extent;
    body->wavelength = 0.25f * body->extent;
    Vec3 margin = vec3_splat(2.0f * body->bumps);
    body->box = (Aabb){vec3_sub(body->box.low, margin), vec3_add(body->box.high, margin)};
    body->center = vec3_lerp(body->box.low, body->box.high, 0.5f);
}

// Makes the envelope at this resolution; a mesh's level set has the voxels of the pieces.
static bool set_resolution(FractureBody *body, const FractureParams *params, float across,
                           const Run *run, Error *e)
{
    body->voxel = body->extent / across;
    bool exact = isinf(envelope_band(body->envelope)), given = params->element.voxel > 0.0f;
    if (!exact && !given) {
        Run quiet = *run; // it has already warned
        quiet.warn = NULL;
        if (!make_envelope(body, params, body->voxel, &quiet, e)) {
            return false;
        }
    }
    body->depth = envelope_depth(body->envelope, e);
    return body->depth;
}

static bool refine(FractureBody *body, const FractureParams *params, const Recipe *recipe, Error *e)
{
    float across = (float)params->resolution, most = fmaxf((float)FINEST, across);
    double lost = 0.0;
    if (params->hollow > 0.0f) {
        across = clampf(WALL_VOXELS * body->extent / params->hollow, across, most);
    }
    for (;;) {
        if (!set_resolution(body, params, across, recipe->run, e)) {
            return false;
        }
        lost = lost_share(body);
        if (lost <= LOST_MOST || across >= most) {
            break;
        }
        across = fminf(FINER * across, most);
    }
    if (lost > LOST_MOST) {
        recipe_warn(recipe, NULL,
                    "parts of the body under %.2g %% of its surface are thinner than two voxels "
                    "of %.2g m and may get lost; resolution %d or more keeps them",
                    100.0 * lost, (double)body->voxel, (int)(FINER * across));
    }
    return true;
}

bool fracture_body_new(FractureBody *body, const FractureParams *params, const Recipe *recipe,
                       Error *e)
{
    *body = (FractureBody){.hollow = params->hollow, .seed = random_key(recipe->seed, STREAM_BODY)};
    if (!make_envelope(body, params, params->element.voxel, recipe->run, e)) {
        return false;
    }
    measure_envelope(body, params);
    if (!refine(body, params, recipe, e)) {
        fracture_body_clear(body);
        return false;
    }
    return true;
}

void fracture_body_clear(FractureBody *body)
{
    envelope_free(body->envelope);
    *body = (FractureBody){0};
}
