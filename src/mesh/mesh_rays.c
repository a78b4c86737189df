#include "mesh/mesh_rays.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { LEAF = 4, DEPTH = 40 };

typedef struct Entry {
    uint32_t code; // place along a curve that fills space (Morton, 1966)
    uint32_t triangle;
} Entry;

// A balanced tree over the triangles in the order of their codes: node i has the nodes 2 i and
// 2 i + 1; leaves follow from `leaves` on.
struct MeshRays {
    const Mesh *mesh;
    Entry *entry;
    int64_t count, leaves;
    Aabb *box;
};

static void corners_of(const Mesh *mesh, uint32_t triangle, Vec3 corner[3])
{
    static const int QUAD[2][3] = {{0, 1, 2}, {0, 2, 3}};
    bool quads = mesh->face_size == 4;
    const uint32_t *face =
        mesh->index + (quads ? (size_t)4 * (triangle / 2) : (size_t)3 * triangle);
    for (int i = 0; i < 3; i++) {
        corner[i] = mesh->position[face[quads ? QUAD[triangle % 2][i] : i]];
    }
}

static uint32_t spread_bits(float share)
{
    uint32_t x = (uint32_t)clampf(1023.0f * share, 0.0f, 1023.0f), spread = 0;
    for (int i = 0; i < 10; i++) {
        spread |= (x >> i & 1u) << (3 * i);
    }
    return spread;
}

static int compare(const void *a, const void *b)
{
    const Entry *x = a, *y = b;
    if (x->code != y->code) {
        return x->code < y->code ? -1 : 1;
    }
    return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

static void sort_entries(MeshRays *rays)
{
    Aabb bounds = mesh_bounds(rays->mesh);
    float side = vec3_largest(vec3_sub(bounds.high, bounds.low));
    float scale = side > 0.0f ? 1.0f / side : 0.0f;
    for (int64_t i = 0; i < rays->count; i++) {
        Vec3 c[3];
        corners_of(rays->mesh, (uint32_t)i, c);
        Vec3 middle = vec3_scale(vec3_add(vec3_add(c[0], c[1]), c[2]), 1.0f / 3.0f);
        Vec3 at = vec3_scale(vec3_sub(middle, bounds.low), scale);
        rays->entry[i] = (Entry){
            spread_bits(at.x) | spread_bits(at.y) << 1 | spread_bits(at.z) << 2, (uint32_t)i};
    }
    qsort(rays->entry, (size_t)rays->count, sizeof *rays->entry, compare);
}

static void fill_boxes(MeshRays *rays)
{
    for (int64_t i = 0; i < rays->leaves; i++) {
        Aabb box = aabb_empty();
        for (int64_t k = LEAF * i; k < LEAF * (i + 1) && k < rays->count; k++) {
            Vec3 c[3];
            corners_of(rays->mesh, rays->entry[k].triangle, c);
            box = aabb_add(aabb_add(aabb_add(box, c[0]), c[1]), c[2]);
        }
        rays->box[rays->leaves + i] = box;
    }
    for (int64_t i = rays->leaves - 1; i > 0; i--) {
        rays->box[i] = aabb_union(rays->box[2 * i], rays->box[2 * i + 1]);
    }
}

MeshRays *mesh_rays_new(const Mesh *mesh, Error *e)
{
    MeshRays *rays = memory_alloc(1, sizeof *rays, e);
    if (!rays) {
        return NULL;
    }
    *rays = (MeshRays){
        .mesh = mesh, .count = mesh->face_count * (mesh->face_size == 4 ? 2 : 1), .leaves = 1};
    while (rays->leaves * LEAF < rays->count) {
        rays->leaves *= 2;
    }
    rays->entry = memory_alloc(rays->count, sizeof *rays->entry, e);
    rays->box = rays->entry ? memory_alloc(2 * rays->leaves, sizeof *rays->box, e) : NULL;
    if (!rays->box) {
        mesh_rays_free(rays);
        return NULL;
    }
    sort_entries(rays);
    fill_boxes(rays);
    return rays;
}

void mesh_rays_free(MeshRays *rays)
{
    if (rays) {
        free(rays->entry);
        free(rays->box);
        free(rays);
    }
}

// Narrows the ray's part between the two planes across one axis.
static void narrow(float low, float high, float p, float d, float *from, float *to)
{
    if (d == 0.0f) {
        *to = p < low || p > high ? -1.0f : *to;
        return;
    }
    float a = (low - p) / d, b = (high - p) / d;
    float first = a < b ? a : b, last = a < b ? b : a;
    *from = first > *from ? first : *from;
    *to = last < *to ? last : *to;
}

static bool meets_box(const Aabb *box, Vec3 p, Vec3 d, float most)
{
    const float slack = 1.000001f; // for rounding
    if (aabb_is_empty(*box)) {
        return false;
    }
    float from = 0.0f, to = most;
    narrow(box->low.x, box->high.x, p.x, d.x, &from, &to);
    narrow(box->low.y, box->high.y, p.y, d.y, &from, &to);
    narrow(box->low.z, box->high.z, p.z, d.z, &from, &to);
    return from <= to * slack;
}

// Moeller and Trumbore (1997).
static float way_to(const Vec3 c[3], Vec3 p, Vec3 d, bool leaving)
{
    Vec3 u = vec3_sub(c[1], c[0]), v = vec3_sub(c[2], c[0]), q = vec3_cross(d, v);
    float det = vec3_dot(u, q); // below 0: seen from the back
    if (det == 0.0f || (leaving && det > 0.0f)) {
        return INFINITY;
    }
    Vec3 from = vec3_sub(p, c[0]), r = vec3_cross(from, u);
    float a = vec3_dot(from, q) / det, b = vec3_dot(d, r) / det, t = vec3_dot(v, r) / det;
    return a >= 0.0f && b >= 0.0f && a + b <= 1.0f && t > 0.0f ? t : INFINITY;
}

float mesh_rays_way(const MeshRays *rays, Vec3 p, Vec3 d, bool leaving, float most)
{
    int64_t stack[DEPTH];
    int depth = 0;
    float way = most;
    bool met = false;
    stack[depth++] = 1;
    while (depth > 0) {
        int64_t node = stack[--depth];
        if (!meets_box(&rays->box[node], p, d, way)) {
            continue;
        }
        if (node < rays->leaves) {
            stack[depth++] = 2 * node;
            stack[depth++] = 2 * node + 1;
            continue;
        }
        int64_t first = LEAF * (node - rays->leaves);
        for (int64_t k = first; k < first + LEAF && k < rays->count; k++) {
            Vec3 c[3];
            corners_of(rays->mesh, rays->entry[k].triangle, c);
            float t = way_to(c, p, d, leaving);
            if (t < way) {
                way = t;
                met = true;
            }
        }
    }
    return met ? way : INFINITY;
}
