#include "objects/venation/vein_hairs.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "objects/venation/hair.h"
#include "objects/venation/vein_curves.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_HAIRS = 6, STREAM_COUNT };                    // of a node's id
enum { STREAM_PLACE = 8, STREAM_AROUND, STREAM_LEAN = 10 }; // of a hair; others are hair.c's

enum { MOST_ON_PIECE = 100 };

#define SPACING 0.12f // along a vein from hair to hair, in their lengths
#define AROUND 1.9f   // radians from the front, on either side, to the last hairs
#define LEAN 1.2f     // of the most slanted, by the way out

// Hairs on the piece of vein up to this node.
static int count_at(const OutTree *tree, const VenationParams *params, int64_t node)
{
    int32_t parent = tree->parent[node];
    if (parent < 0 || tree->radius[node] < params->embedded || tree->position[node].y <= 0.0f) {
        return 0;
    }
    float way = vec3_distance(tree->position[node], tree->position[parent]);
    float chance = random_unit(random_key(tree->id[node], STREAM_COUNT));
    return (int)fminf(way / (SPACING * params->vein_hairs) + chance, MOST_ON_PIECE);
}

// A hair on the vein from `from` to `to`, flat, of this radius.
static Hair hair_on(const VenationParams *params, const Relief *relief, Vec3 from, Vec3 to,
                    float radius, uint64_t key)
{
    Vec3 foot = vec3_lerp(from, to, random_unit(random_key(key, STREAM_PLACE)));
    Vec3 way = vec3_normalize(vec3_sub(to, from)), side = vec3(-way.y, way.x, 0);
    float sine, cosine;
    exact_sincos(random_range(random_key(key, STREAM_AROUND), -AROUND, AROUND), &sine, &cosine);
    Vec3 out = vec3(sine * side.x, sine * side.y, cosine);
    float lean = random_range(random_key(key, STREAM_LEAN), 0.0f, LEAN);
    float lift = relief_at(relief, foot);
    foot = vec3_madd(foot, 0.8f * radius, out); // its root in the vein
    return (Hair){foot, vec3_normalize(vec3_madd(out, lean, way)), lift, params->vein_hairs, key};
}

// Without curves, only counts the hairs.
static int64_t add_hairs(const OutTree *tree, const Vec3 *at, const VenationParams *params,
                         const Relief *relief, const Transform *place, CurveSet *hairs)
{
    int64_t total = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int count = count_at(tree, params, i);
        if (count == 0 || blade_wear_depth(&relief->wear, at[i]) > 0.0f) {
            continue;
        }
        total += count;
        for (int k = 0; hairs && k < count; k++) {
            uint64_t key = random_key(random_key(tree->id[i], STREAM_HAIRS), (uint64_t)k);
            Hair hair = hair_on(params, relief, at[tree->parent[i]], at[i], tree->radius[i], key);
            hair_add(hairs, params, place, &hair);
        }
    }
    return total;
}

CurveSet *vein_hairs(const OutTree *tree, const VenationParams *params, const Relief *relief,
                     const Transform *place, Error *e)
{
    Vec3 *at = venation_smoothed(tree, params->smoothing, e);
    if (!at) {
        return NULL;
    }
    int64_t count = add_hairs(tree, at, params, relief, place, NULL);
    CurveSet *hairs = curves_new(HAIR_POINTS * count, count, e);
    if (hairs) {
        hairs->curve_count = 0;
        add_hairs(tree, at, params, relief, place, hairs);
    }
    free(at);
    return hairs;
}
