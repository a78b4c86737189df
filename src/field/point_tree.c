#include "field/point_tree.h"

#include "base/memory.h"

#include <stdlib.h>

static int compare(const TreePoint *a, const TreePoint *b, int axis)
{
    float p = vec3_axis(a->position, axis), q = vec3_axis(b->position, axis);
    if (p != q) {
        return p < q ? -1 : 1;
    }
    return a->index < b->index ? -1 : a->index > b->index;
}

static int compare_x(const void *a, const void *b)
{
    return compare(a, b, 0);
}

static int compare_y(const void *a, const void *b)
{
    return compare(a, b, 1);
}

static int compare_z(const void *a, const void *b)
{
    return compare(a, b, 2);
}

static int longest_side(const TreePoint *point, int64_t count)
{
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < count; i++) {
        box = aabb_add(box, point[i].position);
    }
    Vec3 side = vec3_sub(box.high, box.low);
    int axis = side.y > side.x ? 1 : 0;
    return side.z > (axis == 1 ? side.y : side.x) ? 2 : axis;
}

static void split(TreePoint *point, int64_t count)
{
    static int (*const order[3])(const void *, const void *) = {compare_x, compare_y, compare_z};
    while (count > 1) {
        int axis = longest_side(point, count);
        int64_t middle = count / 2;
        qsort(point, (size_t)count, sizeof *point, order[axis]);
        point[middle].axis = axis;
        split(point, middle);
        point += middle + 1;
        count -= middle + 1;
    }
}

bool point_tree_init(PointTree *tree, const Vec3 *position, int64_t count, Error *e)
{
    *tree = (PointTree){.count = count};
    tree->point = memory_alloc(count, sizeof *tree->point, e);
    if (!tree->point) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        tree->point[i] = (TreePoint){.position = position[i], .index = (int32_t)i};
    }
    split(tree->point, count);
    return true;
}

void point_tree_free(PointTree *tree)
{
    free(tree->point);
    *tree = (PointTree){0};
}

typedef struct Nearest {
    Vec3 p;
    int64_t skip;
    float distance2;
    const TreePoint *point; // NULL = none so far
} Nearest;

static void take_nearer(Nearest *nearest, const TreePoint *point, Vec3 offset)
{
    float d = vec3_dot(offset, offset);
    bool nearer = d < nearest->distance2 || (d == nearest->distance2 && nearest->point &&
                                             point->index < nearest->point->index);
    if (nearer && point->index != nearest->skip) {
        nearest->distance2 = d;
        nearest->point = point;
    }
}

// outside: along each axis, how far p lies outside of what the points lie in; its square is a bound
// of their distances (Arya and Mount 1993, "Algorithms for fast vector quantization").
static void search(const TreePoint *point, int64_t count, const float outside[3], Nearest *nearest)
{
    if (count == 0) {
        return;
    }
    const float slack = 0.99999f; // for what rounding adds to the bound
    int64_t middle = count / 2;
    const TreePoint *at = &point[middle], *upper = at + 1;
    Vec3 v = vec3_sub(nearest->p, at->position);
    take_nearer(nearest, at, v);
    float beyond = vec3_axis(v, at->axis);
    bool after = beyond > 0.0f;
    search(after ? upper : point, after ? count - middle - 1 : middle, outside, nearest);
    float across[3] = {outside[0], outside[1], outside[2]};
    across[at->axis] = beyond;
    float bound = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
    if (slack * bound <= nearest->distance2) { // equally near points may lie on the other side
        search(after ? point : upper, after ? middle : count - middle - 1, across, nearest);
    }
}

const TreePoint *point_tree_nearest(const PointTree *tree, Vec3 p, int64_t skip)
{
    Nearest nearest = {.p = p, .skip = skip, .distance2 = INFINITY};
    search(tree->point, tree->count, (const float[3]){0.0f, 0.0f, 0.0f}, &nearest);
    return nearest.point;
}
