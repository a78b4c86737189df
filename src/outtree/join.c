#include "outtree/join.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Joining {
    OutTree *tree;
    const JoinParams *params;
    int64_t count;    // nodes before the joins
    uint8_t *is_tip;  // per node
    int32_t *partner; // per node: the node it joins, or -1
    int32_t *piece;   // per node: union-find
    float *since;     // per node, m along its branch from the last bridge; negative = one ends here
} Joining;

static int32_t find_piece(int32_t *piece, int32_t i)
{
    while (piece[i] != i) {
        piece[i] = piece[piece[i]];
        i = piece[i];
    }
    return i;
}

static void unite(int32_t *piece, int32_t a, int32_t b)
{
    a = find_piece(piece, a);
    b = find_piece(piece, b);
    piece[a > b ? a : b] = a > b ? b : a;
}

bool out_tree_path_exceeds(const OutTree *tree, int64_t a, int64_t b, float least)
{
    float length = 0.0f;
    while (a != b && length < least) {
        int64_t *later = a > b ? &a : &b;
        int64_t parent = tree->parent[*later];
        if (parent < 0) {
            return true;
        }
        length += vec3_distance(tree->position[*later], tree->position[parent]);
        *later = parent;
    }
    return a != b;
}

// A tip joins ahead, a side across.
static bool suits(const Joining *joining, int64_t tip, int64_t node, Vec3 way, float distance)
{
    const float aslant = 0.6f; // largest cosine between a branch and its bridges
    const OutTree *tree = joining->tree;
    Vec3 heading = vec3_normalize(vec3_sub(tree->position[tip], tree->position[tree->parent[tip]]));
    float ahead = vec3_dot(heading, way);
    bool turned = joining->is_tip[tip] ? ahead >= joining->params->least_cosine * distance
                                       : fabsf(ahead) <= aslant * distance;
    return distance > 0.0f && joining->partner[node] != tip && turned &&
           vec3_dot(tree->normal[tip], tree->normal[node]) > 0.0f &&
           out_tree_path_exceeds(tree, tip, node, joining->params->least_path);
}

static int32_t find_partner(const Joining *joining, int64_t tip)
{
    const OutTree *tree = joining->tree;
    float nearest = joining->params->reach;
    int32_t found = -1;
    for (int64_t i = 0; i < joining->count; i++) {
        Vec3 way = vec3_sub(tree->position[i], tree->position[tip]);
        float distance = vec3_length(way);
        if (distance < nearest && suits(joining, tip, i, way, distance)) {
            nearest = distance;
            found = (int32_t)i;
        }
    }
    return found;
}

static bool add_join(Joining *joining, int64_t from, int64_t to, Error *e)
{
    OutTree *tree = joining->tree;
    int32_t birth = tree->birth[from] > tree->birth[to] ? tree->birth[from] : tree->birth[to];
    uint64_t id = out_tree_child_id(tree->id[from], 1000000 + (int64_t)(tree->id[to] >> 40));
    int64_t node =
        out_tree_add_node(tree, tree->position[to], from, birth + 1, tree->colony[from], id, e);
    if (node < 0) {
        return false;
    }
    tree->normal[node] = tree->normal[to];
    tree->radius[node] = tree->radius[from];
    unite(joining->piece, (int32_t)from, (int32_t)to);
    return true;
}

// Finds the nearest pair of nodes with one of them in node 0's component; false when all is one
// component, or when cancelled.
static bool find_gap(const Joining *joining, const Run *run, int64_t *from, int64_t *to)
{
    const OutTree *tree = joining->tree;
    float nearest = INFINITY;
    for (int64_t i = 0; i < joining->count; i++) {
        if (run_is_cancelled(run)) {
            return false;
        }
        if (find_piece(joining->piece, (int32_t)i) == 0) {
            continue;
        }
        for (int64_t j = 0; j < joining->count; j++) {
            float distance = vec3_distance(tree->position[i], tree->position[j]);
            if (distance < nearest && find_piece(joining->piece, (int32_t)j) == 0) {
                nearest = distance;
                *from = i;
                *to = j;
            }
        }
    }
    return nearest < INFINITY;
}

// Bridges from the sides of branches, in order of the nodes, so that a branch's come before its
// daughters'.
static bool add_bridges(Joining *joining, const Run *run, Error *e)
{
    const OutTree *tree = joining->tree;
    float spacing = joining->params->spacing, *since = joining->since;
    for (int64_t i = 0; i < joining->count && !run_is_cancelled(run); i++) {
        int32_t parent = tree->parent[i];
        if (parent < 0) {
            continue;
        }
        float way = vec3_distance(tree->position[i], tree->position[parent]);
        since[i] = since[i] < 0.0f ? 0.0f : since[parent] + way;
        if (joining->is_tip[i] || since[i] < spacing) {
            continue;
        }
        int32_t to = find_partner(joining, i);
        bool room = to >= 0 && (to < i ? since[to] >= 0.5f * spacing : since[to] >= 0.0f);
        if (!room) {
            continue;
        }
        joining->partner[i] = to;
        since[i] = 0.0f;
        since[to] = to < i ? 0.0f : -1.0f;
        if (!add_join(joining, i, to, e)) {
            return false;
        }
    }
    return true;
}

