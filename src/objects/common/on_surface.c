#include "objects/common/on_surface.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static float larger(float a, float b)
{
    return a > b ? a : b;
}

OnSurface on_surface(const Envelope *envelope)
{
    Aabb box = envelope_bounds(envelope);
    Vec3 sides = vec3_sub(box.high, box.low);
    float extent = larger(sides.x, larger(sides.y, sides.z)), band = envelope_band(envelope);
    return (OnSurface){.envelope = envelope,
                       .extent = extent,
                       .probe = 0.004f * extent,
                       .stride = band < 0.04f * extent ? 0.5f * band : 0.02f * extent};
}

static Vec3 slope_at(const OnSurface *on, Vec3 p)
{
    float h = on->probe, g[3];
    for (int i = 0; i < 3; i++) {
        Vec3 d = vec3(i == 0 ? h : 0.0f, i == 1 ? h : 0.0f, i == 2 ? h : 0.0f);
        g[i] = envelope_distance(on->envelope, vec3_add(p, d)) -
               envelope_distance(on->envelope, vec3_sub(p, d));
    }
    return vec3_scale(vec3(g[0], g[1], g[2]), 0.5f / h);
}

void surface_project(const void *surface, Vec3 *p, Vec3 *normal)
{
    enum { ROUNDS = 6 };
    const OnSurface *on = surface;
    if (envelope_nearest(on->envelope, p, normal)) {
        return;
    }
    for (int i = 0; i < ROUNDS; i++) {
        float d = envelope_distance(on->envelope, *p);
        Vec3 g = slope_at(on, *p);
        float steep = vec3_dot(g, g);
        if (steep > 0.04f) {
            *normal = vec3_normalize(g);
        }
        Vec3 last = *p;
        *p = vec3_madd(last, -d / (steep > 0.25f ? sqrtf(steep) : 1.0f), *normal);
        if (p->x == last.x && p->y == last.y && p->z == last.z) {
            return; // further rounds would change nothing
        }
    }
}

bool surface_drop_strays(const OnSurface *on, OutTree *tree, float jump, Error *e)
{
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    if (!keep) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        float off = envelope_distance(on->envelope, tree->position[i]);
        float way = parent < 0 ? 0.0f : vec3_distance(tree->position[i], tree->position[parent]);
        keep[i] = parent < 0 || (off < on->probe && off > -on->probe && way < jump);
    }
    bool done = out_tree_keep_nodes(tree, keep, e);
    free(keep);
    return done;
}

// A step of length L on a ball of radius R passes L^2 / (8 R) below its surface; far from a level
// set, distances are clamped.
static bool is_bridge(const OnSurface *on, Vec3 a, Vec3 b)
{
    float off = fabsf(envelope_distance(on->envelope, vec3_lerp(a, b, 0.5f)));
    return off > 0.2f * vec3_distance(a, b) || off > 0.95f * envelope_band(on->envelope);
}

bool surface_settle(const OnSurface *on, OutTree *tree, Error *e)
{
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    for (int64_t i = 0; keep && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        surface_project(on, &tree->position[i], &tree->normal[i]);
        float off = fabsf(envelope_distance(on->envelope, tree->position[i]));
        keep[i] = parent < 0 ||
                  (off < on->probe && !is_bridge(on, tree->position[parent], tree->position[i]));
    }
    bool done = keep && out_tree_keep_nodes(tree, keep, e);
    free(keep);
    return done;
}
