// Murray's angles where a subtree has no room to be rotated as a whole: the daughters alone are
// bent.
#include "base/memory.h"
#include "outtree/murray.h"

#include <stdlib.h>

enum { DEEPEST = 8, MOST_MOVED = 4 << DEEPEST };

// Cosine of 0.1 degrees: a fork with less error is left as it is.
#define EXACT_COSINE 0.9999985f

// A bend must not shorten a segment to less than this share of its length, nor turn a vessel by
// more than the angle of this cosine where nothing branches off.
#define LEAST_LENGTH 0.3f
#define LEAST_COSINE 0.25f

typedef struct Bending {
    OutTree *tree;
    int32_t *child;    // first two children of each node, or -1
    uint8_t *children; // their number; 3 = three or more
    MurrayAllowed *allowed;
    void *user;
} Bending;

// A node that a bend moves, or whose parent or parent's parent it moves.
typedef struct Moved {
    int32_t node;
    int32_t parent; // place in the list; -1 = the fork, which stays
    int depth;      // generations below the daughter
    Vec3 to;
} Moved;

typedef struct Bend {
    int count;
    Moved node[MOST_MOVED]; // parents first
} Bend;

static bool bending_alloc(Bending *b, Error *e)
{
    const OutTree *tree = b->tree;
    b->child = memory_alloc(tree->count, 2 * sizeof *b->child, e);
    b->children = memory_alloc_zero(tree->count, sizeof *b->children, e);
    if (!b->child || !b->children) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        b->child[2 * i] = b->child[2 * i + 1] = -1;
        if (parent >= 0 && b->children[parent] < 3) {
            if (b->children[parent] < 2) {
                b->child[2 * parent + b->children[parent]] = (int32_t)i;
            }
            b->children[parent]++;
        }
    }
    return true;
}

// Lists the nodes of the bend that takes the daughter to `to`: from there, the displacement falls
// to nothing over `depth` generations. False where one that moves has more than two children.
static bool list_moved(const Bending *b, int32_t daughter, Vec3 to, int depth, Bend *bend)
{
    Vec3 shift = vec3_sub(to, b->tree->position[daughter]);
    bend->count = 1;
    bend->node[0] = (Moved){daughter, -1, 0, to};
    for (int i = 0; i < bend->count; i++) {
        Moved above = bend->node[i];
        if (above.depth < depth && b->children[above.node] > 2) {
            return false;
        }
        if (above.depth > depth || b->children[above.node] > 2) {
            continue;
        }
        float share = fmaxf(1.0f - (float)(above.depth + 1) / (float)depth, 0.0f);
        for (int k = 0; k < b->children[above.node]; k++) {
            int32_t node = b->child[2 * above.node + k];
            Vec3 at = vec3_madd(b->tree->position[node], share, shift);
            bend->node[bend->count++] = (Moved){node, i, above.depth + 1, at};
        }
    }
    return true;
}

static float turn_cosine(Vec3 a, Vec3 b, Vec3 c)
{
    return vec3_dot(vec3_normalize(vec3_sub(b, a)), vec3_normalize(vec3_sub(c, b)));
}

// Whether the vessel keeps its shape between the node and its parent, and does not turn back there.
static bool is_smooth(const Bending *b, const Bend *bend, int64_t fork, const Moved *moved)
{
    const Vec3 *old = b->tree->position;
    if (moved->parent < 0) {
        return true;
    }
    const Moved *above = &bend->node[moved->parent];
    float length = vec3_distance(above->to, moved->to);
    if (length < LEAST_LENGTH * vec3_distance(old[above->node], old[moved->node])) {
        return false;
    }
    if (b->children[above->node] != 1) {
        return true;
    }
    Vec3 before = above->parent < 0 ? old[fork] : bend->node[above->parent].to;
    int32_t two_above = b->tree->parent[above->node];
    return turn_cosine(before, above->to, moved->to) >= LEAST_COSINE ||
           turn_cosine(before, above->to, moved->to) >=
               turn_cosine(old[two_above], old[above->node], old[moved->node]);
}

static bool is_allowed(const Bending *b, const Bend *bend, int64_t fork)
{
    for (int i = 0; i < bend->count; i++) {
        const Moved *moved = &bend->node[i];
        Vec3 from = moved->parent < 0 ? b->tree->position[fork] : bend->node[moved->parent].to;
        if (!is_smooth(b, bend, fork, moved) ||
            (b->allowed && !b->allowed(b->user, moved->node, from, moved->to))) {
            return false;
        }
    }
    return true;
}

// Bends a daughter of the fork so that it leaves in this direction (unit): as gently and with as
// much of its first segment's length as is allowed.
static bool find_bend(const Bending *b, int64_t fork, int32_t daughter, Vec3 direction, Bend *bend)
{
    static const float share[] = {1.0f, 0.7f, 0.5f, 0.35f};
    Vec3 p = b->tree->position[fork];
    float length = vec3_distance(p, b->tree->position[daughter]);
    for (size_t i = 0; i < sizeof share / sizeof share[0]; i++) {
        Vec3 to = vec3_madd(p, share[i] * length, direction);
        for (int depth = DEEPEST; depth > 0; depth /= 2) {
            if (list_moved(b, daughter, to, depth, bend) && is_allowed(b, bend, fork)) {
                return true;
            }
        }
    }
    return false;
}

static void apply(OutTree *tree, const Bend *bend)
{
    for (int i = 0; i < bend->count; i++) {
        tree->position[bend->node[i].node] = bend->node[i].to;
    }
}

