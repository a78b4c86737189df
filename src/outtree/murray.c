#include "outtree/murray.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

// ---- radii ----

#define FINE 1e-4 // m: radii between which the size-dependent law changes its exponent
#define COARSE 1e-3

static double power(double x, double exponent)
{
    return exact_exp(exponent * exact_log(x));
}

double murray_flow(MurrayLaw law, double radius)
{
    if (law.exponent > 0.0f) {
        return power(radius, (double)law.exponent);
    }
    if (radius > COARSE) {
        return power(radius, 2.3);
    }
    double at_coarse = power(COARSE, 2.3);
    if (radius > FINE) {
        return at_coarse * power(radius / COARSE, 2.7);
    }
    return at_coarse * power(FINE / COARSE, 2.7) * power(radius / FINE, 3.0);
}

double murray_radius(MurrayLaw law, double flow)
{
    if (law.exponent > 0.0f) {
        return power(flow, 1.0 / (double)law.exponent);
    }
    double at_coarse = power(COARSE, 2.3), at_fine = at_coarse * power(FINE / COARSE, 2.7);
    if (flow > at_coarse) {
        return power(flow, 1.0 / 2.3);
    }
    return flow > at_fine ? COARSE * power(flow / at_coarse, 1.0 / 2.7)
                          : FINE * power(flow / at_fine, 1.0 / 3.0);
}

float murray_tip_radius(MurrayLaw law, float root_radius, int64_t tips)
{
    double flow = murray_flow(law, (double)root_radius);
    return (float)murray_radius(law, flow / (double)(tips > 1 ? tips : 1));
}

void out_tree_murray_radii(OutTree *tree, MurrayLaw law, float tip_radius)
{
    // A float holds the number of tips exactly up to 2^24; beyond that the sum is rounded.
    memset(tree->radius, 0, sizeof *tree->radius * (size_t)tree->count);
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        tree->radius[i] = tree->radius[i] == 0.0f ? 1.0f : tree->radius[i];
        if (tree->parent[i] >= 0) {
            tree->radius[tree->parent[i]] += tree->radius[i];
        }
    }
    double tip_flow = murray_flow(law, (double)tip_radius);
    float last_tips = 1.0f, last_radius = tip_radius; // consecutive nodes of a branch have equal
                                                      // sums
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->radius[i] != last_tips) {
            last_tips = tree->radius[i];
            last_radius = last_tips == 1.0f
                              ? tip_radius
                              : (float)murray_radius(law, tip_flow * (double)last_tips);
        }
        tree->radius[i] = last_radius;
    }
}

// ---- angles ----

static double clamp_cosine(double x)
{
    return x < -1.0 ? -1.0 : (x > 1.0 ? 1.0 : x);
}

MurrayAngles murray_angles(double r0, double r1, double r2)
{
    double a0 = r0 * r0, a1 = r1 * r1, a2 = r2 * r2;
    double s0 = a0 * a0, s1 = a1 * a1, s2 = a2 * a2;
    return (MurrayAngles){clamp_cosine((s0 + s1 - s2) / (2.0 * a0 * a1)),
                          clamp_cosine((s0 + s2 - s1) / (2.0 * a0 * a2)),
                          clamp_cosine((s0 - s1 - s2) / (2.0 * a1 * a2))};
}

// In double: thousands of rotations are composed on the way to a tip.
typedef struct Vec3d {
    double x, y, z;
} Vec3d;

typedef struct Turn { // unit quaternion
    double w, x, y, z;
} Turn;

static Vec3d to_double(Vec3 a)
{
    return (Vec3d){(double)a.x, (double)a.y, (double)a.z};
}

static Vec3 to_single(Vec3d a)
{
    return vec3((float)a.x, (float)a.y, (float)a.z);
}

static Vec3d add(Vec3d a, Vec3d b)
{
    return (Vec3d){a.x + b.x, a.y + b.y, a.z + b.z};
}

static Vec3d scaled(Vec3d a, double s)
{
    return (Vec3d){a.x * s, a.y * s, a.z * s};
}

