// Moss: tufts of short shoots on the bark at a tree's foot.
#include "objects/tree/veteran.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "mesh/quads.h"

#include <stdlib.h>

enum { VARIANTS = 3, SHOOTS = 46 };
enum { STREAM_MOSS = 11, STREAM_FACE = 1, STREAM_SIZE = 2, STREAM_TURN = 3, STREAM_PLACE = 4 };

#define HIGHEST 1.3f // trunk radii above the ground, but at least 0.6 m
#define LEAST_REACH 0.6f
#define TUFT 0.030f  // m, radius of a tuft
#define SHOOT 0.020f // m, length of its shoots
#define SHOOT_WIDTH 0.0045f

// A cushion of pointed shoots, two crossed blades each, +Y up.
static Mesh *make_tuft(uint64_t seed, Error *e)
{
    Quads quads = {.e = e};
    for (int i = 0; i < SHOOTS; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        float share = ((float)i + 0.5f) / (float)SHOOTS, sine, cosine;
        exact_sincos(2.39996f * (float)i, &sine, &cosine);
        float away = TUFT * sqrtf(share);
        Vec3 foot = vec3(away * sine, -0.2f * SHOOT * share, away * cosine);
        Vec3 d = vec3_normalize(vec3(0.8f * share * sine, 1.0f, 0.8f * share * cosine));
        d = vec3_normalize(vec3_madd(d, 0.25f, random_direction(random_key(key, STREAM_TURN))));
        float length =
            SHOOT * random_range(random_key(key, STREAM_SIZE), 0.6f, 1.1f) * (1.0f - 0.35f * share);
        Vec3 u = vec3_perpendicular(d), v = vec3_cross(d, u);
        for (int side = 0; side < 2; side++) {
            Vec3 across = vec3_scale(side ? u : v, 0.5f * SHOOT_WIDTH);
            Vec3 middle = vec3_madd(foot, 0.55f * length, d);
            uint32_t a = quads_vertex(&quads, foot, (Vec2){0.5f, 0});
            uint32_t b = quads_vertex(&quads, vec3_add(middle, across), (Vec2){1, 0.5f});
            uint32_t c = quads_vertex(&quads, vec3_madd(foot, length, d), (Vec2){0.5f, 1});
            quads_face(&quads, a, b, c,
                       quads_vertex(&quads, vec3_sub(middle, across), (Vec2){0, 0.5f}));
        }
    }
    return quads_mesh(&quads);
}

// Area of a face, m2, weighted by how well moss grows there: low, on what faces up or away from the
// sun (-z, as moss of bark does). *normal: unit.
static float face_weight(const Mesh *bark, int64_t face, float ground, float reach, Vec3 *normal)
{
    const uint32_t *v = &bark->index[face * bark->face_size];
    Vec3 a = bark->position[v[0]], b = bark->position[v[1]], c = bark->position[v[2]];
    Vec3 d = bark->face_size == 4 ? bark->position[v[3]] : c;
    Vec3 cross = vec3_cross(vec3_sub(c, a), vec3_sub(d, b));
    if (bark->face_size == 3) {
        cross = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    }
    float area = 0.5f * vec3_length(cross), height = (a.y + c.y) * 0.5f - ground;
    *normal = area > 0.0f ? vec3_scale(cross, 0.5f / area) : vec3(0, 1, 0);
    if (height < -0.02f || height > reach) {
        return 0.0f;
    }
    float low = 1.0f - clampf(height / reach, 0.0f, 1.0f);
    float damp = clampf(0.35f - 0.45f * normal->z + 0.8f * normal->y, 0.0f, 1.0f);
    return area * low * low * damp;
}

// Adds a tuft on each face that a ladder of equal steps in the summed weights meets.
static bool place_tufts(const Mesh *bark, const TreeParams *params, double all, float reach,
                        uint64_t seed, Part part[VARIANTS], Error *e)
{
    int count = params->veteran.moss;
    for (int k = 0; k < VARIANTS; k++) {
        part[k].instance = memory_alloc(count, sizeof *part[k].instance, e);
        if (!part[k].instance) {
            return false;
        }
    }
    double sum = 0.0;
    int next = 0;
    for (int64_t f = 0; f < bark->face_count && next < count; f++) {
        Vec3 n;
        sum += (double)face_weight(bark, f, params->position.y, reach, &n);
        for (; next < count && (next + 0.5) * all / count < sum; next++) {
            uint64_t key = random_key(seed, (uint64_t)next);
            const uint32_t *v = &bark->index[f * bark->face_size];
            float s = random_unit(random_key(key, STREAM_FACE)),
                  t = random_unit(random_key(key, STREAM_PLACE));
            Vec3 p = vec3_lerp(vec3_lerp(bark->position[v[0]], bark->position[v[1]], s),
                               bark->position[v[2]], 0.7f * t);
            float size = random_range(random_key(key, STREAM_SIZE), 0.6f, 1.5f), sine, cosine;
            Vec3 y = vec3_normalize(vec3_add(n, vec3(0, 0.6f, 0)));
            Vec3 u = vec3_perpendicular(y), w = vec3_cross(u, y);
            exact_sincos(2.0f * PI_F * random_unit(random_key(key, STREAM_TURN)), &sine, &cosine);
            Vec3 x = vec3_madd(vec3_scale(u, cosine), sine, w);
            Part *to = &part[next % VARIANTS];
            to->instance[to->instance_count++] = transform_from_axes(
                vec3_scale(x, size), vec3_scale(y, size), vec3_scale(vec3_cross(x, y), size), p);
        }
    }
    return true;
}

bool tree_add_moss(const Mesh *bark, const TreeParams *params, const Placing *placing, Error *e)
{
    if (params->veteran.moss <= 0) {
        return true;
    }
    Part part[VARIANTS] = {0};
    uint64_t seed = random_key(placing->recipe->seed, STREAM_MOSS);
    float reach = HIGHEST * 2.0f * params->trunk.radius;
    reach = reach > LEAST_REACH ? reach : LEAST_REACH;
    double all = 0.0;
    Vec3 n;
    for (int64_t f = 0; f < bark->face_count; f++) {
        all += (double)face_weight(bark, f, params->position.y, reach, &n);
    }
    bool done = place_tufts(bark, params, all, reach, seed, part, e);
    for (int k = 0; k < VARIANTS; k++) {
        if (!done || part[k].instance_count == 0) {
            free(part[k].instance);
            continue;
        }
        part[k].mesh = make_tuft(random_key(seed, (uint64_t)k), e);
        done = placing_add(placing, part[k], TREE_MOSS, e);
    }
    return done;
}
