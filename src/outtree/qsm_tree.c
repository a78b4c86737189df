#include "outtree/qsm.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

#define SEED 0x71736dull        // of the node ids
#define ROUNDING 2e-4           // m, of places; TreeQSM writes four decimals
#define LEAST_SINE_SQUARED 1e-6 // below it axes count as parallel

// Where a cylinder begins: at `place` metres along its parent.
typedef struct Joint {
    int64_t parent; // -1 at a root
    double place;
    int64_t row;
} Joint;

typedef struct Assembly {
    const Cylinder *cylinder;
    int64_t count;
    const double *origin;
    Joint *joint;   // sorted by parent, place and row
    int64_t *first; // [count + 2]: the joints of parent p are first[p + 1] .. first[p + 2] - 1
    int64_t *queue; // rows, parents before children
    int64_t *base;  // node at which a row's cylinder begins
    OutTree *tree;
} Assembly;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Place along the parent, 0 to its length, at which the child begins.
static double find_place(const Cylinder *parent, const Cylinder *child)
{
    double between[3];
    for (int i = 0; i < 3; i++) {
        between[i] = child->start[i] - parent->start[i];
    }
    double cosine = dot(parent->axis, child->axis);
    double along_parent = dot(parent->axis, between), along_child = dot(child->axis, between);
    double sine_squared = 1.0 - cosine * cosine;
    double place = along_parent; // nearest to the child's start
    if (sine_squared > LEAST_SINE_SQUARED) {
        double ahead = (cosine * along_parent - along_child) / sine_squared;
        if (ahead < 0.0) { // the axes are closest behind the child's start
            place = (along_parent - cosine * along_child) / sine_squared;
        }
    }
    if (place < ROUNDING) {
        return 0.0;
    }
    return place > parent->length - ROUNDING ? parent->length : place;
}

static int compare_joints(const void *a, const void *b)
{
    const Joint *p = a, *q = b;
    if (p->parent != q->parent) {
        return p->parent < q->parent ? -1 : 1;
    }
    if (p->place != q->place) {
        return p->place < q->place ? -1 : 1;
    }
    return (p->row > q->row) - (p->row < q->row);
}

static void find_joints(Assembly *a)
{
    for (int64_t i = 0; i < a->count; i++) {
        const Cylinder *child = &a->cylinder[i];
        Joint *joint = &a->joint[i];
        *joint = (Joint){.parent = child->parent, .row = i};
        if (child->parent >= 0) {
            const Cylinder *parent = &a->cylinder[child->parent];
            joint->place = parent->extension == i ? parent->length : find_place(parent, child);
        }
    }
    qsort(a->joint, (size_t)a->count, sizeof *a->joint, compare_joints);
    int64_t at = 0;
    for (int64_t p = 0; p < a->count + 2; p++) {
        while (at < a->count && a->joint[at].parent < p - 1) {
            at++;
        }
        a->first[p] = at;
    }
}

// Adds the node `place` metres along a cylinder, with the cylinder's radius; -1 and e.
static int64_t add_node(Assembly *a, const Cylinder *c, double place, int64_t parent, Error *e)
{
    OutTree *tree = a->tree;
    double p[3];
    for (int i = 0; i < 3; i++) {
        p[i] = c->start[i] - a->origin[i] + place * c->axis[i];
    }
    uint64_t id = random_key(parent >= 0 ? tree->id[parent] : SEED, (uint64_t)tree->count);
    int64_t node = out_tree_add_node(tree, vec3((float)p[0], (float)p[2], (float)-p[1]), parent,
                                     parent >= 0 ? tree->birth[parent] + 1 : 0, 0, id, e);
    if (node >= 0) {
        tree->radius[node] = (float)c->radius;
    }
    return node;
}

// Adds the nodes of a row's cylinder and tells its children where they begin.
static bool add_cylinder(Assembly *a, int64_t row, int64_t *queued, Error *e)
{
    const Cylinder *c = &a->cylinder[row];
    int64_t node = a->base[row];
    double last = 0.0;
    if (node < 0) {
        node = add_node(a, c, 0.0, -1, e);
    }
    int64_t at = a->first[row + 1], end = a->first[row + 2];
    for (; node >= 0 && at < end && a->joint[at].place < c->length; at++) {
        if (a->joint[at].place > last) {
            last = a->joint[at].place;
            node = add_node(a, c, last, node, e);
        }
        a->base[a->joint[at].row] = node;
        a->queue[(*queued)++] = a->joint[at].row;
    }
    node = node >= 0 ? add_node(a, c, c->length, node, e) : -1;
    for (; node >= 0 && at < end; at++) {
        a->base[a->joint[at].row] = node;
        a->queue[(*queued)++] = a->joint[at].row;
    }
    return node >= 0;
}

// Names the loop that the first cylinder that no root leads to is in, or leads to.
static bool fail_at_loop(const Assembly *a, const bool *added, const char *file, Error *e)
{
    int64_t row = 0;
    while (added[row]) {
        row++;
    }
    for (int64_t i = 0; i < a->count; i++) {
        row = a->cylinder[row].parent;
    }
    error_set(e, ERROR_INPUT,
              "cylinder %lld is its own ancestor; parents must lead to a cylinder with parent 0",
              (long long)row + 1);
    error_locate(e, file, a->cylinder[row].line, a->cylinder[row].parent_column);
    return false;
}

static bool assemble(Assembly *a, bool *added, const char *file, Error *e)
{
    int64_t queued = 0;
    find_joints(a);
    for (; queued < a->first[1]; queued++) {
        a->queue[queued] = a->joint[queued].row;
        a->base[a->queue[queued]] = -1;
    }
    for (int64_t i = 0; i < queued; i++) {
        if (!add_cylinder(a, a->queue[i], &queued, e)) {
            return false;
        }
        added[a->queue[i]] = true;
    }
    return queued == a->count || fail_at_loop(a, added, file, e);
}

OutTree *qsm_make_tree(const Cylinder *cylinder, int64_t count, const char *file, Error *e)
{
    static const double zero[3];
    Assembly a = {.cylinder = cylinder, .count = count, .origin = zero};
    for (int64_t i = count - 1; i >= 0; i--) {
        a.origin = cylinder[i].parent < 0 ? cylinder[i].start : a.origin;
    }
    a.joint = memory_alloc(count, sizeof *a.joint, e);
    a.first = a.joint ? memory_alloc(count + 2, sizeof *a.first, e) : NULL;
    a.queue = a.first ? memory_alloc(count, sizeof *a.queue, e) : NULL;
    a.base = a.queue ? memory_alloc(count, sizeof *a.base, e) : NULL;
    bool *added = a.base ? memory_alloc_zero(count, sizeof *added, e) : NULL;
    a.tree = added ? out_tree_new(e) : NULL;
    if (a.tree) {
        a.tree->scanned = true;
    }
    if (a.tree && !assemble(&a, added, file, e)) {
        out_tree_free(a.tree);
        a.tree = NULL;
    }
    free(a.joint);
    free(a.first);
    free(a.queue);
    free(a.base);
    free(added);
    return a.tree;
}