static double dot(Vec3d a, Vec3d b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static Vec3d cross(Vec3d a, Vec3d b)
{
    return (Vec3d){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static Vec3d unit(Vec3d a)
{
    double length = sqrt(dot(a, a));
    return length > 0.0 ? scaled(a, 1.0 / length) : a;
}

static Turn turn_unit(Turn q)
{
    double s = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (Turn){q.w * s, q.x * s, q.y * s, q.z * s};
}

static Turn turn_after(Turn a, Turn b) // b first, then a
{
    return turn_unit((Turn){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w});
}

static Vec3d turned(Turn q, Vec3d v)
{
    Vec3d axis = {q.x, q.y, q.z}, t = scaled(cross(axis, v), 2.0);
    return add(add(v, scaled(t, q.w)), cross(axis, t));
}

// Shortest rotation from the unit vector a to the unit vector b.
static Turn turn_between(Vec3d a, Vec3d b)
{
    double cosine = dot(a, b);
    if (cosine < -0.999999) {
        Vec3d axis = to_double(vec3_perpendicular(to_single(a)));
        return (Turn){0.0, axis.x, axis.y, axis.z};
    }
    Vec3d axis = cross(a, b);
    return turn_unit((Turn){1.0 + cosine, axis.x, axis.y, axis.z});
}

static Turn turn_half(Turn q)
{
    return turn_unit((Turn){q.w + 1.0, q.x, q.y, q.z});
}

static const Turn NO_TURN = {1.0, 0.0, 0.0, 0.0};

// State while subtrees are rotated. Nodes in depth-first order, so that a subtree is a contiguous
// range.
typedef struct Turning {
    OutTree *tree;
    Vec3d *place;   // new positions of the nodes whose parent is done
    Turn *turn;     // accumulated rotation of everything below each node
    int32_t *order; // nodes in depth-first order
    int32_t *at;    // index of each node in `order`
    int32_t *size;  // nodes in each subtree, including its root
    int32_t *child; // first two children of each node, or -1
    uint8_t *children;
    MurrayAllowed *allowed;
    void *user;
} Turning;

static void turning_clear(Turning *t)
{
    free(t->place);
    free(t->turn);
    free(t->order);
    free(t->at);
    free(t->size);
    free(t->child);
    free(t->children);
}

static bool turning_alloc(Turning *t, Error *e)
{
    int64_t n = t->tree->count;
    t->place = memory_alloc(n, sizeof *t->place, e);
    t->turn = memory_alloc(n, sizeof *t->turn, e);
    t->child = memory_alloc(n, 2 * sizeof *t->child, e);
    t->children = memory_alloc_zero(n, sizeof *t->children, e);
    if (!t->place || !t->turn || !t->child || !t->children) {
        return false;
    }
    if (!t->allowed) {
        return true;
    }
    t->order = memory_alloc(n, sizeof *t->order, e);
    t->at = memory_alloc(n, sizeof *t->at, e);
    t->size = memory_alloc(n, sizeof *t->size, e);
    return t->order && t->at && t->size;
}

static void find_children(Turning *t)
{
    const OutTree *tree = t->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        t->child[2 * i] = t->child[2 * i + 1] = -1;
        if (parent >= 0 && t->children[parent] < 3) {
            if (t->children[parent] < 2) {
                t->child[2 * parent + t->children[parent]] = (int32_t)i;
            }
            t->children[parent]++;
        }
    }
}

// A node's index follows from its parent's and the sizes of its elder siblings' subtrees.
static void sort_depth_first(Turning *t)
{
    const OutTree *tree = t->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        t->size[i] = 1;
    }
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        if (tree->parent[i] >= 0) {
            t->size[tree->parent[i]] += t->size[i];
        }
    }
    int32_t *next = t->order, roots = 0; // next free index in each node's range
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        int32_t *from = parent >= 0 ? &next[parent] : &roots;
        t->at[i] = *from;
        *from += t->size[i];
        next[i] = t->at[i] + 1;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        t->order[t->at[i]] = (int32_t)i;
    }
}

// A trial rotation of one of a fork's subtrees.
typedef struct Trial {
    int64_t fork;
    Vec3d old; // the fork's position before
    Turn turn; // of everything below the child
} Trial;

static Vec3d trial_place(const Turning *t, const Trial *trial, int64_t node)
{
    if (node == trial->fork) {
        return t->place[node];
    }
    Vec3d p = add(to_double(t->tree->position[node]), scaled(trial->old, -1.0));
    return add(t->place[trial->fork], turned(trial->turn, p));
}

// Whether the rotation q keeps everything below `child` allowed. Most rotations of large subtrees
// fail somewhere, so a few nodes spread over the subtree are tested first, then more, then all.
static bool try_turn(const Turning *t, int64_t fork, int64_t child, Turn q)
{
    enum { FIRST_LOOK = 32, FINER = 8 };
    Trial trial = {fork, to_double(t->tree->position[fork]), turn_after(q, t->turn[fork])};
    int32_t first = t->at[child], end = first + t->size[child];
    int32_t stride = t->size[child] / FIRST_LOOK;
    for (bool last = false; !last; stride /= FINER) {
        last = stride <= 1;
        for (int32_t k = end - 1; k >= first; k -= last ? 1 : stride) {
            int32_t node = t->order[k];
            Vec3d from = trial_place(t, &trial, t->tree->parent[node]);
            Vec3d to = trial_place(t, &trial, node);
            if (!t->allowed(t->user, node, to_single(from), to_single(to))) {
                return false;
            }
        }
    }
    return true;
}

// The wanted rotation, or the largest tried fraction of it that is allowed. *reduced: whether it is
// a fraction.
static Turn allowed_turn(Turning *t, int64_t fork, int64_t child, Turn q, bool *reduced)
{
    enum { HALVINGS = 3 };
    if (!t->allowed) {
        return q;
    }
    for (int i = 0; i <= HALVINGS; i++) {
        if (try_turn(t, fork, child, q)) {
            return q;
        }
        *reduced = true;
        q = turn_half(q);
    }
    return NO_TURN;
}

