#include "skin/skin.h"

#include "base/memory.h"
#include "mesh/refine.h"
#include "skin/cage.h"
#include "skin/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

SkinParams skin_params_default(void)
{
    return (SkinParams){.min_radius = 0.0f, .levels = 2, .ring_spacing = 1.0f, .smoothing = 2};
}

static bool check_params(const SkinParams *params, Error *e)
{
    if (!(params->min_radius >= 0.0f) || !(params->ring_spacing >= 0.1f) ||
        params->ring_spacing > 100.0f || params->levels < 0 || params->levels > 4 ||
        params->smoothing < 0) {
        return error_set(e, ERROR_INPUT,
                         "skin settings out of range; min_radius >= 0, levels 0 to 4, ring_spacing "
                         "0.1 to 100 and smoothing >= 0 are possible");
    }
    return true;
}

// Moves the finished arrays into a Mesh.
static Mesh *cage_to_mesh(SkinCage *cage, Error *e)
{
    Mesh *mesh = memory_alloc_zero(1, sizeof *mesh, e);
    if (mesh) {
        *mesh = (Mesh){.face_size = 4,
                       .vertex_count = cage->vertex_count,
                       .face_count = cage->face_count,
                       .index = cage->index,
                       .position = cage->position,
                       .uv = cage->uv,
                       .radius = cage->radius,
                       .birth = cage->birth};
        free(cage->face_axis);
        *cage = (SkinCage){0};
    }
    return mesh;
}

Mesh *skin_cage(const OutTree *tree, const SkinParams *params, const Run *run, Error *e)
{
    if (!check_params(params, e)) {
        return NULL;
    }
    SkinPlan plan;
    SkinCage cage = {0};
    Mesh *mesh = NULL;
    if (skin_plan_init(&plan, tree, params, run, e) && skin_cage_build(&cage, &plan, run, e)) {
        mesh = cage_to_mesh(&cage, e);
    }
    skin_plan_clear(&plan);
    skin_cage_clear(&cage);
    return mesh;
}

static Mesh *copy_with_normals(const Mesh *cage, Error *e)
{
    int arrays = MESH_NORMAL | (cage->uv ? MESH_UV : 0) | (cage->radius ? MESH_RADIUS : 0) |
                 (cage->birth ? MESH_BIRTH : 0);
    Mesh *copy = mesh_new(4, cage->vertex_count, cage->face_count, arrays, e);
    if (!copy) {
        return NULL;
    }
    size_t n = (size_t)cage->vertex_count;
    memcpy(copy->index, cage->index, (size_t)cage->face_count * 4 * sizeof(uint32_t));
    memcpy(copy->position, cage->position, n * sizeof(Vec3));
    if (cage->uv) {
        memcpy(copy->uv, cage->uv, n * sizeof(Vec2));
    }
    if (cage->radius) {
        memcpy(copy->radius, cage->radius, n * sizeof(float));
    }
    if (cage->birth) {
        memcpy(copy->birth, cage->birth, n * sizeof(float));
    }
    if (!mesh_compute_normals(copy, e)) {
        mesh_free(copy);
        return NULL;
    }
    return copy;
}

// Thin branches have few sides and get lower levels: one less below a 24th of the thickest radius,
// two less below a 96th, but at least 1. (Thick ones have more sides, so face sizes differ little.)
static int graded_level(int levels, float radius, float thickest)
{
    for (float limit = thickest / 24.0f; levels > 1 && radius < limit; limit *= 0.25f) {
        levels--;
    }
    return levels;
}

static void grade_levels(const Mesh *cage, int levels, uint8_t *face_level)
{
    float thickest = 0.0f;
    for (int64_t i = 0; i < cage->vertex_count; i++) {
        thickest = cage->radius[i] > thickest ? cage->radius[i] : thickest;
    }
    for (int64_t f = 0; f < cage->face_count; f++) {
        float radius = 0.0f;
        for (int k = 0; k < 4; k++) {
            float here = cage->radius[cage->index[4 * f + k]];
            radius = here > radius ? here : radius;
        }
        face_level[f] = (uint8_t)graded_level(levels, radius, thickest);
    }
}

Mesh *skin_tree(const OutTree *tree, const SkinParams *params, const Run *run, Error *e)
{
    Mesh *cage = skin_cage(tree, params, run, e);
    if (!cage || params->levels == 0) {
        Mesh *copy = cage ? copy_with_normals(cage, e) : NULL;
        mesh_free(cage);
        return copy;
    }
    Mesh *mesh = NULL;
    uint8_t *face_level = memory_alloc(cage->face_count, 1, e);
    if (face_level) {
        grade_levels(cage, params->levels, face_level);
        mesh = mesh_refine(cage, face_level, run, e);
    }
    free(face_level);
    mesh_free(cage);
    return mesh;
}

// Cage faces around so much of a branch; tips have four sides.
static double cage_faces(const SkinParams *params, float length, float radius, float thinnest,
                         float thickest)
{
    enum { MOST_RINGS = 72 }; // of a chain of one node, however thin it is
    bool tip = radius < 1.01f * thinnest;
    float sides = tip ? 4.0f : fmaxf(8.0f, skin_grid_sides(radius, thinnest, thickest));
    float step = params->ring_spacing * radius * fminf(1.0f, 2.0f * PI_F / sides);
    return (double)(sides * fminf(length / step, (float)MOST_RINGS));
}

double skin_estimate(const OutTree *tree, const SkinParams *params)
{
    float thinnest = INFINITY, thickest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        float radius = tree->radius[i];
        if (radius > 0.0f && radius >= params->min_radius) {
            thinnest = fminf(thinnest, radius);
            thickest = fmaxf(thickest, radius);
        }
    }
    double triangles = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        float radius = tree->radius[i];
        if (tree->parent[i] >= 0 && radius > 0.0f && radius >= params->min_radius) {
            float length = vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
            int level = graded_level(params->levels, radius, thickest);
            triangles +=
                2.0 * exp2(2.0 * level) * cage_faces(params, length, radius, thinnest, thickest);
        }
    }
    return triangles;
}
