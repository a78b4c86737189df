#include "render/light/light_tree.h"

#include "base/memory.h"

#include <stdlib.h>

enum { BUCKETS = 12, DEEPEST = 60 };

typedef struct LightNode {
    LightBounds bounds;
    int32_t right;  // index of the second child; the first follows its parent; -1 = leaf
    int32_t parent; // -1 at the root
    int32_t light;  // of a leaf
} LightNode;

struct LightTree {
    LightNode *node;
    int32_t *leaf; // node of each light
    int32_t count;
};

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
    LightTree *tree;
    int32_t *item; // lights, parted in place
    int32_t used;  // nodes so far
} Builder;

static float component(Vec3 v, int axis)
{
    return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

static float centre(const LightBounds *b, int axis)
{
    return 0.5f * (component(b->box.low, axis) + component(b->box.high, axis));
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
        float width = component(extent, k);
        if (!(width > 0.0f)) {
            continue;
        }
        int found = best_border(b, item, count, k, component(centres.low, k),
                                component(centres.high, k), longest / width, &cost);
        if (found >= 0) {
            axis = k;
            border = found;
        }
    }
    int64_t first = axis < 0 ? 0
                             : part_items(b, item, count, axis, component(centres.low, axis),
                                          component(centres.high, axis), border);
    return first > 0 && first < count ? first : count / 2;
}

static int32_t build(Builder *b, int64_t begin, int64_t count, int32_t parent, int depth)
{
    int32_t index = b->used++;
    LightNode *node = &b->tree->node[index];
    *node = (LightNode){.right = -1, .parent = parent, .light = b->item[begin]};
    if (count == 1) {
        node->bounds = b->bounds[b->item[begin]];
        b->tree->leaf[b->item[begin]] = index;
        return index;
    }
    int64_t first = split(b, b->item + begin, count, depth);
    int32_t left = build(b, begin, first, index, depth + 1);
    node->right = build(b, begin + first, count - first, index, depth + 1);
    node->bounds = bounds_union(&b->tree->node[left].bounds, &b->tree->node[node->right].bounds);
    return index;
}

LightTree *light_tree_new(const LightBounds *bounds, int64_t count, Error *e)
{
    if (count < 1 || count > INT32_MAX / 2) {
        error_set(e, ERROR_INPUT,
                  "%lld glowing faces and curve segments; at most a thousand million are possible",
                  (long long)count);
        return NULL;
    }
    LightTree *tree = memory_alloc_zero(1, sizeof *tree, e);
    int32_t *item = memory_alloc_zero(count, sizeof *item, e);
    if (tree) {
        tree->count = (int32_t)count;
        tree->node = memory_alloc_zero(2 * count - 1, sizeof *tree->node, e);
        tree->leaf = memory_alloc_zero(count, sizeof *tree->leaf, e);
    }
    if (!tree || !item || !tree->node || !tree->leaf) {
        light_tree_free(tree);
        free(item);
        return NULL;
    }
    for (int32_t i = 0; i < tree->count; i++) {
        item[i] = i;
    }
    Builder builder = {.bounds = bounds, .tree = tree, .item = item};
    build(&builder, 0, count, -1, 0);
    free(item);
    return tree;
}

void light_tree_free(LightTree *tree)
{
    if (tree) {
        free(tree->node);
        free(tree->leaf);
        free(tree);
    }
}

float light_tree_power(const LightTree *tree)
{
    return tree->node[0].bounds.power;
}

// ---- importance

// Runs for every box on the way down the tree: fmaxf would be a call into libm each time.
static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

// Sine and cosine of the half angle that the bounding ball subtends; cosine -1 from inside.
typedef struct Outline {
    Vec3 center;
    float radius_squared;
} Outline;

static inline Outline outline_of(const Aabb *box)
{
    Vec3 half = vec3_scale(vec3_sub(box->high, box->low), 0.5f);
    return (Outline){vec3_add(box->low, half), vec3_dot(half, half)};
}

// cos(max(0, a - b)) from the sines and cosines of two angles in 0 .. pi.
static inline float cos_less(float sin_a, float cos_a, float sin_b, float cos_b)
{
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}

static inline float sine_of(float cosine)
{
    return sqrtf(larger(0.0f, 1.0f - cosine * cosine));
}

