#include "mesh/leaf/leaf.h"

#include "base/exact_math.h"
#include "base/triangle.h"
#include "mesh/leaf/blade.h"
#include "mesh/leaf/compound.h"
#include "mesh/leaf/needles.h"
#include "mesh/leaf/wear.h"

#include <stddef.h>

enum { STALK_SIDES = 3, NEAR_STALK_SIDES = 6 };

static void add_stalk(Quads *quads, const LeafParams *params)
{
    // The stalk continues below the blade's base, where the midrib begins; seen from near, it
    // tapers.
    bool fine = params->detail > 2;
    float overlap = params->compound == COMPOUND_NONE && params->nod == 0.0f ? 0.04f : 0.0f;
    float thickness = (params->shape == LEAF_OAK ? 0.006f : 0.009f) * params->length;
    // A frond's stalk is no thicker than its rachis needs.
    thickness = params->compound == COMPOUND_NONE ? thickness : 0.5f * thickness;
    uint32_t sides = fine ? NEAR_STALK_SIDES : STALK_SIDES;
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int end = 0; end < 2; end++) {
        float taper = end && fine ? 0.3f : 1.0f;
        for (uint32_t k = 0; k < sides; k++) {
            float sine, cosine;
            exact_sincos(2.0f * PI_F * (float)k / (float)sides, &sine, &cosine);
            float y = end ? params->petiole + overlap * params->length : 0.0f;
            quads_vertex(quads,
                         vec3(taper * thickness * cosine, y, thickness * (taper * sine - 0.8f)),
                         (Vec2){0.5f, 0.0f});
        }
    }
    for (uint32_t k = 0; k < sides; k++) {
        uint32_t a = first + k, b = first + (k + 1) % sides;
        quads_face(quads, a, a + sides, b + sides, b);
    }
}

// Rotation of the blade about the end of its stalk.
static Transform nodding(const LeafParams *params)
{
    float sine, cosine;
    exact_sincos(params->nod * RADIANS_PER_DEGREE, &sine, &cosine);
    float y = params->petiole;
    return transform_from_axes(vec3(1, 0, 0), vec3(0, cosine, -sine), vec3(0, sine, cosine),
                               vec3(0, y - y * cosine, y * sine));
}

// Adds what bears the leaf's area: all but stalk and rachis.
static void add_blades(Quads *quads, const LeafParams *params, uint64_t seed)
{
    BladeDetail detail = params->detail > 1 ? BLADE_FINE : BLADE_PLAIN;
    if (leaf_has_needles(params)) {
        needles_add(quads, params, 1, 1.0f, params->detail > 1, seed);
    } else if (params->compound != COMPOUND_NONE) {
        compound_add(quads, params, detail, 1.0f, seed);
    } else {
        blade_add(quads, params, detail, seed);
    }
    if (params->wear > 0.0f && params->detail > 1) {
        // beetles of water plants are small beside a pad
        float size = params->shape == LEAF_PAD ? 0.35f * params->length : params->length;
        wear_cut(quads, 0, params->wear, size, seed);
    }
}

// Without the stalk if `bare`.
static Mesh *leaf_mesh(const LeafParams *params, bool bare, uint64_t seed, Error *e)
{
    Transform nod = nodding(params);
    Quads quads = {
        .e = e, .place = params->nod > 0.0f ? &nod : NULL, .ages = needles_flush(params)};
    add_blades(&quads, params, seed);
    if (bare) {
        return quads_mesh(&quads);
    }
    if (params->compound != COMPOUND_NONE && !leaf_has_needles(params)) {
        compound_add_rachis(&quads, params);
    }
    quads.place = NULL;
    if (params->petiole > 0.0f && !leaf_has_needles(params)) {
        add_stalk(&quads, params);
    }
    return quads_mesh(&quads);
}

Mesh *leaf_mesh_new(const LeafParams *params, uint64_t seed, Error *e)
{
    return leaf_mesh(params, false, seed, e);
}

// ---- simpler leaves ----

static double mesh_area(const Mesh *mesh)
{
    double area = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + 4 * f;
        Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]];
        Vec3 c = mesh->position[corner[2]], d = mesh->position[corner[3]];
        Vec3 abc = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
        Vec3 acd = vec3_cross(vec3_sub(c, a), vec3_sub(d, a));
        area += 0.5 * (double)(vec3_length(abc) + vec3_length(acd));
    }
    return area;
}

