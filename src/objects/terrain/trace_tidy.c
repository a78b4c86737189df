#include "objects/terrain/trace_tidy.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

// Drops side branches that end within the width of their line: thinning leaves them at steps and
// corners of the paint's edge.
static bool drop_spurs(OutTree *tree, Error *e)
{
    float *ahead = memory_alloc_zero(tree->count, sizeof *ahead, e); // px to the farthest tip
    int32_t *longest = memory_alloc(tree->count, sizeof *longest, e);
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    bool done = ahead && longest && keep;
    for (int64_t i = 0; done && i < tree->count; i++) {
        longest[i] = -1;
    }
    for (int64_t i = done ? tree->count - 1 : -1; i >= 0; i--) {
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            float far = ahead[i] + vec3_distance(tree->position[i], tree->position[parent]);
            if (longest[parent] < 0 || far > ahead[parent]) {
                ahead[parent] = far;
                longest[parent] = (int32_t)i;
            }
        }
    }
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        keep[i] = parent < 0 || longest[parent] == i ||
                  ahead[i] + vec3_distance(tree->position[i], tree->position[parent]) >
                      tree->radius[parent] + 1.5f;
    }
    done = done && out_tree_keep_nodes(tree, keep, e);
    free(ahead);
    free(longest);
    free(keep);
    return done;
}

// How far node i lies within the circle of some fork's width, px along the tree; not positive
// outside of all.
static void reach_forks(const OutTree *tree, const int32_t *children, float *within)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int degree = children[i] + (tree->parent[i] >= 0);
        within[i] = degree > 2 ? tree->radius[i] : -3e38f;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        int32_t below = tree->parent[i];
        if (below >= 0) {
            float left = within[i] - vec3_distance(tree->position[i], tree->position[below]);
            within[below] = left > within[below] ? left : within[below];
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t below = tree->parent[i];
        if (below >= 0) {
            float left = within[below] - vec3_distance(tree->position[i], tree->position[below]);
            within[i] = left > within[i] ? left : within[i];
        }
    }
}

// Widths near forks, px: 0 = not known.
typedef struct Widths {
    int32_t *children;
    float *within;    // see reach_forks
    float *up, *down; // on the node's own line: farther from the root, and nearer to it
    float *most;      // of the lines that meet in a fork
} Widths;

static bool is_fork(const OutTree *tree, const Widths *w, int64_t i)
{
    return w->children[i] + (tree->parent[i] >= 0) > 2;
}

static void find_widths(const OutTree *tree, Widths *w)
{
    reach_forks(tree, w->children, w->within);
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t below = tree->parent[i];
        bool known = w->within[i] <= 0.0f;
        w->up[i] = known ? tree->radius[i] : 0.0f;
        w->down[i] = known                                  ? tree->radius[i]
                     : below < 0 || is_fork(tree, w, below) ? 0.0f
                                                            : w->down[below];
        w->most[i] = 0.0f;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        int32_t below = tree->parent[i];
        if (below >= 0) {
            bool passed = w->within[below] > 0.0f && !is_fork(tree, w, below);
            w->up[below] = passed ? w->up[i] : w->up[below];
            w->most[below] = w->up[i] > w->most[below] ? w->up[i] : w->most[below];
            w->most[i] = w->down[below] > w->most[i] ? w->down[below] : w->most[i];
        }
    }
}

static void set_widths(OutTree *tree, const Widths *w)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (is_fork(tree, w, i)) {
            tree->radius[i] = w->most[i] > 0.0f ? w->most[i] : tree->radius[i];
        } else if (w->within[i] > 0.0f) {
            tree->radius[i] = w->up[i] > 0.0f ? w->up[i] : w->down[i];
        }
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) { // lines that are all near a fork
        int32_t below = tree->parent[i];
        if (below >= 0 && tree->radius[below] == 0.0f) {
            tree->radius[below] = tree->radius[i];
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0 && tree->radius[i] == 0.0f) {
            tree->radius[i] = tree->radius[tree->parent[i]];
        }
    }
}

// Paint is wider where lines meet than any of the lines. Near a fork each line keeps the width that
// it has farther out, and the fork gets the largest of these.
static bool narrow_forks(OutTree *tree, Error *e)
{
    Widths w = {.children = out_tree_count_children(tree, e)};
    w.within = memory_alloc(tree->count, sizeof *w.within, e);
    w.up = memory_alloc(tree->count, sizeof *w.up, e);
    w.down = memory_alloc(tree->count, sizeof *w.down, e);
    w.most = memory_alloc(tree->count, sizeof *w.most, e);
    bool done = w.children && w.within && w.up && w.down && w.most;
    if (done) {
        find_widths(tree, &w);
        set_widths(tree, &w);
    }
    free(w.children);
    free(w.within);
    free(w.up);
    free(w.down);
    free(w.most);
    return done;
}

// Smooths the steps of pixels: each node between two others moves toward their middle.
static bool smooth(OutTree *tree, Error *e)
{
    enum { TIMES = 12 };
    int32_t *children = out_tree_count_children(tree, e);
    int32_t *child = memory_alloc(tree->count, sizeof *child, e);
    Vec3 *moved = memory_alloc(tree->count, sizeof *moved, e);
    float *width = memory_alloc(tree->count, sizeof *width, e);
    bool done = children && child && moved && width;
    for (int64_t i = 0; done && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            child[tree->parent[i]] = (int32_t)i;
        }
    }
    for (int k = 0; done && k < TIMES; k++) {
        for (int64_t i = 0; i < tree->count; i++) {
            int32_t a = tree->parent[i];
            moved[i] = tree->position[i];
            width[i] = tree->radius[i];
            if (a >= 0 && children[i] == 1) {
                int32_t b = child[i];
                Vec3 middle = vec3_lerp(tree->position[a], tree->position[b], 0.5f);
                moved[i] = vec3_lerp(moved[i], middle, 0.5f);
                width[i] = lerpf(width[i], 0.5f * (tree->radius[a] + tree->radius[b]), 0.5f);
            }
        }
        memcpy(tree->position, moved, sizeof *moved * (size_t)tree->count);
        memcpy(tree->radius, width, sizeof *width * (size_t)tree->count);
    }
    free(children);
    free(child);
    free(moved);
    free(width);
    return done;
}

bool trace_tidy(OutTree *tree, Error *e)
{
    return drop_spurs(tree, e) && narrow_forks(tree, e) && smooth(tree, e);
}
