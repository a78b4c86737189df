#include "mesh/skin_ring.h"

void skin_ring_set_corners(SkinRing *ring)
{
    Vec3 side = vec3_madd(ring->side, -vec3_dot(ring->side, ring->normal), ring->normal);
    side = vec3_normalize(side);
    ring->side = vec3_dot(side, side) > 0.5f ? side : vec3_perpendicular(ring->normal);
    float reach = SKIN_FACE_SCALE * ring->radius;
    Vec3 u = vec3_scale(ring->side, reach);
    Vec3 v = vec3_scale(vec3_cross(ring->normal, ring->side), reach);
    ring->corner[0] = vec3_add(ring->centre, vec3_sub(u, v));
    ring->corner[1] = vec3_add(ring->centre, vec3_add(u, v));
    ring->corner[2] = vec3_sub(ring->centre, vec3_sub(u, v));
    ring->corner[3] = vec3_sub(ring->centre, vec3_add(u, v));
}

SkinRing skin_ring_from_corners(const Vec3 corner[4])
{
    SkinRing ring = {.centre = vec3(0, 0, 0)};
    for (int k = 0; k < 4; k++) {
        ring.corner[k] = corner[k];
        ring.centre = vec3_madd(ring.centre, 0.25f, corner[k]);
    }
    Vec3 u = vec3_sub(vec3_add(corner[0], corner[1]), vec3_add(corner[2], corner[3]));
    Vec3 v = vec3_sub(vec3_add(corner[1], corner[2]), vec3_add(corner[0], corner[3]));
    ring.normal = vec3_normalize(vec3_cross(u, v));
    ring.side = vec3_normalize(u);
    ring.radius = 0.25f * vec3_length(v) / SKIN_FACE_SCALE;
    return ring;
}

static Vec3 middle_normal(const SkinRing *a, const SkinRing *b)
{
    Vec3 sum = vec3_add(a->normal, b->normal);
    return vec3_dot(sum, sum) > 0.04f ? vec3_normalize(sum) : a->normal;
}

// How far b's corners lie ahead of a's along a direction, at least.
static float least_advance(const SkinRing *a, const SkinRing *b, Vec3 direction)
{
    float least = INFINITY;
    for (int k = 0; k < 4; k++) {
        float advance = vec3_dot(vec3_sub(b->corner[k], a->corner[k]), direction);
        least = advance < least ? advance : least;
    }
    return least;
}

// One sweep: neighbours whose corners come too close turn half-way towards each other.
static bool relax_tilts(SkinRing *ring, int64_t count)
{
    bool changed = false;
    for (int64_t i = 0; i + 1 < count; i++) {
        SkinRing *a = &ring[i], *b = &ring[i + 1];
        Vec3 middle = middle_normal(a, b);
        float gap = vec3_distance(a->centre, b->centre);
        if (least_advance(a, b, middle) >= 0.3f * gap) {
            continue;
        }
        changed = true;
        if (i > 0) {
            a->normal = vec3_normalize(vec3_add(a->normal, middle));
            skin_ring_set_corners(a);
        }
        b->normal = vec3_normalize(vec3_add(b->normal, middle));
        skin_ring_set_corners(b);
    }
    return changed;
}

// Makes b lie ahead of a, whatever it takes.
static void force_ahead(const SkinRing *a, SkinRing *b)
{
    float least = 0.08f * (a->radius < b->radius ? a->radius : b->radius);
    if (vec3_dot(a->side, b->side) < 0.4f) { // more than 66 degrees of twist
        b->side = a->side;
        skin_ring_set_corners(b);
    }
    if (vec3_dot(a->normal, b->normal) > 0.0f &&
        least_advance(a, b, middle_normal(a, b)) >= least) {
        return;
    }
    b->normal = a->normal;
    skin_ring_set_corners(b);
    float advance = least_advance(a, b, a->normal);
    if (advance < least) {
        float push = 2.0f * least - advance;
        b->centre = vec3_madd(b->centre, push, a->normal);
        skin_ring_set_corners(b);
    }
}

void skin_rings_settle(SkinRing *ring, int64_t count)
{
    for (int pass = 0; pass < 12 && relax_tilts(ring, count); pass++) {
    }
    for (int64_t i = 1; i < count; i++) {
        force_ahead(&ring[i - 1], &ring[i]);
    }
}
