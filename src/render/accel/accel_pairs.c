#include "render/accel/accel_pairs.h"

#include "base/memory.h"

#include <stdlib.h>

// Pairs.face: the first triangle's number, above 2 bits each for the corners of the first and the
// second triangle that come first in its half of the quad; ALONE without a second triangle.
enum { TURN_BITS = 2, FACE_SHIFT = 2 * TURN_BITS, TURN_MASK = (1 << TURN_BITS) - 1, ALONE = 3 };

#define LEAST_PAIRED 0.5 // share of the triangles

// Corners of a and b, opposite to the edge that both share; false if there is none. Both triangles
// run the same way around.
static bool find_edge(const uint32_t a[3], const uint32_t b[3], uint32_t *turn_a, uint32_t *turn_b)
{
    for (uint32_t i = 0; i < 3; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            if (a[(i + 1) % 3] == b[(k + 2) % 3] && a[(i + 2) % 3] == b[(k + 1) % 3]) {
                *turn_a = i;
                *turn_b = k;
                return true;
            }
        }
    }
    return false;
}

// Embree splits a quad into the triangles of its corners (0, 1, 3) and (2, 3, 1).
static int64_t join(const Mesh *mesh, Pairs *pairs)
{
    int64_t paired = 0;
    for (int64_t f = 0; f < mesh->face_count;) {
        const uint32_t *a = mesh->index + 3 * f;
        uint32_t *corner = pairs->corner + 4 * pairs->count, i = 0, k = ALONE;
        bool joined = f + 1 < mesh->face_count && find_edge(a, a + 3, &i, &k);
        corner[0] = a[i];
        corner[1] = a[(i + 1) % 3];
        corner[2] = joined ? a[3 + k] : a[2];
        corner[3] = a[(i + 2) % 3];
        pairs->face[pairs->count++] = (uint32_t)f << FACE_SHIFT | i << TURN_BITS | k;
        f += joined ? 2 : 1;
        paired += joined ? 2 : 0;
    }
    return paired;
}

bool pairs_new(Pairs *pairs, const Mesh *mesh, Error *e)
{
    *pairs = (Pairs){0};
    if (mesh->face_size != 3 || mesh->face_count >= (int64_t)1 << (32 - FACE_SHIFT)) {
        return true;
    }
    pairs->corner = memory_alloc(mesh->face_count, 4 * sizeof *pairs->corner, e);
    pairs->face = memory_alloc(mesh->face_count, sizeof *pairs->face, e);
    bool done = pairs->corner && pairs->face;
    if (!done || (double)join(mesh, pairs) < LEAST_PAIRED * (double)mesh->face_count) {
        pairs_clear(pairs);
    }
    return done;
}

void pairs_clear(Pairs *pairs)
{
    free(pairs->corner);
    free(pairs->face);
    *pairs = (Pairs){0};
}

uint32_t pairs_triangle(uint32_t face, float *u, float *v)
{
    bool second = *u + *v > 1.0f && (face & TURN_MASK) != ALONE;
    float weight[3] = {1.0f - *u - *v, *u, *v}, turned[3];
    if (second) {
        weight[0] = *u + *v - 1.0f;
        weight[1] = 1.0f - *u;
        weight[2] = 1.0f - *v;
    }
    uint32_t turn = (second ? face : face >> TURN_BITS) & TURN_MASK;
    for (uint32_t i = 0; i < 3; i++) {
        turned[(turn + i) % 3] = weight[i];
    }
    *u = turned[1];
    *v = turned[2];
    return (face >> FACE_SHIFT) + (second ? 1 : 0);
}
