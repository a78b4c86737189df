#include "objects/coral/fan.h"

#include "base/exact_math.h"
#include "base/random.h"

enum { PETALS = 8, BENDS = 3 };

#define LOWEST_PETAL 0.36f // radians above the ground: below, a fan is narrow at its foot

enum { STREAM_POINT_X = 0, STREAM_POINT_Y = 1, STREAM_POINT_LIGHT = 2 };     // of an attractor
enum { STREAM_PETALS = 0xfa0, STREAM_BENDS = 0xfa1 };                        // of the seed
enum { STREAM_TURN = 0, STREAM_LENGTH = 1, STREAM_WIDTH = 2 };               // of a petal
enum { STREAM_ALONG = 0, STREAM_UP = 1, STREAM_PHASE = 2, STREAM_HIGH = 3 }; // of a wave

// Whether colony `colony` may grow at (x, y), in units of half the size and of the height from its
// foot: in one of the petals that spread from there, if the fan is uneven. Of two petals side by
// side one may be as long as the fan and the other half as long, with a cleft between.
static bool covered(const CoralParams *p, uint64_t seed, int colony, float x, float y)
{
    float u = p->uneven;
    if (u <= 0.0f) {
        return true;
    }
    uint64_t petals = random_key(random_key(seed, STREAM_PETALS), (uint64_t)colony);
    for (int i = 0; i < PETALS; i++) {
        uint64_t key = random_key(petals, (uint64_t)i);
        float turn = random_range(random_key(key, STREAM_TURN), -0.5f, 0.5f), s, c;
        float share = ((float)i + 0.5f + turn) / PETALS;
        exact_sincos(lerpf(LOWEST_PETAL, PI_F - LOWEST_PETAL, share), &s, &c);
        float length = 1.0f - 0.5f * u * random_unit(random_key(key, STREAM_LENGTH));
        float wide = lerpf(1.0f, random_range(random_key(key, STREAM_WIDTH), 0.14f, 0.3f), u);
        float along = (c * x + s * y) / length - 0.5f, across = (c * y - s * x) / (length * wide);
        if (4.0f * along * along + across * across < 1.0f) {
            return true;
        }
    }
    return false;
}

// How far (m, along z) the fan is bent out of its plane at a point relative to its position: at its
// foot not at all, above in waves about as long as it is wide.
static float bend(const CoralParams *p, uint64_t seed, Vec3 at)
{
    float sum = 0.0f;
    for (int i = 0; i < BENDS && p->uneven > 0.0f; i++) {
        uint64_t key = random_key(random_key(seed, STREAM_BENDS), (uint64_t)i);
        float along = random_range(random_key(key, STREAM_ALONG), -1.2f, 1.2f) / p->size;
        float up = random_range(random_key(key, STREAM_UP), -0.8f, 0.8f) / p->height, s, c;
        float phase = along * at.x + up * at.y + random_unit(random_key(key, STREAM_PHASE));
        exact_sincos(2.0f * PI_F * phase, &s, &c);
        sum += random_range(random_key(key, STREAM_HIGH), 0.02f, 0.06f) * s;
    }
    return p->uneven * p->size * sum * at.y / p->height;
}

PointSet *fan_room(const CoralParams *p, uint64_t seed, Error *e)
{
    PointSet *points = points_new(e);
    float r = 0.5f * p->size, wide = r + (p->colonies > 1 ? p->spread : 0.0f);
    int64_t wanted = p->attractors * p->colonies, tried = 0, met = 0;
    for (uint64_t draw = 0; points && points->count < wanted; draw++) {
        uint64_t key = random_key(seed, draw);
        Vec3 at = vec3(random_range(random_key(key, STREAM_POINT_X), -wide, wide),
                       random_range(random_key(key, STREAM_POINT_Y), 0.0f, p->height), 0.0f);
        bool inside = false;
        for (int i = 0; i < p->colonies && !inside; i++) {
            Vec3 foot = vec3_sub(coral_foot(p, i), p->position);
            float x = (at.x - foot.x) / r, y = at.y / p->height;
            inside = x * x + y * y < 1.0f && covered(p, seed, i, x, y);
        }
        tried++;
        met += inside;
        // light comes from above
        float lit = lerpf(1.0f - p->light, 1.0f, at.y / p->height);
        at.z = bend(p, seed, at);
        if (inside && random_unit(random_key(key, STREAM_POINT_LIGHT)) < lit &&
            !points_add(points, vec3_add(p->position, at), vec3(0, 0, 1), key, e)) {
            points_free(points);
            return NULL;
        }
    }
    if (points) {
        points->dimension = 2;
        points->measure = p->uneven > 0.0f
                              ? 2.0 * (double)(wide * p->height) * (double)met / (double)tried
                              : 0.5 * (double)PI_F * (double)(wide * p->height);
    }
    return points;
}
