// Building a light tree: binary splits by cost, then every second level is left out.
#include "render/light/light_tree_internal.h"

#include "base/memory.h"

#include <stdlib.h>

enum { BUCKETS = 12, DEEPEST = 60 };

// A node of the binary tree.
typedef struct Fork {
    LightBounds bounds;
    int32_t right; // index of the second child; the first follows its parent; -1 = leaf
    int32_t light; // of a leaf
} Fork;

// ---- bounds

static float safe_acos(float x)
{
    return acosf(clampf(x, -1.0f, 1.0f));
}

// The smallest cone about both (PBRT, 4th ed., 3.8.4).
static void merge_cones(LightBounds *sum, const LightBounds *a, const LightBounds *b)
{
    float theta_a = safe_acos(a->cos_normal), theta_b = safe_acos(b->cos_normal);
    float between = safe_acos(vec3_dot(a->axis, b->axis));
    if (fminf(between + theta_b, PI_F) <= theta_a) {
        sum->axis = a->axis;
        sum->cos_normal = a->cos_normal;
        return;
    }
    if (fminf(between + theta_a, PI_F) <= theta_b) {
        sum->axis = b->axis;
        sum->cos_normal = b->cos_normal;
        return;
    }
    float theta = 0.5f * (theta_a + between + theta_b), turn = theta - theta_a;
    Vec3 across = vec3_cross(a->axis, b->axis);
    float length = vec3_length(across);
    sum->axis = a->axis;
    sum->cos_normal = -1.0f;
    if (theta < PI_F && length > 1e-6f) {
        across = vec3_scale(across, 1.0f / length);
        sum->axis = vec3_normalize(vec3_rotate(a->axis, across, cosf(turn), sinf(turn)));
        sum->cos_normal = cosf(theta);
    }
}

static LightBounds bounds_union(const LightBounds *a, const LightBounds *b)
{
    if (a->power <= 0.0f || b->power <= 0.0f) {
        return a->power <= 0.0f ? *b : *a;
    }
    LightBounds sum = {.box = aabb_union(a->box, b->box),
                       .power = a->power + b->power,
                       .two_sided = a->two_sided || b->two_sided};
    merge_cones(&sum, a, b);
    return sum;
}

// Cost of a node: surface area times the measure of the directions emitted into times power.
static float split_cost(const LightBounds *b, float stretch)
{
    Vec3 d = vec3_sub(b->box.high, b->box.low);
    float area = 2.0f * (d.x * d.y + d.y * d.z + d.z * d.x);
    float theta = safe_acos(b->cos_normal), wide = fminf(theta + 0.5f * PI_F, PI_F);
    float sine = sqrtf(fmaxf(0.0f, 1.0f - b->cos_normal * b->cos_normal));
    float measure =
        2.0f * PI_F * (1.0f - b->cos_normal) +
        0.5f * PI_F *
            (2.0f * wide * sine - cosf(theta - 2.0f * wide) - 2.0f * theta * sine + b->cos_normal);
    return b->power * measure * area * stretch;
}

// ---- building

typedef struct Builder {
    const LightBounds *bounds;
    const Run *run;
    LightTree *tree;
    Fork *fork;
    int32_t *item;       // lights, parted in place
    int32_t forks, used; // so far; used: nodes of the tree
} Builder;

static float centre(const LightBounds *b, int axis)
{
    return 0.5f * (vec3_axis(b->box.low, axis) + vec3_axis(b->box.high, axis));
}

static int bucket_of(float x, float low, float high)
{
    int bucket = (int)((float)BUCKETS * ((x - low) / (high - low)));
    return bucket < 0 ? 0 : (bucket >= BUCKETS ? BUCKETS - 1 : bucket);
}

// The cheapest split between buckets along an axis; lowers *cost if it finds a cheaper one.
static int best_border(const Builder *b, const int32_t *item, int64_t count, int axis, float low,
                       float high, float stretch, float *cost)
{
    LightBounds bucket[BUCKETS] = {{.power = 0.0f}}, above[BUCKETS];
    for (int64_t i = 0; i < count; i++) {
        const LightBounds *light = &b->bounds[item[i]];
        LightBounds *own = &bucket[bucket_of(centre(light, axis), low, high)];
        *own = bounds_union(own, light);
    }
    above[BUCKETS - 1] = bucket[BUCKETS - 1];
    for (int i = BUCKETS - 2; i > 0; i--) {
        above[i] = bounds_union(&above[i + 1], &bucket[i]);
    }
    int best = -1;
    LightBounds below = {.power = 0.0f};
    for (int i = 0; i + 1 < BUCKETS; i++) {
        below = bounds_union(&below, &bucket[i]);
        float here = split_cost(&below, stretch) + split_cost(&above[i + 1], stretch);
        if (below.power > 0.0f && above[i + 1].power > 0.0f && here < *cost) {
            *cost = here;
            best = i;
        }
    }
    return best;
}

// Partitions the items at the split; returns the number in the first part.
static int64_t part_items(const Builder *b, int32_t *item, int64_t count, int axis, float low,
                          float high, int border)
{
    int64_t first = 0;
    for (int64_t i = 0; i < count; i++) {
        if (bucket_of(centre(&b->bounds[item[i]], axis), low, high) <= border) {
            int32_t swap = item[first];
            item[first++] = item[i];
            item[i] = swap;
        }
    }
    return first;
}

