#include "outtree/elbows.h"

#include "base/memory.h"

#include <stdlib.h>

#define LEAST_LEFT 0.1f

enum { SPAN = 256 }; // nodes: bounds the work, which may grow with the square of it

// Nodes of a chain, after the node that it grows from if there is one.
typedef struct Bends {
    const OutTree *tree;
    int32_t *chain; // their numbers
    Vec3 *moved;    // by node: how far, m
    int32_t *next;  // by node: its thickest child, or -1
    int64_t count;
    float most, thick;
} Bends;

static Vec3 position(const Bends *bends, int64_t i)
{
    return bends->tree->position[bends->chain[i]];
}

// The node farthest from the straight way from a to b, by what is allowed to it; -1 if none is too
// far.
static int64_t farthest(const Bends *bends, int64_t a, int64_t b)
{
    Vec3 from = position(bends, a), step = vec3_sub(position(bends, b), from);
    float length2 = vec3_dot(step, step), worst = 1.0f;
    int64_t found = -1;
    for (int64_t i = a + 1; i < b; i++) {
        Vec3 off = vec3_sub(position(bends, i), from);
        float t = length2 > 0.0f ? clampf(vec3_dot(off, step) / length2, 0.0f, 1.0f) : 0.0f;
        float radius = bends->tree->radius[bends->chain[i]];
        float left = fmaxf(bends->thick - radius, LEAST_LEFT * bends->thick);
        float allowed = bends->most * sqrtf(radius * left);
        float away = vec3_length(vec3_madd(off, -t, step)) / fmaxf(allowed, 1e-12f);
        if (away > worst) {
            worst = away;
            found = i;
        }
    }
    return found;
}

// Nodes keep their shares of the way from a to b.
static void straighten(const Bends *bends, int64_t a, int64_t b)
{
    float length = 0.0f, way = 0.0f;
    for (int64_t i = a; i < b; i++) {
        length += vec3_distance(position(bends, i), position(bends, i + 1));
    }
    for (int64_t i = a + 1; i < b && length > 0.0f; i++) {
        way += vec3_distance(position(bends, i - 1), position(bends, i));
        Vec3 to = vec3_lerp(position(bends, a), position(bends, b), way / length);
        Vec3 *moved = &bends->moved[bends->chain[i]];
        *moved = vec3_add(*moved, vec3_sub(to, position(bends, i)));
    }
}

static void straighten_chain(const Bends *bends, int64_t from)
{
    int64_t end[SPAN + 1]; // stack of the right ends still to be reached
    for (int64_t a = from; a + 1 < bends->count;) {
        int64_t height = 0;
        end[height++] = a + SPAN < bends->count ? a + SPAN : bends->count - 1;
        while (height > 0) {
            int64_t b = end[height - 1], split = farthest(bends, a, b);
            if (split >= 0) {
                end[height++] = split;
                continue;
            }
            straighten(bends, a, b);
            a = b;
            height--;
        }
    }
}

static void choose_next(const OutTree *tree, int32_t *next)
{
    for (int64_t i = 0; i < tree->count; i++) {
        next[i] = -1;
        int32_t parent = tree->parent[i];
        if (parent >= 0 && (next[parent] < 0 || tree->radius[i] > tree->radius[next[parent]])) {
            next[parent] = (int32_t)i;
        }
    }
}

// Chains in the order of their first nodes: what a chain grows from has moved before.
static void straighten_all(Bends *bends)
{
    const OutTree *tree = bends->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t base = tree->parent[i];
        if (base >= 0 && bends->next[base] == (int32_t)i) {
            continue;
        }
        Vec3 carried = base >= 0 ? bends->moved[base] : vec3(0, 0, 0);
        bends->count = 0;
        if (base >= 0) {
            bends->chain[bends->count++] = base;
        }
        for (int32_t k = (int32_t)i; k >= 0; k = bends->next[k]) {
            bends->chain[bends->count++] = k;
            bends->moved[k] = carried;
        }
        straighten_chain(bends, base < 0 ? 1 : 0); // roots keep their foot, too
    }
}

bool out_tree_elbows(OutTree *tree, float most, float thick, Error *e)
{
    if (most <= 0.0f) {
        return true;
    }
    Bends bends = {.tree = tree, .most = most, .thick = thick};
    bends.chain = memory_alloc(tree->count, sizeof *bends.chain, e);
    bends.moved = memory_alloc_zero(tree->count, sizeof *bends.moved, e);
    bends.next = memory_alloc(tree->count, sizeof *bends.next, e);
    bool done = bends.chain && bends.moved && bends.next;
    if (done) {
        choose_next(tree, bends.next);
        straighten_all(&bends);
        for (int64_t i = 0; i < tree->count; i++) {
            tree->position[i] = vec3_add(tree->position[i], bends.moved[i]);
        }
    }
    free(bends.chain);
    free(bends.moved);
    free(bends.next);
    return done;
}
