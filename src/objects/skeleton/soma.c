// Round somas for skeletons.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/skeleton/skeleton.h"
#include "outtree/out_tree_io.h"

#include <stdlib.h>

enum {
    BALL_NODES = 13,
    POLE_NODES = 4 // of them at either end, too thin for ways to leave from
};

typedef struct Soma {
    Vec3 middle, axis;
    float radius;
    int64_t nodes;
    int32_t stem;  // the thickest that leaves it; -1 = none
    int64_t first; // first node of its chain in the new tree
} Soma;

typedef struct Rounding {
    const OutTree *tree;
    OutTree *out;
    Soma *soma;
    int64_t count;
    int32_t *soma_of; // per node; -1 = none
    int32_t *place;   // per node that stays: in the new tree
} Rounding;

// Numbers the somas and assigns nodes to them.
static bool find_somas(Rounding *r, Error *e)
{
    const OutTree *tree = r->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        r->soma_of[i] = -1;
        if (tree->colony[i] == SWC_SOMA) {
            r->soma_of[i] = parent >= 0 ? r->soma_of[parent] : (int32_t)r->count++;
        }
    }
    r->soma = memory_alloc_zero(r->count, sizeof *r->soma, e);
    for (int64_t k = 0; r->soma && k < r->count; k++) {
        r->soma[k].stem = -1;
    }
    return r->soma;
}

static void find_middles(Rounding *r)
{
    const OutTree *tree = r->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        if (r->soma_of[i] >= 0) {
            Soma *soma = &r->soma[r->soma_of[i]];
            soma->nodes++;
            Vec3 off = vec3_sub(tree->position[i], soma->middle);
            soma->middle = vec3_madd(soma->middle, 1.0f / (float)soma->nodes, off);
        }
    }
}

// The radius of the ball with the area of the segments, or of the outline.
static bool find_radii(Rounding *r, Error *e)
{
    const OutTree *tree = r->tree;
    double *sum = memory_alloc_zero(2 * r->count, sizeof *sum, e); // areas and distances
    for (int64_t i = 0; sum && i < tree->count; i++) {
        int32_t parent = tree->parent[i], number = r->soma_of[i];
        if (number < 0) {
            continue;
        }
        Soma *soma = &r->soma[number];
        sum[2 * number + 1] += (double)vec3_distance(tree->position[i], soma->middle);
        if (parent >= 0) {
            float girth = tree->radius[i] + tree->radius[parent];
            sum[2 * number] +=
                (double)(girth * vec3_distance(tree->position[i], tree->position[parent]));
        } else {
            soma->radius = soma->nodes == 1 ? tree->radius[i] : 0.0f;
        }
    }
    for (int64_t k = 0; sum && k < r->count; k++) {
        Soma *soma = &r->soma[k];
        float by_area = sqrtf((float)(sum[2 * k] * 0.25));
        float by_distance = (float)(sum[2 * k + 1] / (double)soma->nodes);
        soma->radius = fmaxf(soma->radius, fmaxf(by_area, by_distance));
    }
    free(sum);
    return sum;
}

static void find_stems(Rounding *r)
{
    const OutTree *tree = r->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        int32_t number = parent >= 0 && r->soma_of[i] < 0 ? r->soma_of[parent] : -1;
        Soma *soma = number >= 0 ? &r->soma[number] : NULL;
        if (soma && (soma->stem < 0 || tree->radius[i] > tree->radius[soma->stem])) {
            soma->stem = (int32_t)i;
        }
    }
}

// The axis of each ball points to the first node of its stem outside of it. Until add_nodes, place
// holds the soma whose stem has reached a node.
static void find_axes(Rounding *r)
{
    const OutTree *tree = r->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        int32_t number = r->soma_of[i] < 0 && parent >= 0 ? r->soma_of[parent] : -1;
        bool stem = number >= 0 && r->soma[number].stem == i;
        r->place[i] = stem ? number : -1;
        if (!stem && parent >= 0 && r->place[parent] >= 0) {
            const Soma *soma = &r->soma[r->place[parent]];
            if (vec3_distance(tree->position[parent], soma->middle) < soma->radius) {
                r->place[i] = r->place[parent];
                r->place[parent] = -1;
            }
        }
        if (r->place[i] >= 0) {
            Soma *soma = &r->soma[r->place[i]];
            soma->axis = vec3_normalize(vec3_sub(tree->position[i], soma->middle));
        }
    }
    for (int64_t k = 0; k < r->count; k++) {
        Vec3 *axis = &r->soma[k].axis;
        *axis = vec3_dot(*axis, *axis) > 0.5f ? *axis : vec3(0, 1, 0);
    }
}

