#include "skin/ring.h"

#include "base/exact_math.h"
#include "skin/girth.h"

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
        float own = ring->uneven ? skin_girth_reach(&ring->girth, cosine, sine) : 1.0f;
        ring->corner[k] = vec3_madd(ring->centre, own * reach, out);
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
    // The sum of n corners on a circle is n / 2 radii long.
    ring->radius = 2.0f * vec3_length(v) / (float)ring->sides / skin_ring_scale(ring->sides);
}

Vec3 skin_ring_finer_corner(const SkinRing *ring, int sides, int k)
{
    if (sides == ring->sides) {
        return ring->corner[k];
    }
    Vec3 a = ring->corner[k / 2];
    if (k % 2 == 0) {
        return a;
    }
    // The midpoint, moved from the chord to the circle.
    Vec3 chord = vec3_lerp(a, ring->corner[(k / 2 + 1) % ring->sides], 0.5f);
    float sine, cosine;
    exact_sincos(PI_F / (float)ring->sides, &sine, &cosine);
    return vec3_madd(ring->centre, 1.0f / cosine, vec3_sub(chord, ring->centre));
}

static Vec3 middle_normal(const SkinRing *a, const SkinRing *b)
{
    Vec3 sum = vec3_add(a->normal, b->normal);
    return vec3_dot(sum, sum) > 0.04f ? vec3_normalize(sum) : a->normal;
}

// Least distance of b's corners ahead of a's along a direction.
static float least_advance(const SkinRing *a, const SkinRing *b, Vec3 direction)
{
    float least = INFINITY;
    for (int k = 0; k < a->sides; k++) {
        Vec3 to = skin_ring_finer_corner(b, a->sides, k);
        float advance = vec3_dot(vec3_sub(to, a->corner[k]), direction);
        least = advance < least ? advance : least;
    }
    return least;
}

// One sweep: adjacent rings whose corners come too close are rotated half-way toward each other.
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

// Whether the faces between two rings, from fraction t0 to t1, face away from the axis.
static bool strip_looks_outwards(const SkinRing *a, const SkinRing *b, float t0, float t1)
{
    Vec3 axis = vec3_lerp(a->centre, b->centre, 0.5f * (t0 + t1));
    for (int k = 0; k < a->sides; k++) {
        int next = (k + 1) % a->sides;
        Vec3 to = skin_ring_finer_corner(b, a->sides, k);
        Vec3 to_next = skin_ring_finer_corner(b, a->sides, next);
        Vec3 p = vec3_lerp(a->corner[k], to, t0), q = vec3_lerp(a->corner[next], to_next, t0);
        Vec3 r = vec3_lerp(a->corner[next], to_next, t1), s = vec3_lerp(a->corner[k], to, t1);
        Vec3 normal = vec3_cross(vec3_sub(r, p), vec3_sub(s, q));
        Vec3 middle = vec3_scale(vec3_add(vec3_add(p, q), vec3_add(r, s)), 0.25f);
        Vec3 out = vec3_sub(middle, axis);
        float least = 0.05f * vec3_length(normal) * vec3_length(out);
        if (!(vec3_dot(normal, out) > least)) {
            return false;
        }
    }
    return true;
}

// A reduction row has faces of half its height.
static bool looks_outwards(const SkinRing *a, const SkinRing *b)
{
    if (a->sides == b->sides) {
        return strip_looks_outwards(a, b, 0.0f, 1.0f);
    }
    return strip_looks_outwards(a, b, 0.0f, 0.5f) && strip_looks_outwards(a, b, 0.5f, 1.0f);
}

// Forces the tube between a and b to face outward: makes b parallel to a, moves it ahead, and as a
// last resort directly above a.
static void force_ahead(const SkinRing *a, SkinRing *b)
{
    if (vec3_dot(a->side, b->side) < 0.5f) { // twisted by more than 60 degrees
        b->side = a->side;
        skin_ring_set_corners(b);
    }
    if (vec3_dot(a->normal, b->normal) > 0.0f && looks_outwards(a, b)) {
        return;
    }
    Vec3 offset = vec3_sub(b->centre, a->centre);
    float along = vec3_dot(offset, a->normal), least = 0.1f * b->radius;
    Vec3 sideways = vec3_madd(offset, -along, a->normal);
    b->normal = a->normal;
    b->side = a->side;
    along = along > least ? along : least;
    for (int i = 0; i < 9; i++) {
        float share = i < 4 ? 1.0f / (float)(1 << i) : 0.0f;
        b->centre = vec3_add(vec3_madd(a->centre, along, a->normal), vec3_scale(sideways, share));
        skin_ring_set_corners(b);
        if (looks_outwards(a, b)) {
            return;
        }
        along *= i < 4 ? 1.0f : 2.0f;
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
