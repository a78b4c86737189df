#include "skin/lumen.h"

#include "skin/grid.h"
#include "skin/mouth.h"

#include <string.h>

#define DEPTH 3.0f // of the floor, in radii

// A loop of the lumen's surface: its width, and how far in it lies along the tube.
typedef struct LumenLoop {
    float width; // of the ring
    float in;    // radii
} LumenLoop;

// A corner of the ring, drawn in to the loop.
static SkinVertex loop_vertex(const SkinRing *ring, const LumenLoop *loop, int k, float offset)
{
    SkinVertex v = skin_ring_vertex(ring, k, offset);
    Vec3 out = vec3_sub(v.position, ring->centre);
    Vec3 centre = vec3_madd(ring->centre, loop->in * ring->radius, ring->normal);
    v.position = vec3_madd(centre, loop->width, out);
    return v;
}

// Quads between two loops, the inner one farther along the surface; they face away from the wall.
static void add_loop(SkinCage *cage, const SkinRing *ring, const uint32_t *outer,
                     const uint32_t *inner, float middle)
{
    for (int k = 0; k < ring->sides; k++) {
        int next = (k + 1) % ring->sides;
        Vec3 out = vec3_sub(vec3_lerp(ring->corner[k], ring->corner[next], 0.5f), ring->centre);
        Vec3 inside = vec3_madd(ring->centre, middle, out);
        inside = vec3_madd(inside, 0.5f * DEPTH * ring->radius, ring->normal);
        skin_cage_add_face(cage, inner[k], inner[next], outer[next], outer[k], inside);
    }
}

bool skin_lumen_close(SkinCage *cage, const SkinRing *ring, float wall, float offset, Error *e)
{
    const LumenLoop loop[] = {{1.0f - 0.1f * wall, -0.12f * wall},
                              {1.0f - 0.9f * wall, -0.12f * wall},
                              {1.0f - wall, 0.1f * wall},
                              {1.0f - wall, 0.9f * DEPTH},
                              {1.0f - wall, DEPTH}};
    enum { LOOPS = sizeof loop / sizeof loop[0] };
    uint32_t outer[SKIN_MAX_SIDES], inner[SKIN_MAX_SIDES];
    if (!skin_cage_reserve(cage, LOOPS * ring->sides, LOOPS * ring->sides, e)) {
        return false;
    }
    memcpy(outer, ring->name, (size_t)ring->sides * sizeof *outer);
    for (int i = 0; i < LOOPS; i++) {
        for (int k = 0; k < ring->sides; k++) {
            inner[k] = skin_cage_add_vertex(cage, loop_vertex(ring, &loop[i], k, offset));
        }
        add_loop(cage, ring, outer, inner, 1.0f - 0.5f * wall);
        memcpy(outer, inner, sizeof outer);
    }
    for (int k = 0; k < ring->sides; k++) {
        outer[k] = inner[ring->sides - 1 - k];
    }
    return skin_cage_cap(cage, outer, ring->sides,
                         vec3_madd(ring->centre, 2.0f * DEPTH * ring->radius, ring->normal), e);
}