// Largest distance of the vertices of fine from the faces of coarse. Of many vertices only some are
// asked.
static float mesh_distance(const Mesh *fine, const Mesh *coarse)
{
    enum { MOST_PAIRS = 200000 };
    int64_t step = fine->vertex_count * coarse->face_count / MOST_PAIRS + 1;
    float largest = 0.0f;
    for (int64_t v = 0; v < fine->vertex_count; v += step) {
        float nearest = INFINITY;
        for (int64_t f = 0; f < coarse->face_count; f++) {
            for (int k = 0; k < 2; k++) {
                const uint32_t *corner = coarse->index + 4 * f;
                Vec3 on =
                    triangle_nearest(coarse->position[corner[0]], coarse->position[corner[k + 1]],
                                     coarse->position[corner[k + 2]], fine->position[v]);
                nearest = fminf(nearest, vec3_distance(on, fine->position[v]));
            }
        }
        largest = fmaxf(largest, nearest);
    }
    return largest;
}

// Scales x, across the leaf.
static void widen(Mesh *mesh, float factor)
{
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        mesh->position[v].x *= factor;
    }
}

static Mesh *coarse_blade(const LeafParams *params, uint64_t seed, int level, double area, Error *e)
{
    Transform nod = nodding(params);
    Quads quads = {.e = e, .place = params->nod > 0.0f ? &nod : NULL};
    blade_add(&quads, params, level > 0 ? BLADE_KITE : BLADE_SMOOTH, seed);
    Mesh *mesh = quads_mesh(&quads);
    if (mesh) {
        widen(mesh, (float)(area / mesh_area(mesh)));
    }
    return mesh;
}

static Mesh *coarse_parts_once(const LeafParams *params, uint64_t seed, int level, float factor,
                               Error *e)
{
    Transform nod = nodding(params);
    Quads quads = {
        .e = e, .place = params->nod > 0.0f ? &nod : NULL, .ages = needles_flush(params)};
    if (leaf_has_needles(params)) {
        static const int stride[LEAF_COARSE_MOST] = {4, 16, NEEDLES_AS_SHOOTS};
        needles_add(&quads, params, stride[level], factor, false, seed);
    } else if (level > 0 && params->compound != COMPOUND_PALMATE) {
        LeafParams whole = *params;
        whole.width *= factor;
        blade_add(&quads, &whole, BLADE_KITE, seed);
    } else {
        LeafParams fewer = *params;
        fewer.leaflets = level > 0 && fewer.leaflets > 3 ? 3 : fewer.leaflets;
        compound_add(&quads, &fewer, BLADE_KITE, factor, seed);
    }
    return quads_mesh(&quads);
}

// Leaflets and needles are widened each for itself, until the area fits: it grows about in
// proportion. *factor: by how much.
static Mesh *coarse_parts(const LeafParams *params, uint64_t seed, int level, double area,
                          float *factor, Error *e)
{
    enum { ROUNDS = 3 };
    Mesh *mesh = coarse_parts_once(params, seed, level, *factor, e);
    for (int i = 0; mesh && i < ROUNDS; i++) {
        *factor *= (float)(area / mesh_area(mesh));
        mesh_free(mesh);
        mesh = coarse_parts_once(params, seed, level, *factor, e);
    }
    return mesh;
}

int leaf_coarse_levels(const LeafParams *params)
{
    return needles_branch(params) ? LEAF_COARSE_MOST : LEAF_COARSE_MOST - 1;
}

Mesh *leaf_mesh_coarse(const LeafParams *params, uint64_t seed, int level, float *error, Error *e)
{
    Mesh *fine = leaf_mesh(params, true, seed, e);
    bool parts = leaf_has_needles(params) || params->compound != COMPOUND_NONE;
    float factor = 1.0f;
    Mesh *mesh = !fine   ? NULL
                 : parts ? coarse_parts(params, seed, level, mesh_area(fine), &factor, e)
                         : coarse_blade(params, seed, level, mesh_area(fine), e);
    if (mesh) {
        *error = mesh_distance(fine, mesh);
    }
    if (mesh && leaf_has_needles(params)) {
        // a wide needle closes the gaps of the thin ones, however near they are
        *error = fmaxf(*error, 0.5f * factor * params->width);
    }
    mesh_free(fine);
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}
