#include "grow/venation/veinlets.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "outtree/join.h"

#include <math.h>
#include <stdlib.h>

enum { LEAST_STEPS = 2, MOST_STEPS = 5 };                           // of a veinlet
enum { STREAM_ORDER = 1, STREAM_SIDE, STREAM_TURN, STREAM_LENGTH }; // of a node's id
enum { STREAM_SHARE = -1 };                                         // of the veins' seed

#define CELL 1.9f      // births: of the grid with one veinlet in a cell
#define CLEARANCE 0.5f // births: from other veins

// ---- stubs ----

// The first node of the free end with this tip, if it is shorter than `length`; else -1.
static int64_t stub_start(const OutTree *tree, const int32_t *children, const bool *joined,
                          int64_t tip, float length)
{
    int64_t start = tip;
    float way = 0.0f;
    while (tree->parent[start] >= 0) {
        int32_t parent = tree->parent[start];
        way += vec3_distance(tree->position[start], tree->position[parent]);
        if (way >= length || children[parent] > 1 || joined[parent]) {
            return way < length ? start : -1;
        }
        start = parent;
    }
    return -1;
}

static bool trim_once(OutTree *tree, float length, int64_t *trimmed, Error *e)
{
    bool *joined = out_tree_find_joined(tree, e),
         *keep = memory_alloc(tree->count, sizeof *keep, e);
    int32_t *children = out_tree_count_children(tree, e);
    bool done = joined && keep && children;
    *trimmed = 0;
    for (int64_t i = 0; done && i < tree->count; i++) {
        keep[i] = true;
    }
    for (int64_t i = 0; done && i < tree->count; i++) {
        int64_t start =
            children[i] == 0 && !joined[i] ? stub_start(tree, children, joined, i, length) : -1;
        if (start >= 0) {
            keep[start] = false;
            ++*trimmed;
        }
    }
    done = done && out_tree_keep_nodes(tree, keep, e);
    free(joined);
    free(keep);
    free(children);
    return done;
}

bool veins_trim(OutTree *tree, float length, Error *e)
{
    int64_t trimmed = 1;
    while (trimmed > 0) { // what a stub leaves may be one itself
        if (!trim_once(tree, length, &trimmed, e)) {
            return false;
        }
    }
    return true;
}

// ---- veinlets ----

typedef struct Veinlets {
    OutTree *tree;
    const VeinParams *params;
    VeinGrid net;   // of the veins without veinlets
    bool *occupied; // by cell
    int64_t columns, rows;
    int32_t birth;
} Veinlets;

// The cell of a place, or NULL beyond the leaf.
static bool *cell_at(const Veinlets *v, Vec3 p)
{
    float cell = CELL * v->params->birth;
    int64_t column = (int64_t)((p.x + 0.5f * v->params->outline.width) / cell);
    int64_t row = (int64_t)(p.y / cell);
    bool within = p.y >= 0.0f && column >= 0 && column < v->columns && row < v->rows;
    return within ? &v->occupied[row * v->columns + column] : NULL;
}

// Whether a veinlet may go on to p, so far from its start.
static bool has_room(const Veinlets *v, Vec3 p, float way)
{
    float clear = fminf(0.75f * way, CLEARANCE * v->params->birth);
    return leaf_contains(&v->params->outline, 1.0f, p) &&
           vein_nearest(&v->net, v->tree->position, p, clear) < 0;
}

static Vec3 turned(Vec3 v, float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * RADIANS_PER_DEGREE, &sine, &cosine);
    return vec3(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, 0);
}

static int64_t add_piece(Veinlets *v, Vec3 p, int64_t parent, int64_t place, Error *e)
{
    OutTree *tree = v->tree;
    uint64_t id = out_tree_child_id(tree->id[parent], place);
    int64_t node = out_tree_add_node(tree, p, parent, v->birth + 1, 0, id, e);
    if (node >= 0) {
        tree->normal[node] = vec3(0, 0, 1);
    }
    return node;
}

// Both arms of a fork at a veinlet's end, where they have room.
static bool add_fork(Veinlets *v, int64_t end, Vec3 along, float way, Error *e)
{
    float step = v->params->step;
    int64_t place = 0;
    for (int side = -1; side <= 1; side += 2) {
        Vec3 p = vec3_madd(v->tree->position[end], step, turned(along, 48.0f * (float)side));
        if (has_room(v, p, way + step) && add_piece(v, p, end, place++, e) < 0) {
            return false;
        }
    }
    return true;
}

