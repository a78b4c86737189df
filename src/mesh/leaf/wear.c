#include "mesh/leaf/wear.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

enum { STREAM_COUNT = 1, STREAM_HOLES = 10 };                    // of a leaf
enum { STREAM_CENTER = 1, STREAM_RADIUS = 2, STREAM_LARGE = 3 }; // of a hole

typedef struct Hole {
    Vec3 center;
    float radius; // m
} Hole;

static bool inside(const Hole *hole, Vec3 p)
{
    return vec3_distance(p, hole->center) < hole->radius;
}

// Removes the faces that lie in the hole with all corners, and moves the corners of the others that
// do to the hole's rim.
static void cut(Quads *quads, int64_t first, const Hole *hole)
{
    int64_t kept = first;
    for (int64_t f = first; f < quads->face_count; f++) {
        const uint32_t *corner = quads->index + 4 * f;
        int within = 0;
        for (int k = 0; k < 4; k++) {
            within += inside(hole, quads->position[corner[k]]);
        }
        if (within == 4) {
            continue;
        }
        for (int k = 0; k < 4; k++) {
            quads->index[4 * kept + k] = corner[k];
        }
        kept++;
    }
    bool some = kept < quads->face_count;
    quads->face_count = kept;
    for (int64_t i = 4 * first; some && i < 4 * kept; i++) {
        Vec3 *p = &quads->position[quads->index[i]];
        if (inside(hole, *p)) {
            Vec3 out = vec3_normalize(vec3_sub(*p, hole->center));
            *p = vec3_madd(hole->center, hole->radius, out);
        }
    }
}

void wear_cut(Quads *quads, int64_t first, float wear, float size, uint64_t seed)
{
    // Few leaves bear most of the wear.
    float share = random_unit(random_key(seed, STREAM_COUNT));
    int holes = (int)(14.0f * wear * share * share + 0.5f);
    for (int i = 0; i < holes && !quads->failed && quads->face_count > first; i++) {
        uint64_t key = random_key(seed, STREAM_HOLES + (uint64_t)i);
        int64_t faces = quads->face_count - first;
        int64_t face =
            first + (int64_t)(random_unit(random_key(key, STREAM_CENTER)) * (float)faces);
        const uint32_t *corner = quads->index + 4 * face;
        float large = random_unit(random_key(key, STREAM_LARGE));
        Hole hole = {.center = vec3_lerp(quads->position[corner[0]], quads->position[corner[2]],
                                         random_unit(random_key(key, STREAM_RADIUS))),
                     .radius = size * (0.02f + 0.12f * large * large)};
        cut(quads, first, &hole);
    }
}