static bool join(Joining *joining, const Run *run, Error *e)
{
    OutTree *tree = joining->tree;
    memset(joining->is_tip, 1, (size_t)joining->count);
    for (int64_t i = 0; i < joining->count; i++) {
        joining->partner[i] = -1;
        joining->piece[i] = (int32_t)i;
        if (tree->parent[i] >= 0) {
            joining->is_tip[tree->parent[i]] = 0;
            unite(joining->piece, (int32_t)i, tree->parent[i]);
        }
    }
    for (int64_t i = 0; i < joining->count && !run_is_cancelled(run); i++) {
        if (joining->is_tip[i] && tree->parent[i] >= 0) {
            joining->partner[i] = find_partner(joining, i);
            if (joining->partner[i] >= 0 && !add_join(joining, i, joining->partner[i], e)) {
                return false;
            }
        }
    }
    if (joining->params->spacing > 0.0f && !add_bridges(joining, run, e)) {
        return false;
    }
    int64_t from = 0, to = 0;
    while (joining->params->all_one && find_gap(joining, run, &from, &to)) {
        if (!add_join(joining, from, to, e)) {
            return false;
        }
    }
    return !run_is_cancelled(run) || run_cancel_error(e);
}

bool out_tree_join_tips(OutTree *tree, const JoinParams *params, int64_t *joins, const Run *run,
                        Error *e)
{
    Joining joining = {.tree = tree, .params = params, .count = tree->count};
    joining.is_tip = memory_alloc(tree->count, 1, e);
    joining.partner = memory_alloc(tree->count, sizeof *joining.partner, e);
    joining.piece = memory_alloc(tree->count, sizeof *joining.piece, e);
    joining.since = memory_alloc_zero(tree->count, sizeof *joining.since, e);
    bool done = joining.is_tip && joining.partner && joining.piece && joining.since &&
                join(&joining, run, e);
    if (joins) {
        *joins = tree->count - joining.count;
    }
    free(joining.is_tip);
    free(joining.partner);
    free(joining.piece);
    free(joining.since);
    return done;
}

typedef struct Place {
    Vec3 position;
    int32_t node;
} Place;

static int compare_floats(float a, float b)
{
    return a < b ? -1 : (a > b);
}

static int compare_positions(Vec3 a, Vec3 b)
{
    int x = compare_floats(a.x, b.x), y = compare_floats(a.y, b.y);
    return x != 0 ? x : (y != 0 ? y : compare_floats(a.z, b.z));
}

static int compare_places(const void *a, const void *b)
{
    const Place *p = a, *q = b;
    int order = compare_positions(p->position, q->position);
    return order != 0 ? order : (p->node < q->node ? -1 : (p->node > q->node));
}

// All nodes sorted by their places; the caller frees them.
static Place *sort_places(const OutTree *tree, Error *e)
{
    Place *place = memory_alloc(tree->count, sizeof *place, e);
    for (int64_t i = 0; place && i < tree->count; i++) {
        place[i] = (Place){tree->position[i], (int32_t)i};
    }
    if (place) {
        qsort(place, (size_t)tree->count, sizeof *place, compare_places);
    }
    return place;
}

bool *out_tree_find_joined(const OutTree *tree, Error *e)
{
    bool *joined = memory_alloc_zero(tree->count, sizeof *joined, e);
    Place *place = joined ? sort_places(tree, e) : NULL;
    for (int64_t i = 1; place && i < tree->count; i++) {
        if (compare_positions(place[i].position, place[i - 1].position) == 0) {
            joined[place[i].node] = joined[place[i - 1].node] = true;
        }
    }
    if (!place) {
        free(joined);
        return NULL;
    }
    free(place);
    return joined;
}

bool out_tree_count_pieces(const OutTree *tree, int64_t *pieces, int64_t *loops, Error *e)
{
    int32_t *piece = memory_alloc(tree->count, sizeof *piece, e);
    Place *place = sort_places(tree, e);
    bool done = piece && place;
    int64_t edges = 0, places = tree->count > 0;
    for (int64_t i = 0; done && i < tree->count; i++) {
        piece[i] = (int32_t)i;
        if (tree->parent[i] >= 0) {
            unite(piece, (int32_t)i, tree->parent[i]);
            edges++;
        }
    }
    *pieces = 0;
    if (done) {
        for (int64_t i = 1; i < tree->count; i++) {
            if (compare_positions(place[i].position, place[i - 1].position) == 0) {
                unite(piece, place[i].node, place[i - 1].node);
            } else {
                places++;
            }
        }
        for (int64_t i = 0; i < tree->count; i++) {
            *pieces += piece[i] == (int32_t)i;
        }
    }
    if (loops) {
        *loops = edges - places + *pieces;
    }
    free(piece);
    free(place);
    return done;
}