// Importance: power over squared distance, times the best cosines at the light and at the receiver.
static float importance_at(const LightBounds *b, const LightReceiver *receiver)
{
    Outline ball = outline_of(&b->box);
    Vec3 to = vec3_sub(ball.center, receiver->position);
    float square = vec3_dot(to, to);
    float result = b->power / larger(larger(square, ball.radius_squared), 1e-12f);
    if (square <= ball.radius_squared) {
        return result;
    }
    to = vec3_scale(to, 1.0f / sqrtf(square));
    float sin_ball = sqrtf(ball.radius_squared / square), cos_ball = sine_of(sin_ball);
    if (b->cos_normal > -1.0f) {
        float leaving = -vec3_dot(b->axis, to);
        leaving = b->two_sided ? fabsf(leaving) : leaving;
        float sin_cone = sine_of(b->cos_normal);
        float inner = cos_less(sine_of(leaving), leaving, sin_cone, b->cos_normal);
        float best = cos_less(sine_of(inner), inner, sin_ball, cos_ball);
        if (best <= 0.0f) {
            return 0.0f;
        }
        result *= best;
    }
    if (vec3_dot(receiver->normal, receiver->normal) > 0.0f) {
        float arriving = vec3_dot(receiver->normal, to);
        float best = cos_less(sine_of(arriving), arriving, sin_ball, cos_ball);
        result *= larger(best, 0.0f);
    }
    return result;
}

// A small light at distance D from a line scatters power * (angle that the segment subtends) / D.
// Sines stand for the angles.
static float importance_along(const LightBounds *b, const LightSegment *s)
{
    Outline ball = outline_of(&b->box);
    Vec3 to = vec3_sub(ball.center, s->origin);
    float along = vec3_dot(to, s->direction);
    float square = larger(larger(vec3_dot(to, to) - along * along, ball.radius_squared), 1e-12f);
    float near = s->near - along, far = s->far - along;
    float sin_near = near / sqrtf(square + near * near);
    float sin_far = isinf(far) ? 1.0f : far / sqrtf(square + far * far);
    return b->power * larger(sin_far - sin_near, 1e-4f) / sqrtf(square);
}

typedef struct Asker {
    const LightReceiver *receiver; // or
    const LightSegment *segment;
} Asker;

static inline float importance(const LightBounds *b, Asker asker)
{
    return asker.receiver ? importance_at(b, asker.receiver) : importance_along(b, asker.segment);
}

// Probability of the first of two children; negative where neither counts.
static inline float first_share(const LightNode *first, const LightNode *second, Asker asker)
{
    float a = importance(&first->bounds, asker), b = importance(&second->bounds, asker);
    return a + b > 0.0f ? a / (a + b) : -1.0f;
}

static int64_t sample(const LightTree *tree, Asker asker, float u, float *probability)
{
    const LightNode *node = tree->node;
    float chance = 1.0f;
    while (node->right >= 0) {
        const LightNode *first = node + 1, *second = tree->node + node->right;
        float share = first_share(first, second, asker);
        if (share < 0.0f) {
            return -1;
        }
        bool left = u < share;
        node = left ? first : second;
        chance *= left ? share : 1.0f - share;
        u = left ? u / share : (u - share) / (1.0f - share);
        u = u < 0.99999994f ? u : 0.99999994f;
    }
    *probability = chance;
    return chance > 0.0f && importance(&node->bounds, asker) > 0.0f ? node->light : -1;
}

static float probability_of(const LightTree *tree, Asker asker, int64_t light)
{
    const LightNode *node = &tree->node[tree->leaf[light]];
    float chance = importance(&node->bounds, asker) > 0.0f ? 1.0f : 0.0f;
    while (node->parent >= 0 && chance > 0.0f) {
        const LightNode *parent = &tree->node[node->parent];
        float share = first_share(parent + 1, tree->node + parent->right, asker);
        if (share < 0.0f) {
            return 0.0f;
        }
        chance *= node == parent + 1 ? share : 1.0f - share;
        node = parent;
    }
    return chance;
}

int64_t light_tree_sample(const LightTree *tree, const LightReceiver *receiver, float u,
                          float *probability)
{
    return sample(tree, (Asker){.receiver = receiver}, u, probability);
}

float light_tree_probability(const LightTree *tree, const LightReceiver *receiver, int64_t light)
{
    return probability_of(tree, (Asker){.receiver = receiver}, light);
}

int64_t light_tree_sample_segment(const LightTree *tree, const LightSegment *segment, float u,
                                  float *probability)
{
    return sample(tree, (Asker){.segment = segment}, u, probability);
}

float light_tree_probability_segment(const LightTree *tree, const LightSegment *segment,
                                     int64_t light)
{
    return probability_of(tree, (Asker){.segment = segment}, light);
}