// Directions of a fork's daughters by Murray's angles about the mother's direction, in the plane of
// the fork.
static void wanted_directions(const float radius[3], Vec3d mother, const Vec3d old[2], Vec3d to[2])
{
    MurrayAngles angles = murray_angles((double)radius[0], (double)radius[1], (double)radius[2]);
    Vec3d apart = add(old[0], scaled(old[1], -1.0));
    apart = add(apart, scaled(mother, -dot(apart, mother)));
    if (dot(apart, apart) < 1e-12) {
        apart = to_double(vec3_perpendicular(to_single(mother)));
    }
    apart = unit(apart);
    double c1 = angles.cosine1, c2 = angles.cosine2;
    to[0] = add(scaled(mother, c1), scaled(apart, sqrt(1.0 - c1 * c1)));
    to[1] = add(scaled(mother, c2), scaled(apart, -sqrt(1.0 - c2 * c2)));
}

static Vec3d mother_direction(const Turning *t, int64_t fork, const Vec3d old[2])
{
    int32_t parent = t->tree->parent[fork];
    if (parent >= 0) {
        Vec3d d = add(t->place[fork], scaled(t->place[parent], -1.0));
        if (dot(d, d) > 0.0) {
            return unit(d);
        }
    }
    double r1 = (double)t->tree->radius[t->child[2 * fork]];
    double r2 = (double)t->tree->radius[t->child[2 * fork + 1]];
    return unit(add(scaled(old[0], r1 * r1), scaled(old[1], r2 * r2)));
}

// Rotates both daughters of a fork; returns whether a rotation was reduced.
static bool turn_fork(Turning *t, int64_t fork)
{
    const OutTree *tree = t->tree;
    const int32_t *child = &t->child[2 * fork];
    const float radius[3] = {tree->radius[fork], tree->radius[child[0]], tree->radius[child[1]]};
    Vec3d old[2], to[2];
    for (int i = 0; i < 2; i++) {
        Vec3 d = vec3_sub(tree->position[child[i]], tree->position[fork]);
        old[i] = unit(turned(t->turn[fork], to_double(d)));
    }
    wanted_directions(radius, mother_direction(t, fork, old), old, to);
    bool reduced = false;
    for (int i = 0; i < 2; i++) {
        Turn q = allowed_turn(t, fork, child[i], turn_between(old[i], to[i]), &reduced);
        t->turn[child[i]] = turn_after(q, t->turn[fork]);
    }
    return reduced;
}

static void place_children(Turning *t, int64_t node)
{
    const OutTree *tree = t->tree;
    for (int i = 0; i < 2 && t->child[2 * node + i] >= 0; i++) {
        int32_t child = t->child[2 * node + i];
        Vec3d along =
            add(to_double(tree->position[child]), scaled(to_double(tree->position[node]), -1.0));
        t->place[child] = add(t->place[node], turned(t->turn[child], along));
    }
}

static void turn_all(Turning *t, uint8_t *bound, MurrayReport *report)
{
    OutTree *tree = t->tree;
    *report = (MurrayReport){0};
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] < 0) {
            t->place[i] = to_double(tree->position[i]);
            t->turn[i] = NO_TURN;
        } else if (t->children[tree->parent[i]] > 2) { // placed here, because no `child` entry
                                                       // lists all of them
            int32_t parent = tree->parent[i];
            Vec3d along =
                add(to_double(tree->position[i]), scaled(to_double(tree->position[parent]), -1.0));
            t->turn[i] = t->turn[parent];
            t->place[i] = add(t->place[parent], turned(t->turn[i], along));
        }
        bool reduced = false;
        if (t->children[i] == 2) {
            reduced = turn_fork(t, i);
            report->forks++;
            report->reduced += reduced;
        } else if (t->children[i] == 1) {
            t->turn[t->child[2 * i]] = t->turn[i];
        }
        report->multiple += t->children[i] > 2;
        if (t->children[i] <= 2) {
            place_children(t, i);
        }
        if (bound) {
            bound[i] = reduced;
        }
    }
    report->exact = report->forks - report->reduced;
}

bool out_tree_murray_turn(OutTree *tree, MurrayAllowed *allowed, void *user, uint8_t *bound,
                          MurrayReport *report, Error *e)
{
    MurrayReport ignored;
    Turning t = {.tree = tree, .allowed = allowed, .user = user};
    bool done = turning_alloc(&t, e);
    if (done) {
        find_children(&t);
        if (allowed) {
            sort_depth_first(&t);
        }
        turn_all(&t, bound, report ? report : &ignored);
        for (int64_t i = 0; i < tree->count; i++) {
            tree->position[i] = to_single(t.place[i]);
        }
    }
    turning_clear(&t);
    return done;
}
