// What tracings of neurons leave out: the cones by which dendrites leave the soma, and spines.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/skeleton/skeleton.h"
#include "outtree/out_tree_io.h"

#include <stdlib.h>

enum { STREAM_COUNT = 0, STREAM_SPINES = 1 }; // of a node; SPINES + i: spine i
enum { STREAM_ALONG, STREAM_TURN, STREAM_LEAN, STREAM_LENGTH, STREAM_SHAPE, STREAM_HEAD }; // of one

#define MUSHROOMS 0.6f  // share of spines with a head; the others are thin
#define BARE_SOMAS 2.5f // way from the soma without spines, in its radii

// Ways of nodes from the middle of the soma above them, and its radius; 0, 0 without one.
typedef struct Ways {
    float *way, *soma;
} Ways;

static bool find_ways(Ways *w, const OutTree *tree, Error *e)
{
    w->way = memory_alloc_zero(tree->count, sizeof *w->way, e);
    w->soma = memory_alloc_zero(tree->count, sizeof *w->soma, e);
    for (int64_t i = 0; w->way && w->soma && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        float above = parent >= 0 ? w->soma[parent] : 0.0f;
        w->soma[i] =
            tree->colony[i] == SWC_SOMA && tree->radius[i] > above ? tree->radius[i] : above;
        if (parent >= 0 && tree->colony[i] != SWC_SOMA) {
            w->way[i] = w->way[parent] + vec3_distance(tree->position[i], tree->position[parent]);
        }
    }
    return w->way && w->soma;
}

static void flare_bases(OutTree *tree, const Ways *w, float flare)
{
    for (int64_t i = 0; i < tree->count; i++) {
        float soma = w->soma[i];
        if (tree->colony[i] == SWC_SOMA || !(soma > 0.0f)) {
            continue;
        }
        float d = w->way[i] > soma ? (w->way[i] - soma) / soma : 0.0f;
        float wide = tree->radius[i] * (1.0f + flare / (1.0f + 4.0f * d * d));
        float most = fmaxf(0.5f * soma, tree->radius[i]); // bases must not hide the soma
        tree->radius[i] = fminf(wide, most);
    }
}

// One spine on the edge above node i: a neck from inside the branch, and a head or a thin end.
static bool add_spine(OutTree *tree, int64_t i, float length, uint64_t key, Error *e)
{
    int32_t parent = tree->parent[i];
    Vec3 from = tree->position[parent], to = tree->position[i];
    float t = random_unit(random_key(key, STREAM_ALONG)), s, c;
    Vec3 along = vec3_normalize(vec3_sub(to, from)), x = vec3_perpendicular(along);
    exact_sincos(2.0f * PI_F * random_unit(random_key(key, STREAM_TURN)), &s, &c);
    Vec3 out = vec3_madd(vec3_scale(x, c), s, vec3_cross(along, x));
    out = vec3_normalize(
        vec3_madd(out, random_range(random_key(key, STREAM_LEAN), -0.5f, 0.5f), along));
    bool mushroom = random_unit(random_key(key, STREAM_SHAPE)) < MUSHROOMS;
    length *= random_range(random_key(key, STREAM_LENGTH), 0.55f, mushroom ? 1.1f : 1.4f);
    float neck = (mushroom ? 0.085f : 0.065f) * length;
    float head = random_range(random_key(key, STREAM_HEAD), 0.75f, 1.2f) * length *
                 (mushroom ? 0.32f : 0.13f);
    float girth = tree->radius[parent] + t * (tree->radius[i] - tree->radius[parent]);
    Vec3 foot = vec3_madd(vec3_lerp(from, to, t), 0.8f * girth, out);
    float reach = length + 0.2f * girth;
    const float place[] = {0.0f, 0.5f, 0.72f, 0.86f, 1.0f};
    const float radius[] = {1.3f * neck, neck, 0.75f * head, head, 0.75f * head};
    int64_t above = t < 0.5f ? parent : i;
    for (int k = 0; k < 5; k++) {
        above = out_tree_add_node(tree, vec3_madd(foot, place[k] * reach, out), above,
                                  tree->birth[i], tree->colony[i], random_key(key, (uint64_t)k), e);
        if (above < 0) {
            return false;
        }
        tree->radius[above] = radius[k];
    }
    return true;
}

static bool add_spines(OutTree *tree, const Ways *w, const SkeletonParams *params,
                       const Recipe *recipe, Error *e)
{
    float length = params->spine_length * params->scale;
    float density = params->spines / params->scale;
    int64_t traced = tree->count;
    for (int64_t i = 0; i < traced; i++) {
        int32_t parent = tree->parent[i], type = tree->colony[i];
        // spines that were traced are thinner than a head
        if ((type != SWC_BASAL && type != SWC_APICAL) || parent < 0 ||
            tree->colony[parent] == SWC_SOMA || w->way[i] < BARE_SOMAS * w->soma[i] ||
            tree->radius[i] < 0.2f * length) {
            continue;
        }
        if (!run_goes_on(recipe->run, i, e)) {
            return false;
        }
        uint64_t key = random_key(recipe->seed, tree->id[i]);
        float wanted = density * vec3_distance(tree->position[i], tree->position[parent]);
        int64_t count = (int64_t)wanted;
        count += random_unit(random_key(key, STREAM_COUNT)) < wanted - (float)count;
        for (int64_t k = 0; k < count; k++) {
            if (!add_spine(tree, i, length, random_key(key, STREAM_SPINES + (uint64_t)k), e)) {
                return false;
            }
        }
    }
    return true;
}

bool skeleton_dress(OutTree *tree, const SkeletonParams *params, const Recipe *recipe, Error *e)
{
    if (!(params->flare > 0.0f) && !(params->spines > 0.0f)) {
        return true;
    }
    Ways w = {0};
    bool done = find_ways(&w, tree, e);
    if (done) {
        flare_bases(tree, &w, params->flare);
        done = !(params->spines > 0.0f) || add_spines(tree, &w, params, recipe, e);
    }
    free(w.way);
    free(w.soma);
    return done;
}
