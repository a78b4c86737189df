#include "objects/coral/crust.h"

#include "base/memory.h"
#include "base/noise.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

// Distances from p to the nearest node of the nearest colony, and of any other colony.
static int32_t nearest_two(const OutTree *tree, Vec3 p, float *own, float *other)
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
    return colony;
}

// Spatial noise from two plane noises; about -1..1.
static float swelling(Vec3 p, uint64_t seed)
{
    return noise_plane_fractal(p.x + 0.37f * p.y, p.z, 3, seed) +
           noise_plane_fractal(p.y, p.x - 0.37f * p.z, 3, seed + 1);
}

CrustPoint crust_at(const OutTree *tree, const CrustParams *params, Vec3 p)
{
    float own, other;
    CrustPoint point = {.colony = nearest_two(tree, p, &own, &other)};
    float wave = swelling(vec3_scale(p, 1.0f / params->lump), params->seed);
    // m inside the margin: from the end of the nodes' reach, and from the seam
    float reach = params->reach * (0.8f + 0.25f * wave) - own;
    float inside = 0.5f * (other - own) - params->seam;
    inside = inside < reach ? inside : reach;
    point.margin = clampf(1.0f - inside / params->pale, 0.0f, 1.0f);
    if (inside <= 0.0f) {
        point.height = -0.25f * params->thickness;
        return point;
    }
    float t = clampf(inside / params->thickness, 0.0f, 1.0f);
    float lip = sqrtf(t * (2.0f - t)); // a rounded rim
    point.height =
        params->thickness * (lip * (0.9f + 0.5f * wave) - 0.25f * (1.0f - t) * (1.0f - t));
    return point;
}

CrustPoint *crust_points(const Mesh *rock, const OutTree *tree, const CrustParams *params,
                         const Run *run, Error *e)
{
    enum { PART = 4096 };
    CrustPoint *points = memory_alloc(rock->vertex_count, sizeof *points, e);
    if (!points) {
        return NULL;
    }
    for (int64_t part = 0; part < rock->vertex_count; part += (int64_t)PART * 16) {
        int64_t end = part + (int64_t)PART * 16;
        end = end < rock->vertex_count ? end : rock->vertex_count;
        if (run_is_cancelled(run)) {
            run_cancel_error(e);
            free(points);
            return NULL;
        }
#pragma omp parallel for schedule(static) num_threads(run->threads) if (run->threads > 1)
        for (int64_t i = part; i < end; i++) {
            points[i] = crust_at(tree, params, rock->position[i]);
        }
    }
    return points;
}

static bool is_covered(const Mesh *rock, const CrustPoint *points, int64_t face, int32_t colony)
{
    bool above = false;
    for (int k = 0; k < rock->face_size; k++) {
        const CrustPoint *p = &points[rock->index[face * rock->face_size + k]];
        if (p->colony != colony) {
            return false;
        }
        above = above || p->height > 0.0f;
    }
    return above;
}

// Numbers the vertices in use; -1 = not in use. Returns how many.
static int64_t number_vertices(const Mesh *rock, const CrustPoint *points, int32_t colony,
                               int64_t *number, int64_t *faces)
{
    int64_t count = 0;
    *faces = 0;
    for (int64_t i = 0; i < rock->vertex_count; i++) {
        number[i] = -1;
    }
    for (int64_t f = 0; f < rock->face_count; f++) {
        if (!is_covered(rock, points, f, colony)) {
            continue;
        }
        ++*faces;
        for (int k = 0; k < rock->face_size; k++) {
            int64_t *n = &number[rock->index[f * rock->face_size + k]];
            *n = *n < 0 ? count++ : *n;
        }
    }
    return count;
}

Mesh *crust_mesh(const Mesh *rock, const CrustPoint *points, int32_t colony, Error *e)
{
    int64_t *number = memory_alloc(rock->vertex_count, sizeof *number, e), faces;
    if (!number) {
        return NULL;
    }
    int64_t vertices = number_vertices(rock, points, colony, number, &faces);
    Mesh *mesh = mesh_new(rock->face_size, vertices, faces, MESH_BIRTH, e);
    for (int64_t i = 0; mesh && i < rock->vertex_count; i++) {
        if (number[i] >= 0) {
            mesh->birth[number[i]] = points[i].margin;
            mesh->position[number[i]] =
                vec3_madd(rock->position[i], points[i].height, rock->normal[i]);
        }
    }
    uint32_t *index = mesh ? mesh->index : NULL;
    for (int64_t f = 0; mesh && f < rock->face_count; f++) {
        for (int k = 0; k < rock->face_size && is_covered(rock, points, f, colony); k++) {
            *index++ = (uint32_t)number[rock->index[f * rock->face_size + k]];
        }
    }
    free(number);
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