// Grows a veinlet from a node of the net, if there is room for one.
static bool add_veinlet(Veinlets *v, int64_t node, int64_t place, Error *e)
{
    const OutTree *tree = v->tree;
    uint64_t key = tree->id[node];
    float step = v->params->step;
    Vec3 vein = vec3_sub(tree->position[node], tree->position[tree->parent[node]]);
    float side = random_unit(random_key(key, STREAM_SIDE)) < 0.5f ? -90.0f : 90.0f;
    float turn = random_range(random_key(key, STREAM_TURN), -30.0f, 30.0f);
    Vec3 along = turned(vec3_normalize(vein), side + turn), at[MOST_STEPS + 1];
    int most = LEAST_STEPS + (int)(random_unit(random_key(key, STREAM_LENGTH)) *
                                   (float)(MOST_STEPS - LEAST_STEPS + 1));
    int steps = 0;
    at[0] = tree->position[node];
    while (steps < most) { // bent a little, always the same way
        along = turned(along, 0.4f * turn);
        Vec3 next = vec3_madd(at[steps], step, along);
        if (!has_room(v, next, (float)(steps + 1) * step)) {
            break;
        }
        at[++steps] = next;
    }
    bool *cell = cell_at(v, at[steps]);
    if (steps < LEAST_STEPS || !cell || *cell) {
        return true;
    }
    *cell = true;
    for (int i = 1; i <= steps; i++) {
        node = add_piece(v, at[i], node, i == 1 ? place : 0, e);
        if (node < 0) {
            return false;
        }
    }
    return steps < 3 || add_fork(v, node, along, (float)steps * step, e);
}

typedef struct Candidate {
    uint64_t key;
    int64_t node;
} Candidate;

static int compare_candidates(const void *a, const void *b)
{
    const Candidate *p = a, *q = b;
    if (p->key != q->key) {
        return p->key < q->key ? -1 : 1;
    }
    return (p->node > q->node) - (p->node < q->node);
}

// All nodes but the root in random order.
static Candidate *make_candidates(const OutTree *tree, int64_t *count, Error *e)
{
    Candidate *candidate = memory_alloc(tree->count, sizeof *candidate, e);
    *count = 0;
    for (int64_t i = 0; candidate && i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            candidate[(*count)++] = (Candidate){random_key(tree->id[i], STREAM_ORDER), i};
        }
    }
    if (candidate) {
        qsort(candidate, (size_t)*count, sizeof *candidate, compare_candidates);
    }
    return candidate;
}

// Cells that are not of the share count as occupied.
static void occupy_rest(const Veinlets *v, float share)
{
    uint64_t key = random_key(v->params->seed, (uint64_t)STREAM_SHARE);
    for (int64_t i = 0; i < v->columns * v->rows; i++) {
        v->occupied[i] = random_unit(random_key(key, (uint64_t)i)) >= share;
    }
}

static bool try_all(Veinlets *v, const Run *run, Error *e)
{
    int64_t count;
    int32_t *children = out_tree_count_children(v->tree, e);
    Candidate *candidate = children ? make_candidates(v->tree, &count, e) : NULL;
    bool done = candidate;
    for (int64_t i = 0; done && i < count; i++) {
        int64_t node = candidate[i].node;
        done = run_goes_on(run, i, e) && add_veinlet(v, node, children[node], e);
    }
    free(children);
    free(candidate);
    return done;
}

bool veins_add_veinlets(OutTree *tree, const VeinParams *params, float share, const Run *run,
                        Error *e)
{
    const LeafOutline *o = &params->outline;
    Veinlets v = {.tree = tree, .params = params, .birth = out_tree_last_birth(tree)};
    v.columns = (int64_t)(o->width / (CELL * params->birth)) + 1;
    v.rows = (int64_t)(o->length / (CELL * params->birth)) + 1;
    v.occupied = memory_alloc_zero(v.columns * v.rows, sizeof *v.occupied, e);
    Aabb box = {vec3(-0.5f * o->width, 0, 0), vec3(0.5f * o->width, o->length, 0)};
    bool done =
        v.occupied && vein_grid_fill(&v.net, tree->position, tree->count, box, params->birth, e);
    if (done) {
        occupy_rest(&v, share);
        done = try_all(&v, run, e);
    }
    vein_grid_free(&v.net);
    free(v.occupied);
    return done;
}
