// Dead limbs: which die, and the dead wood apart from the living.
#include "objects/tree/veteran.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

#define LIMB_RADIUS 0.01f // m: thinner wood falls off dead limbs
#define LEAST_LIMB 0.02f  // of the trunk's radius: thinnest that dies apart from its axis
#define LARGEST 0.3f      // of what is to die, in one limb
#define UNEVEN 0.15f      // of the tree's height, by which the order of dying differs from heights
#define SHORT 3.0f        // radii: length of a stub beyond its wood below which it is not shown

enum { STREAM_ORDER = 7 }; // of a limb

typedef struct Limb {
    float height; // m, of its top, uneven
    float length; // m, of wood that counts
    int32_t node;
} Limb;

static int from_high(const void *a, const void *b)
{
    const Limb *p = a, *q = b;
    if (p->height != q->height) {
        return p->height > q->height ? -1 : 1;
    }
    return p->node < q->node ? -1 : (p->node > q->node);
}

static float limb_length(const OutTree *tree, int64_t i)
{
    int32_t parent = tree->parent[i];
    return parent >= 0 && tree->colony[i] != TREE_ROOTS && tree->colony[i] != TREE_KNOTS &&
                   tree->radius[i] >= LIMB_RADIUS
               ? vec3_distance(tree->position[parent], tree->position[i])
               : 0.0f;
}

double tree_dead_share(const OutTree *tree)
{
    double all = 0.0, dead = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        double length = tree->colony[i] == TREE_TRUNK ? 0.0 : (double)limb_length(tree, i);
        all += length;
        dead += tree->colony[i] == TREE_SNAGS ? length : 0.0;
    }
    return all > 0.0 ? dead / all : 0.0;
}

// The living limbs, each with what it bears; returns their number. *all: m, of the whole crown.
static int64_t list_limbs(const OutTree *tree, const TreeParams *params, uint64_t seed, Limb *limb,
                          float *length, float *top, float *all)
{
    int64_t count = 0;
    *all = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        length[i] = 0.0f;
        top[i] = tree->position[i].y;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        int32_t parent = tree->parent[i];
        if (tree->colony[i] != TREE_CROWN || parent < 0) {
            continue;
        }
        float own = limb_length(tree, i);
        *all += own;
        length[i] += own;
        length[parent] += length[i];
        top[parent] = top[i] > top[parent] ? top[i] : top[parent];
        if (tree->radius[i] >= LEAST_LIMB * params->trunk.radius &&
            tree->radius[i] < 0.8f * tree->radius[parent] && length[i] > 0.0f) {
            float uneven = random_unit(random_key(random_key(seed, tree->id[i]), STREAM_ORDER));
            limb[count++] =
                (Limb){top[i] - UNEVEN * params->height * uneven, length[i], (int32_t)i};
        }
    }
    return count;
}

// Marks the limbs that die, down to a share of the crown's wood.
static void choose_dying(const OutTree *tree, const Limb *limb, int64_t count, float wanted,
                         bool *dies)
{
    float left = wanted;
    for (int64_t k = 0; k < count && left > 0.0f; k++) {
        int32_t i = limb[k].node;
        bool within = false;
        for (int32_t at = i; at >= 0 && !within; at = tree->parent[at]) {
            within = dies[at];
        }
        if (!within && limb[k].length < LARGEST * wanted + 0.1f) {
            dies[i] = true;
            left -= limb[k].length;
        }
    }
}

bool tree_kill_limbs(OutTree *tree, const TreeParams *params, uint64_t seed, Error *e)
{
    float old = clampf(params->age / params->light.mature_age - 1.0f, 0.0f, 1.0f);
    float share = params->veteran.dead_limbs * old, all;
    if (share <= 0.0f) {
        return true;
    }
    Limb *limb = memory_alloc(tree->count, sizeof *limb, e);
    float *length = limb ? memory_alloc(tree->count, sizeof *length, e) : NULL;
    float *top = length ? memory_alloc(tree->count, sizeof *top, e) : NULL;
    bool *dies = top ? memory_alloc_zero(tree->count, sizeof *dies, e) : NULL;
    bool *keep = dies ? memory_alloc(tree->count, sizeof *keep, e) : NULL;
    bool done = keep;
    if (done) {
        int64_t count = list_limbs(tree, params, seed, limb, length, top, &all);
        qsort(limb, (size_t)count, sizeof *limb, from_high);
        choose_dying(tree, limb, count, share * all, dies);
        for (int64_t i = 0; i < tree->count; i++) {
            int32_t parent = tree->parent[i];
            dies[i] = dies[i] || (parent >= 0 && dies[parent]);
            bool dead = dies[i] && tree->colony[i] != TREE_KNOTS;
            tree->colony[i] = dead ? TREE_SNAGS : tree->colony[i];
            keep[i] = !dies[i] || (dead && tree->radius[i] >= LIMB_RADIUS);
        }
        done = out_tree_keep_nodes(tree, keep, e);
    }
    free(limb);
    free(length);
    free(top);
    free(dies);
    free(keep);
    return done;
}

// Is the node all of a stub that would look sawn off?
static bool is_short(const OutTree *tree, int64_t i, const bool *ends)
{
    int32_t parent = tree->parent[i];
    return ends[i] && tree->colony[parent] != TREE_SNAGS &&
           vec3_distance(tree->position[i], tree->position[parent]) <
               tree->radius[parent] + SHORT * tree->radius[i];
}

static bool add_dead(const OutTree *tree, OutTree *dead, Error *e)
{
    int32_t *made = memory_alloc(tree->count, sizeof *made, e);
    bool *ends = made ? memory_alloc(tree->count, sizeof *ends, e) : NULL;
    bool done = ends;
    for (int64_t i = 0; done && i < tree->count; i++) {
        ends[i] = true;
        if (tree->parent[i] >= 0) {
            ends[tree->parent[i]] = false;
        }
    }
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        if (tree->colony[i] != TREE_SNAGS || parent < 0 || is_short(tree, i, ends)) {
            continue;
        }
        int64_t base = tree->colony[parent] == TREE_SNAGS ? made[parent] : -1;
        if (base < 0) { // a root inside the living wood
            base = out_tree_copy_node(dead, -1, tree, parent, e);
            done = base >= 0;
            if (done) {
                dead->radius[base] = tree->radius[i];
                dead->colony[base] = TREE_SNAGS;
            }
        }
        int64_t node = done ? out_tree_copy_node(dead, base, tree, i, e) : -1;
        done = node >= 0;
        made[i] = (int32_t)node;
    }
    free(ends);
    free(made);
    return done;
}

bool tree_split_dead(const OutTree *tree, OutTree **living, OutTree **dead, Error *e)
{
    *dead = NULL;
    *living = out_tree_copy(tree, e);
    bool *keep = *living ? memory_alloc(tree->count, sizeof *keep, e) : NULL;
    bool some = false;
    for (int64_t i = 0; keep && i < tree->count; i++) {
        keep[i] = tree->colony[i] != TREE_SNAGS && tree->colony[i] != TREE_KNOTS;
        some = some || tree->colony[i] == TREE_SNAGS;
    }
    bool done = keep && out_tree_keep_nodes(*living, keep, e);
    if (done && some) {
        *dead = out_tree_new(e);
        done = *dead && add_dead(tree, *dead, e);
        if (done && (*dead)->count == 0) {
            out_tree_free(*dead);
            *dead = NULL;
        }
    }
    free(keep);
    return done;
}
