#include "mesh/skin_ring.h"

#include "base/exact_math.h"

void skin_ring_direction(int sides, int k, float *cosine, float *sine)
{
    exact_sincos(2.0f * PI_F * (float)k / (float)sides - 0.25f * PI_F, sine, cosine);
}

float skin_ring_scale(int sides)
{
    float turn = 2.0f * PI_F / (float)sides, at_corner, half, three_halves, sine;
    exact_sincos(turn, &sine, &at_corner);
    exact_sincos(0.5f * turn, &sine, &half);
    exact_sincos(1.5f * turn, &sine, &three_halves);
    return 2.0f / ((4.0f + 2.0f * at_corner) / 6.0f + (23.0f * half + three_halves) / 24.0f);
}

void skin_ring_set_corners(SkinRing *ring)
{
    Vec3 side = vec3_madd(ring->side, -vec3_dot(ring->side, ring->normal), ring->normal);
    side = vec3_normalize(side);
    ring->side = vec3_dot(side, side) > 0.5f ? side : vec3_perpendicular(ring->normal);
    Vec3 across = vec3_cross(ring->normal, ring->side);
    float reach = skin_ring_scale(ring->sides) * ring->radius, cosine, sine;
    for (int k = 0; k < ring->sides; k++) {
        skin_ring_direction(ring->sides, k, &cosine, &sine);
        Vec3 out = vec3_madd(vec3_scale(ring->side, cosine), sine, across);
        ring->corner[k] = vec3_madd(ring->centre, reach, out);
    }
}

void skin_ring_fit(SkinRing *ring)
{
    Vec3 sum = vec3(0, 0, 0), u = sum, v = sum;
    for (int k = 0; k < ring->sides; k++) {
        float cosine, sine;
        skin_ring_direction(ring->sides, k, &cosine, &sine);
        sum = vec3_add(sum, ring->corner[k]);
        u = vec3_madd(u, cosine, ring->corner[k]);
        v = vec3_madd(v, sine, ring->corner[k]);
    }
    ring->centre = vec3_scale(sum, 1.0f / (float)ring->sides);
    ring->normal = vec3_normalize(vec3_cross(u, v));
    ring->side = vec3_normalize(u);
    // The sums of n corners on a circle are n / 2 radii long.
    ring->radius = 2.0f * vec3_length(v) / (float)ring->sides / skin_ring_scale(ring->sides);
}

static Vec3 middle_normal(const SkinRing *a, const SkinRing *b)
{
    Vec3 sum = vec3_add(a->normal, b->normal);
    return vec3_dot(sum, sum) > 0.04f ? vec3_normalize(sum) : a->normal;
}

// How far b's corners lie ahead of a's along a direction, at least; of rings of different sides,
// the four corners that they share are compared.
static float least_advance(const SkinRing *a, const SkinRing *b, Vec3 direction)
{
    int count = a->sides == b->sides ? a->sides : 4;
    float least = INFINITY;
    for (int k = 0; k < count; k++) {
        Vec3 from = a->corner[k * a->sides / count], to = b->corner[k * b->sides / count];
        float advance = vec3_dot(vec3_sub(to, from), direction);
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
    float thinner = a->radius < b->radius ? a->radius : b->radius;
    float least = 0.1f * vec3_distance(a->centre, b->centre);
    least = clampf(least, 0.005f * thinner, 0.08f * thinner);
    if (vec3_dot(a->side, b->side) < 0.5f) { // twisted by more than 60 degrees
        b->side = a->side;
        skin_ring_set_corners(b);
    }
    if (vec3_dot(a->normal, b->normal) > 0.0f &&
        least_advance(a, b, middle_normal(a, b)) >= least) {
        return;
    }
    b->normal = a->normal;
    b->side = a->side;
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
    for (int pass = 0; pass < 30 && relax_tilts(ring, count); pass++) {
    }
    for (int64_t i = 1; i < count; i++) {
        force_ahead(&ring[i - 1], &ring[i]);
    }
}
