#include "render/light/light_tree_internal.h"

float light_tree_power(const LightTree *tree)
{
    return tree->power;
}

// ---- importance of the children of a node

// Runs for every node on the way down the tree: fmaxf would be a call into libm each time.
static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

// cos(max(0, a - b)) from the sines and cosines of two angles in 0 .. pi.
static inline float cos_less(float sin_a, float cos_a, float sin_b, float cos_b)
{
    float turned = cos_a * cos_b + sin_a * sin_b;
    return cos_a > cos_b ? 1.0f : turned;
}

static inline float sine_of(float cosine)
{
    return sqrtf(larger(0.0f, 1.0f - cosine * cosine));
}

// Power over squared distance, times the best cosines at the light and at the receiver.
static inline void importance_at(const LightNode *n, const LightReceiver *receiver,
                                 float importance[LIGHT_LANES])
{
    Vec3 from = receiver->position, up = receiver->normal;
    bool sided = vec3_dot(up, up) > 0.0f;
#pragma omp simd
    for (int i = 0; i < LIGHT_LANES; i++) {
        float x = n->center[0][i] - from.x, y = n->center[1][i] - from.y;
        float z = n->center[2][i] - from.z;
        float square = x * x + y * y + z * z, ball = n->radius_squared[i];
        float near = larger(larger(square, ball), 1e-12f);
        float scale = 1.0f / sqrtf(near);
        float sin_ball = sqrtf(ball) * scale, cos_ball = sine_of(sin_ball);
        float leaving = -(n->axis[0][i] * x + n->axis[1][i] * y + n->axis[2][i] * z) * scale;
        leaving = n->two_sided[i] ? fabsf(leaving) : leaving;
        float inner = cos_less(sine_of(leaving), leaving, n->sin_normal[i], n->cos_normal[i]);
        float sent = larger(cos_less(sine_of(inner), inner, sin_ball, cos_ball), 0.0f);
        sent = n->cos_normal[i] > -1.0f ? sent : 1.0f;
        float arriving = (up.x * x + up.y * y + up.z * z) * scale;
        float taken = larger(cos_less(sine_of(arriving), arriving, sin_ball, cos_ball), 0.0f);
        sent *= sided ? taken : 1.0f;
        importance[i] = n->power[i] / near * (square > ball ? sent : 1.0f);
    }
}

// A small light at distance D from a line scatters power * (angle that the segment subtends) / D.
// Sines stand for the angles.
static inline void importance_along(const LightNode *n, const LightSegment *s,
                                    float importance[LIGHT_LANES])
{
    Vec3 from = s->origin, way = s->direction;
    float last = s->far < 1e15f ? s->far : 1e15f; // its square is finite
#pragma omp simd
    for (int i = 0; i < LIGHT_LANES; i++) {
        float x = n->center[0][i] - from.x, y = n->center[1][i] - from.y;
        float z = n->center[2][i] - from.z;
        float along = x * way.x + y * way.y + z * way.z;
        float aside = x * x + y * y + z * z - along * along;
        float square = larger(larger(aside, n->radius_squared[i]), 1e-12f);
        float near = s->near - along, far = last - along;
        float angle = far / sqrtf(square + far * far) - near / sqrtf(square + near * near);
        importance[i] = n->power[i] * larger(angle, 1e-4f) / sqrtf(square);
    }
}

typedef struct Asker {
    const LightReceiver *receiver; // or
    const LightSegment *segment;
} Asker;

// Fills the children's importance; returns the sum.
static inline float weigh(const LightNode *node, Asker asker, float importance[LIGHT_LANES])
{
    if (asker.receiver) {
        importance_at(node, asker.receiver, importance);
    } else {
        importance_along(node, asker.segment, importance);
    }
    return importance[0] + importance[1] + (importance[2] + importance[3]);
}

// ---- on the way down and up

static int64_t sample(const LightTree *tree, Asker asker, float u, float *probability)
{
    float chance = 1.0f;
    for (int32_t child = 0;;) {
        const LightNode *node = &tree->node[child];
        float importance[LIGHT_LANES], sum = weigh(node, asker, importance);
        if (!(sum > 0.0f)) {
            return -1;
        }
        int lane = 0, last = LIGHT_LANES - 1;
        for (; !(importance[last] > 0.0f); last--) {
        }
        float rest = u * sum;
        for (; lane < last && rest >= importance[lane]; lane++) {
            rest -= importance[lane];
        }
        chance *= importance[lane] / sum;
        u = rest / importance[lane];
        u = u < 0.99999994f ? u : 0.99999994f;
        child = node->child[lane];
        if (child < 0) {
            *probability = chance;
            return chance > 0.0f ? ~child : -1;
        }
    }
}

static float probability_of(const LightTree *tree, Asker asker, int64_t light)
{
    LightPlace place = tree->place[light];
    float chance = 1.0f;
    while (place.node >= 0 && chance > 0.0f) {
        const LightNode *node = &tree->node[place.node];
        float importance[LIGHT_LANES], sum = weigh(node, asker, importance);
        chance *= sum > 0.0f ? importance[place.lane] / sum : 0.0f;
        place = (LightPlace){node->parent, node->lane};
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
