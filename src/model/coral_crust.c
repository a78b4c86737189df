#include "model/coral_crust.h"

#include "base/noise.h"

#include <math.h>
#include <stddef.h>

// Distances from p to the nearest node of the colony that is nearest, and of any other.
static void nearest_two(const OutTree *tree, Vec3 p, float *own, float *other)
{
    float best = INFINITY, second = INFINITY;
    int32_t colony = -1;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 d = vec3_sub(tree->position[i], p);
        float d2 = vec3_dot(d, d);
        if (tree->colony[i] == colony) {
            best = d2 < best ? d2 : best;
        } else if (d2 < best) {
            second = colony >= 0 ? best : second;
            best = d2;
            colony = tree->colony[i];
        } else if (d2 < second) {
            second = d2;
        }
    }
    *own = sqrtf(best);
    *other = sqrtf(second);
}

// Three planes of noise make one of space; about -1..1.
static float swelling(Vec3 p, uint64_t seed)
{
    return noise_plane_fractal(p.x + 0.37f * p.y, p.z, 2, seed) +
           noise_plane_fractal(p.y, p.x - 0.37f * p.z, 2, seed + 1);
}

float crust_height(const OutTree *tree, const CrustParams *params, Vec3 p, float *margin)
{
    float own, other;
    nearest_two(tree, p, &own, &other);
    float wave = swelling(vec3_scale(p, 1.0f / params->lump), params->seed);
    // metres inside the margin: from where the nodes' reach ends, and from the seam
    float reach = params->reach * (0.8f + 0.25f * wave) - own;
    float inside = 0.5f * (other - own) - params->seam;
    inside = inside < reach ? inside : reach;
    float t = clampf(inside / params->thickness, 0.0f, 1.0f);
    *margin = clampf(1.0f - inside / params->pale, 0.0f, 1.0f);
    if (inside <= 0.0f) {
        return -0.25f * params->thickness;
    }
    float lip = sqrtf(t * (2.0f - t)); // a rounded rim
    return params->thickness * (lip * (0.9f + 0.5f * wave) - 0.25f * (1.0f - t) * (1.0f - t));
}

Mesh *crust_mesh(const Mesh *rock, const OutTree *tree, const CrustParams *params, const Run *run,
                 Error *e)
{
    Mesh *mesh = mesh_new(rock->face_size, rock->vertex_count, rock->face_count, MESH_BIRTH, e);
    if (!mesh) {
        return NULL;
    }
    for (int64_t i = 0; i < rock->face_count * rock->face_size; i++) {
        mesh->index[i] = rock->index[i];
    }
#pragma omp parallel for schedule(static) num_threads(run->threads) if (run->threads > 1)
    for (int64_t i = 0; i < rock->vertex_count; i++) {
        float height = crust_height(tree, params, rock->position[i], &mesh->birth[i]);
        mesh->position[i] = vec3_madd(rock->position[i], height, rock->normal[i]);
    }
    if (run_is_cancelled(run)) {
        run_cancel_error(e);
        mesh_free(mesh);
        return NULL;
    }
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