// Size of the first child; half of all if no split is better.
static int64_t split(const Builder *b, int32_t *item, int64_t count, int depth)
{
    Aabb centres = aabb_empty();
    for (int64_t i = 0; i < count; i++) {
        const Aabb *box = &b->bounds[item[i]].box;
        centres = aabb_add(centres, vec3_scale(vec3_add(box->low, box->high), 0.5f));
    }
    Vec3 extent = vec3_sub(centres.high, centres.low);
    float longest = fmaxf(extent.x, fmaxf(extent.y, extent.z)), cost = INFINITY;
    int axis = -1, border = -1;
    for (int k = 0; k < 3 && depth < DEEPEST; k++) {
        float width = vec3_axis(extent, k);
        if (!(width > 0.0f)) {
            continue;
        }
        int found = best_border(b, item, count, k, vec3_axis(centres.low, k),
                                vec3_axis(centres.high, k), longest / width, &cost);
        if (found >= 0) {
            axis = k;
            border = found;
        }
    }
    int64_t first = axis < 0 ? 0
                             : part_items(b, item, count, axis, vec3_axis(centres.low, axis),
                                          vec3_axis(centres.high, axis), border);
    return first > 0 && first < count ? first : count / 2;
}

static int32_t build(Builder *b, int64_t begin, int64_t count, int depth)
{
    int32_t index = b->forks++;
    Fork *fork = &b->fork[index];
    *fork = (Fork){.right = -1, .light = b->item[begin]};
    if (count == 1) {
        fork->bounds = b->bounds[b->item[begin]];
        return index;
    }
    // Cancelled, the rest is built quickly and thrown away.
    int64_t first = run_is_cancelled(b->run) ? count / 2 : split(b, b->item + begin, count, depth);
    int32_t left = build(b, begin, first, depth + 1);
    fork->right = build(b, begin + first, count - first, depth + 1);
    fork->bounds = bounds_union(&b->fork[left].bounds, &b->fork[fork->right].bounds);
    return index;
}

// ---- four children a node

// The children of a fork, or of its children where these are forks themselves. Returns their
// number.
static int gather(const Fork *fork, int32_t root, int32_t child[LIGHT_LANES])
{
    int count = 0;
    const int32_t half[2] = {root + 1, fork[root].right};
    for (int i = 0; i < 2; i++) {
        if (fork[half[i]].right < 0) {
            child[count++] = half[i];
        } else {
            child[count++] = half[i] + 1;
            child[count++] = fork[half[i]].right;
        }
    }
    return count;
}

static void fill_lane(LightNode *node, int lane, const LightBounds *bounds)
{
    Vec3 half = vec3_scale(vec3_sub(bounds->box.high, bounds->box.low), 0.5f);
    Vec3 center = vec3_add(bounds->box.low, half);
    node->center[0][lane] = center.x;
    node->center[1][lane] = center.y;
    node->center[2][lane] = center.z;
    node->radius_squared[lane] = vec3_dot(half, half);
    node->axis[0][lane] = bounds->axis.x;
    node->axis[1][lane] = bounds->axis.y;
    node->axis[2][lane] = bounds->axis.z;
    node->cos_normal[lane] = bounds->cos_normal;
    node->sin_normal[lane] = sqrtf(fmaxf(0.0f, 1.0f - bounds->cos_normal * bounds->cos_normal));
    node->power[lane] = bounds->power;
    node->two_sided[lane] = bounds->two_sided;
}

static int32_t widen(Builder *b, int32_t root, int32_t parent, int32_t lane)
{
    int32_t index = b->used++, child[LIGHT_LANES] = {root};
    LightNode *node = &b->tree->node[index];
    *node = (LightNode){.parent = parent, .lane = lane};
    int count = b->fork[root].right < 0 ? 1 : gather(b->fork, root, child);
    for (int i = 0; i < count; i++) {
        const Fork *fork = &b->fork[child[i]];
        fill_lane(node, i, &fork->bounds);
        if (fork->right < 0) {
            node->child[i] = ~fork->light;
            b->tree->place[fork->light] = (LightPlace){index, i};
        } else {
            node->child[i] = widen(b, child[i], index, i);
        }
    }
    return index;
}

LightTree *light_tree_new(const LightBounds *bounds, int64_t count, const Run *run, Error *e)
{
    if (count < 1 || count > INT32_MAX / 2) {
        error_set(e, ERROR_INPUT,
                  "%lld glowing faces and curve segments; at most a thousand million are possible",
                  (long long)count);
        return NULL;
    }
    LightTree *tree = memory_alloc_zero(1, sizeof *tree, e);
    int32_t *item = memory_alloc_zero(count, sizeof *item, e);
    Fork *fork = memory_alloc_zero(2 * count - 1, sizeof *fork, e);
    if (tree) {
        tree->count = (int32_t)count;
        tree->node = memory_alloc_zero(count, sizeof *tree->node, e);
        tree->place = memory_alloc_zero(count, sizeof *tree->place, e);
    }
    if (!tree || !item || !fork || !tree->node || !tree->place) {
        light_tree_free(tree);
        free(item);
        free(fork);
        return NULL;
    }
    for (int32_t i = 0; i < tree->count; i++) {
        item[i] = i;
    }
    Builder builder = {.bounds = bounds, .run = run, .tree = tree, .fork = fork, .item = item};
    build(&builder, 0, count, 0);
    widen(&builder, 0, -1, 0);
    tree->power = fork[0].bounds.power;
    free(item);
    free(fork);
    if (run_is_cancelled(run)) {
        run_cancel_error(e);
        light_tree_free(tree);
        return NULL;
    }
    return tree;
}

void light_tree_free(LightTree *tree)
{
    if (tree) {
        free(tree->node);
        free(tree->place);
        free(tree);
    }
}
