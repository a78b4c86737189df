// Mistletoe: balls of forked twigs with paired leaves on the limbs of a host.
#include "objects/tree/veteran.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "mesh/quads.h"

#include <stdlib.h>

enum { VARIANTS = 3, SHOOTS = 14, FORKS = 6, SIDES = 4 };
enum { STREAM_HOST = 8, STREAM_BALL = 9, STREAM_SIZE = 1, STREAM_TURN = 2, STREAM_VARIANT = 3 };

#define YOUNGEST 0.3f     // of the mature age: no tree below bears any
#define LOWEST 0.4f       // of the tree's height
#define THINNEST 0.008f   // m, radius of the branch
#define THICKEST 0.03f    // m
#define LEAST_SIZE 0.22f  // m, radius of a ball
#define MOST_SIZE 0.5f    // m
#define SEGMENT 0.165f    // of the ball's radius, length of a twig from fork to fork
#define FORK_ANGLE 32.0f  // degrees from a twig to each of its two
#define TWIG 0.011f       // of the ball's radius, radius of the first twigs
#define LEAF_LENGTH 0.17f // of the ball's radius
#define LEAF_WIDTH 0.05f

typedef struct Host {
    uint64_t key;
    int32_t node;
} Host;

static int by_key(const void *a, const void *b)
{
    const Host *p = a, *q = b;
    return p->key < q->key ? -1 : (p->key > q->key);
}

int tree_mistletoe(const OutTree *tree, const TreeParams *params, uint64_t seed, int32_t *node)
{
    float old = params->age / params->light.mature_age;
    float wanted =
        (float)params->veteran.mistletoe * clampf((old - YOUNGEST) / (1.0f - YOUNGEST), 0.0f, 1.0f);
    int count = (int)(wanted + 0.5f);
    Host *host = count > 0 ? memory_alloc(tree->count, sizeof *host, NULL) : NULL;
    int64_t hosts = 0;
    float low = params->position.y + LOWEST * params->height;
    for (int64_t i = 0; host && i < tree->count; i++) {
        if (tree->colony[i] == TREE_CROWN && tree->position[i].y > low &&
            tree->radius[i] > THINNEST && tree->radius[i] < THICKEST) {
            host[hosts++] =
                (Host){random_key(random_key(seed, tree->id[i]), STREAM_HOST), (int32_t)i};
        }
    }
    count = hosts < count ? (int)hosts : count;
    if (host) {
        qsort(host, (size_t)hosts, sizeof *host, by_key);
    }
    for (int i = 0; node && i < count; i++) {
        node[i] = host[i].node;
    }
    free(host);
    return count;
}

static Vec3 aside(Vec3 d, float degrees, float turn)
{
    float sine, cosine, turn_sine, turn_cosine;
    exact_sincos(degrees * RADIANS_PER_DEGREE, &sine, &cosine);
    exact_sincos(2.0f * PI_F * turn, &turn_sine, &turn_cosine);
    Vec3 u = vec3_perpendicular(d), v = vec3_cross(d, u);
    Vec3 out = vec3_madd(vec3_scale(u, turn_cosine), turn_sine, v);
    return vec3_normalize(vec3_madd(vec3_scale(d, cosine), sine, out));
}

// A strap that bends back, narrow at its base.
static void add_leaf(Quads *quads, Vec3 at, Vec3 d, Vec3 across)
{
    static const float width[5] = {0.25f, 0.75f, 1.0f, 0.85f, 0.25f};
    Vec3 up = vec3_normalize(vec3_cross(across, d));
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int i = 0; i < 5; i++) {
        float t = (float)i / 4.0f, half = 0.5f * LEAF_WIDTH * width[i];
        Vec3 p = vec3_madd(vec3_madd(at, LEAF_LENGTH * t, d), -0.03f * t * t, up);
        quads_vertex(quads, vec3_madd(p, -half, across), (Vec2){0, t});
        quads_vertex(quads, vec3_madd(p, half, across), (Vec2){1, t});
    }
    quads_grid(quads, first, 5, 2);
}

// A twig, and on its end two more, in planes crosswise, or the pair of leaves.
static void add_twig(Quads *quads, Vec3 from, Vec3 d, int forks, uint64_t key)
{
    float length = SEGMENT * random_range(random_key(key, STREAM_SIZE), 0.8f, 1.2f);
    float radius = TWIG * (0.45f + 0.55f * (float)forks / (float)FORKS);
    Vec3 axis[2] = {from, vec3_madd(from, length, d)};
    float radii[2] = {radius, 0.8f * radius};
    quads_tube(quads, axis, radii, 2, SIDES, (Vec2){0.5f, 0.0f});
    float turn = random_unit(random_key(key, STREAM_TURN));
    for (int i = 0; i < 2; i++) {
        Vec3 out = aside(d, FORK_ANGLE, turn + 0.5f * (float)i);
        if (forks > 0) {
            add_twig(quads, axis[1], out, forks - 1, random_key(key, (uint64_t)i + 10u));
        } else {
            add_leaf(quads, axis[1], out, vec3_normalize(vec3_cross(d, out)));
        }
    }
}

static Mesh *make_ball(uint64_t seed, Error *e)
{
    Quads quads = {.e = e};
    for (int i = 0; i < SHOOTS; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        float y = 1.0f - 2.0f * ((float)i + 0.5f) / (float)SHOOTS, sine, cosine;
        exact_sincos(2.39996f * (float)i, &sine, &cosine);
        float r = sqrtf(1.0f - y * y);
        add_twig(&quads, vec3(0, 0, 0), vec3(r * sine, y, r * cosine), FORKS - 1, key);
    }
    return quads_mesh(&quads);
}

static bool fill_balls(Part *part, const OutTree *tree, const int32_t *node, int count, int variant,
                       uint64_t seed, Error *e)
{
    part->instance = memory_alloc(count, sizeof *part->instance, e);
    for (int i = 0; part->instance && i < count; i++) {
        uint64_t key = random_key(random_key(seed, tree->id[node[i]]), STREAM_BALL);
        if ((int)(random_unit(random_key(key, STREAM_VARIANT)) * VARIANTS) != variant) {
            continue;
        }
        float size = random_range(random_key(key, STREAM_SIZE), LEAST_SIZE, MOST_SIZE), sine,
              cosine;
        exact_sincos(2.0f * PI_F * random_unit(random_key(key, STREAM_TURN)), &sine, &cosine);
        Vec3 x = vec3(size * cosine, 0, -size * sine), z = vec3(size * sine, 0, size * cosine);
        part->instance[part->instance_count++] =
            transform_from_axes(x, vec3(0, size, 0), z, tree->position[node[i]]);
    }
    return part->instance;
}

bool tree_add_mistletoe(const OutTree *tree, const TreeParams *params, const Placing *placing,
                        Error *e)
{
    uint64_t seed = placing->recipe->seed;
    int count = tree_mistletoe(tree, params, seed, NULL);
    int32_t *node = memory_alloc(count, sizeof *node, e);
    bool done = node;
    count = done ? tree_mistletoe(tree, params, seed, node) : 0;
    for (int k = 0; done && count > 0 && k < VARIANTS; k++) {
        Part part = {0};
        if (!fill_balls(&part, tree, node, count, k, seed, e)) {
            done = false;
        } else if (part.instance_count == 0) {
            free(part.instance);
        } else {
            part.mesh = make_ball(random_key(seed, (uint64_t)k), e);
            done = placing_add(placing, part, TREE_MISTLETOE, e);
        }
    }
    free(node);
    return done;
}