static float sine_of(float cosine)
{
    float square = 1.0f - cosine * cosine;
    return square > 0.0f ? sqrtf(square) : 0.0f;
}

// Planes about an axis, those near the given one first: cosines and sines of 0, 30, -30... 180
// degrees.
enum { PLANES = 12 };
static const float PLANE[PLANES][2] = {
    {1.0f, 0.0f},         {0.8660254f, 0.5f},  {0.8660254f, -0.5f},  {0.5f, 0.8660254f},
    {0.5f, -0.8660254f},  {0.0f, 1.0f},        {0.0f, -1.0f},        {-0.5f, 0.8660254f},
    {-0.5f, -0.8660254f}, {-0.8660254f, 0.5f}, {-0.8660254f, -0.5f}, {-1.0f, 0.0f}};

// Unit vector perpendicular to the axis, toward `v` if that has such a part.
static Vec3 side_of(Vec3 axis, Vec3 v)
{
    Vec3 side = vec3_madd(v, -vec3_dot(v, axis), axis);
    return vec3_dot(side, side) > 1e-10f ? vec3_normalize(side) : vec3_perpendicular(axis);
}

// A fork whose daughters are to leave at the law's angles.
typedef struct Fork {
    int64_t node;
    const int32_t *child;
    Vec3 mother, old[2]; // unit: directions of the mother and of the daughters
    MurrayAngles law;
} Fork;

// False if the node is no fork of one mother and two daughters.
static bool fork_at(const Bending *b, int64_t node, Fork *fork)
{
    const OutTree *tree = b->tree;
    if (b->children[node] != 2 || tree->parent[node] < 0) {
        return false;
    }
    const int32_t *child = &b->child[2 * node];
    Vec3 p = tree->position[node], before = tree->position[tree->parent[node]];
    *fork = (Fork){.node = node,
                   .child = child,
                   .mother = vec3_normalize(vec3_sub(p, before)),
                   .law = murray_angles((double)tree->radius[node], (double)tree->radius[child[0]],
                                        (double)tree->radius[child[1]])};
    for (int k = 0; k < 2; k++) {
        fork->old[k] = vec3_normalize(vec3_sub(tree->position[child[k]], p));
    }
    return vec3_dot(fork->mother, fork->mother) > 0.5f;
}

// The law's directions of both daughters; side: unit, perpendicular to the mother, in their plane.
static void wanted_directions(const Fork *fork, Vec3 side, Vec3 to[2])
{
    float a = (float)fork->law.cosine1, b = (float)fork->law.cosine2;
    to[0] = vec3_madd(vec3_scale(fork->mother, a), sine_of(a), side);
    to[1] = vec3_madd(vec3_scale(fork->mother, b), -sine_of(b), side);
}

static Vec3 side_of_fork(const Fork *fork)
{
    return side_of(fork->mother, vec3_sub(fork->old[0], fork->old[1]));
}

static bool is_exact(const Fork *fork)
{
    Vec3 to[2];
    wanted_directions(fork, side_of_fork(fork), to);
    return vec3_dot(to[0], fork->old[0]) >= EXACT_COSINE &&
           vec3_dot(to[1], fork->old[1]) >= EXACT_COSINE;
}

// Bends both daughters to the law's angles to the mother.
static bool bend_both(const Bending *b, const Fork *fork, Bend bend[2])
{
    Vec3 side = side_of_fork(fork), to[2];
    for (int i = 0; i < PLANES; i++) {
        wanted_directions(fork, vec3_rotate(side, fork->mother, PLANE[i][0], PLANE[i][1]), to);
        if (find_bend(b, fork->node, fork->child[0], to[0], &bend[0]) &&
            find_bend(b, fork->node, fork->child[1], to[1], &bend[1])) {
            apply(b->tree, &bend[0]);
            apply(b->tree, &bend[1]);
            return true;
        }
    }
    return false;
}

// Bends one daughter so that the angle between both is the law's; the other stays.
static bool bend_one(const Bending *b, const Fork *fork, int which, Bend *bend)
{
    Vec3 axis = fork->old[1 - which], side = side_of(axis, fork->old[which]);
    float cosine = (float)fork->law.cosine_between;
    for (int i = 0; i < PLANES; i++) {
        Vec3 apart = vec3_rotate(side, axis, PLANE[i][0], PLANE[i][1]);
        Vec3 to = vec3_madd(vec3_scale(axis, cosine), sine_of(cosine), apart);
        if (find_bend(b, fork->node, fork->child[which], to, bend)) {
            apply(b->tree, bend);
            return true;
        }
    }
    return false;
}

bool out_tree_murray_bend(OutTree *tree, MurrayAllowed *allowed, void *user, Error *e)
{
    Bending b = {.tree = tree, .allowed = allowed, .user = user};
    Bend *bend = memory_alloc(2, sizeof *bend, e);
    bool done = bend && bending_alloc(&b, e);
    for (int64_t i = 0; done && i < tree->count; i++) {
        Fork fork;
        if (!fork_at(&b, i, &fork) || is_exact(&fork) || bend_both(&b, &fork, bend)) {
            continue;
        }
        int thin = tree->radius[fork.child[0]] < tree->radius[fork.child[1]] ? 0 : 1;
        if (!bend_one(&b, &fork, thin, bend)) {
            bend_one(&b, &fork, 1 - thin, bend);
        }
    }
    free(bend);
    free(b.child);
    free(b.children);
    return done;
}
