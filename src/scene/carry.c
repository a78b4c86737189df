#include "scene/carry.h"

#include "base/memory.h"

#include <math.h>

// Of the size of what is carried: the step of finite differences.
#define DIFFERENCE 1e-3f

typedef struct Carried {
    const Deformation *deformation;
    Transform to_scene, to_own;
    const Run *run;
} Carried;

static Vec3 carry(const Carried *c, Vec3 p)
{
    Vec3 at = deformation_carry(c->deformation, transform_point(&c->to_scene, p));
    return transform_point(&c->to_own, at);
}

// The inverse of a rotation and a translation.
static Transform rigid_inverse(const Transform *t)
{
    Transform inverse = transform_identity();
    for (int i = 0; i < 3; i++) {
        inverse.m[i][3] = 0.0f;
        for (int k = 0; k < 3; k++) {
            inverse.m[i][k] = t->m[k][i];
            inverse.m[i][3] -= t->m[k][i] * t->m[k][3];
        }
    }
    return inverse;
}

bool carry_tree(const Deformation *deformation, const Transform *to_scene, OutTree *tree,
                const Run *run, Error *e)
{
    Carried c = {deformation, *to_scene, rigid_inverse(to_scene), run};
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < tree->count; i++) {
        box = aabb_add(box, tree->position[i]);
    }
    float step = tree->count > 0 ? DIFFERENCE * vec3_distance(box.low, box.high) : 0.0f;
#pragma omp parallel for schedule(dynamic, 64) num_threads(run->threads)
    for (int64_t i = 0; i < tree->count; i++) {
        if (!run_is_cancelled(run)) {
            Vec3 p = tree->position[i], n = tree->normal[i], at = carry(&c, p);
            Vec3 tip = carry(&c, vec3_madd(p, step, n));
            Vec3 way = vec3_sub(tip, at);
            tree->position[i] = at;
            tree->normal[i] = vec3_dot(way, way) > 0.0f ? vec3_normalize(way) : n;
        }
    }
    return !run_is_cancelled(run) || run_cancel_error(e);
}

static bool carry_points(const Deformation *deformation, Vec3 *position, int64_t count,
                         const Run *run, Error *e)
{
#pragma omp parallel for schedule(dynamic, 256) num_threads(run->threads)
    for (int64_t i = 0; i < count; i++) {
        if (!run_is_cancelled(run)) {
            position[i] = deformation_carry(deformation, position[i]);
        }
    }
    return !run_is_cancelled(run) || run_cancel_error(e);
}

// Small copies, such as tufts of frost, are carried whole.
static bool carry_copies(const Deformation *deformation, Part *part, const Run *run, Error *e)
{
    bool done = true;
    for (int64_t i = 0; done && i < part->instance_count; i++) {
        Transform *t = &part->instance[i];
        Vec3 foot = deformation_carry(deformation, transform_point(t, vec3(0, 0, 0)));
        *t = transform_from_axes(transform_vector(t, vec3(1, 0, 0)),
                                 transform_vector(t, vec3(0, 1, 0)),
                                 transform_vector(t, vec3(0, 0, 1)), foot);
        done = run_goes_on(run, i, e);
    }
    return done;
}

bool carry_parts(const Deformation *deformation, Geometry *geometry, int64_t first, const Run *run,
                 Error *e)
{
    bool done = true;
    for (int64_t i = first; done && i < geometry->count; i++) {
        Part *part = &geometry->part[i];
        Mesh *mesh = part->mesh;
        if (part->instance) {
            done = carry_copies(deformation, part, run, e);
            continue;
        }
        done = !mesh || (carry_points(deformation, mesh->position, mesh->vertex_count, run, e) &&
                         (!mesh->normal || mesh_compute_normals(mesh, e)));
    }
    return done;
}