// Coordinates along and across the axis, in radii. Fuller than a circle, to offset the filtering of
// the skin's axis.
static void ball_node(int k, float *along, float *across)
{
    exact_sincos(3.14159265f * ((float)k + 0.12f) / ((float)BALL_NODES - 0.76f), across, along);
    *along = -*along;
    *across *= sqrtf(1.0f + *along * *along);
}

static bool add_ball(Rounding *r, int64_t root, Soma *soma, Error *e)
{
    float thin = soma->stem >= 0 ? r->tree->radius[soma->stem] : 0.0f;
    soma->first = r->out->count;
    for (int k = 0; k < BALL_NODES; k++) {
        float along, across;
        ball_node(k, &along, &across);
        Vec3 position = vec3_madd(soma->middle, along * soma->radius, soma->axis);
        int64_t node = out_tree_add_node(r->out, position, k == 0 ? -1 : soma->first + k - 1,
                                         r->tree->birth[root], SWC_SOMA,
                                         random_key(r->tree->id[root], (uint64_t)k), e);
        if (node < 0) {
            return false;
        }
        float radius = across * soma->radius;
        r->out->radius[node] = along > 0.0f ? fmaxf(radius, thin) : radius;
    }
    return true;
}

// The node of the ball's chain at which a branch that leaves the ball at i starts.
static int64_t leaving_at(const Rounding *r, const Soma *soma, int64_t i)
{
    if (i == soma->stem) {
        return soma->first + BALL_NODES - 1;
    }
    Vec3 way = vec3_normalize(vec3_sub(r->tree->position[i], soma->middle));
    float wanted = vec3_dot(way, soma->axis), best = INFINITY;
    int64_t node = soma->first + POLE_NODES;
    for (int k = POLE_NODES; k < BALL_NODES - POLE_NODES; k++) {
        float along, across;
        ball_node(k, &along, &across);
        if (fabsf(along - wanted) < best) {
            best = fabsf(along - wanted);
            node = soma->first + k;
        }
    }
    return node;
}

static bool add_nodes(Rounding *r, Error *e)
{
    const OutTree *tree = r->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (r->soma_of[i] >= 0) {
            if (parent < 0 && !add_ball(r, i, &r->soma[r->soma_of[i]], e)) {
                return false;
            }
            continue;
        }
        int32_t number = parent >= 0 ? r->soma_of[parent] : -1;
        int64_t above = parent < 0    ? -1
                        : number >= 0 ? leaving_at(r, &r->soma[number], i)
                                      : r->place[parent];
        r->place[i] = (int32_t)out_tree_copy_node(r->out, above, tree, i, e);
        if (r->place[i] < 0) {
            return false;
        }
    }
    return true;
}

OutTree *skeleton_round_soma(const OutTree *tree, Error *e)
{
    Rounding r = {.tree = tree,
                  .out = out_tree_new(e),
                  .soma_of = memory_alloc(tree->count, sizeof(int32_t), e),
                  .place = memory_alloc(tree->count, sizeof(int32_t), e)};
    bool done = r.out && r.soma_of && r.place && find_somas(&r, e);
    if (done) {
        find_middles(&r);
        done = find_radii(&r, e);
    }
    if (done) {
        find_stems(&r);
        find_axes(&r);
        r.out->typed = tree->typed;
        done = add_nodes(&r, e);
    }
    free(r.soma);
    free(r.soma_of);
    free(r.place);
    if (!done) {
        out_tree_free(r.out);
        return NULL;
    }
    return r.out;
}
