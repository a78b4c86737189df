#include "objects/common/near_copies.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

enum { STREAM_TONE = 1 }; // of a leaf

typedef struct Ranked {
    float square; // m2, of the distance to the eye
    int64_t place;
} Ranked;

static int by_distance(const void *a, const void *b)
{
    const Ranked *x = a, *y = b;
    if (x->square != y->square) {
        return x->square < y->square ? -1 : 1;
    }
    return x->place < y->place ? -1 : x->place > y->place;
}

static float square_distance(const Transform *place, Vec3 eye)
{
    Vec3 way = vec3_sub(vec3(place->m[0][3], place->m[1][3], place->m[2][3]), eye);
    return vec3_dot(way, way);
}

// Ranks the places in reach, at most `most`, and marks them. Returns their number.
static int64_t rank(const Transform *place, int64_t count, Vec3 eye, float reach, int64_t most,
                    Ranked *ranked, bool *is_near)
{
    int64_t found = 0;
    for (int64_t i = 0; i < count; i++) {
        float square = square_distance(&place[i], eye);
        if (square < reach * reach) {
            ranked[found++] = (Ranked){square, i};
        }
    }
    qsort(ranked, (size_t)found, sizeof *ranked, by_distance);
    found = found < most ? found : most;
    for (int64_t i = 0; i < found; i++) {
        is_near[ranked[i].place] = true;
    }
    return found;
}

bool near_copies_init(NearCopies *copies, const Transform *place, int64_t count, const Vec3 *eye,
                      float reach, int64_t most, Error *e)
{
    *copies = (NearCopies){.count = count};
    copies->place = memory_alloc(count, sizeof *copies->place, e);
    Ranked *ranked = copies->place ? memory_alloc(count, sizeof *ranked, e) : NULL;
    bool *is_near = ranked ? memory_alloc_zero(count, sizeof *is_near, e) : NULL;
    if (is_near) {
        copies->near = eye ? rank(place, count, *eye, reach, most, ranked, is_near) : 0;
        int64_t next[2] = {copies->near, 0};
        for (int64_t i = 0; i < count; i++) {
            copies->place[next[is_near[i]]++] = place[i];
        }
    } else {
        near_copies_free(copies);
    }
    bool done = is_near;
    free(is_near);
    free(ranked);
    return done;
}

void near_copies_free(NearCopies *copies)
{
    free(copies->place);
    copies->place = NULL;
}

static bool leaves_alloc(Part *leaves, int64_t count, bool seasons, Error *e)
{
    leaves->instance = memory_alloc(count, sizeof *leaves->instance, e);
    leaves->variation = leaves->instance ? memory_alloc(count, sizeof *leaves->variation, e) : NULL;
    bool done = leaves->variation;
    if (done && seasons) {
        leaves->season = memory_alloc(count, sizeof *leaves->season, e);
        done = leaves->season;
    }
    return done;
}

static void leaves_drop(Part *leaves)
{
    free(leaves->instance);
    free(leaves->variation);
    free(leaves->season);
    *leaves = (Part){0};
}

bool near_copies_leaves(const NearCopies *copies, const Part *part, Part *leaves, const Run *run,
                        Error *e)
{
    *leaves = (Part){.kind = part->kind, .material = part->material, .object = part->object};
    int64_t each = part->instance_count, count = copies->near * each;
    if (!leaves_alloc(leaves, count, part->season != NULL, e)) {
        leaves_drop(leaves);
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        if (!run_goes_on(run, i, e)) {
            leaves_drop(leaves);
            return false;
        }
        int64_t leaf = i % each;
        leaves->instance[i] = transform_multiply(&copies->place[i / each], &part->instance[leaf]);
        // another tone in every copy
        leaves->variation[i] =
            random_unit(random_key(random_key(STREAM_TONE, (uint64_t)(i / each)), (uint64_t)leaf));
        if (part->season) {
            leaves->season[i] = part->season[leaf];
        }
    }
    leaves->instance_count = count;
    return true;
}
