#include "mesh/hoar.h"

#include "base/exact_math.h"
#include "base/random.h"

#include <stddef.h>

enum { NEEDLES = 5, BARBS = 3, SPIKES = NEEDLES * (1 + BARBS) };

typedef struct Spike {
    Vec3 foot, tip;
    float width;
} Spike;

// A pyramid of three sides and its foot.
static void add_spike(Mesh *mesh, int64_t number, const Spike *spike)
{
    Vec3 along = vec3_normalize(vec3_sub(spike->tip, spike->foot));
    Vec3 u = vec3_perpendicular(along), v = vec3_cross(along, u);
    uint32_t first = (uint32_t)(4 * number);
    for (int i = 0; i < 3; i++) {
        float c = i == 0 ? 1.0f : -0.5f, s = i == 0 ? 0.0f : (i == 1 ? 0.8660254f : -0.8660254f);
        Vec3 off = vec3_add(vec3_scale(u, c * spike->width), vec3_scale(v, s * spike->width));
        mesh->position[first + (uint32_t)i] = vec3_add(spike->foot, off);
    }
    mesh->position[first + 3] = spike->tip;
    static const uint32_t FACES[12] = {0, 1, 3, 1, 2, 3, 2, 0, 3, 2, 1, 0};
    for (int i = 0; i < 12; i++) {
        mesh->index[12 * number + i] = first + FACES[i];
    }
}

// tilt: from +Y, radians; which way is by chance.
static Vec3 direction_of(float tilt, uint64_t key)
{
    float s, c, sine, cosine;
    exact_sincos(tilt, &s, &c);
    exact_sincos(random_range(random_key(key, 0), 0.0f, 2.0f * PI_F), &sine, &cosine);
    return vec3(s * cosine, c, s * sine);
}

Mesh *hoar_tuft(float spread, uint64_t key, Error *e)
{
    Mesh *mesh = mesh_new(3, 4 * SPIKES, 4 * SPIKES, 0, e);
    if (!mesh) {
        return NULL;
    }
    int64_t count = 0;
    for (uint64_t i = 0; i < NEEDLES; i++) {
        uint64_t own = random_key(key, i);
        Vec3 d =
            direction_of(spread * RADIANS_PER_DEGREE * (i == 0 ? 0.2f : random_unit(own)), own);
        Vec3 u = vec3_perpendicular(d);
        float length = i == 0 ? 1.0f : random_range(random_key(own, 1), 0.45f, 0.9f);
        Spike needle = {.tip = vec3_scale(d, length), .width = 0.05f * length};
        add_spike(mesh, count++, &needle);
        for (uint64_t k = 0; k < BARBS; k++) { // a feather: barbs in one plane, 60 degrees off
            float at = length * (0.3f + 0.2f * (float)k), side = k % 2 == 0 ? 1.0f : -1.0f;
            float reach = 0.32f * length * random_range(random_key(own, 2 + k), 0.6f, 1.2f);
            Vec3 out = vec3_add(vec3_scale(d, 0.5f), vec3_scale(u, 0.87f * side));
            Vec3 foot = vec3_scale(d, at);
            add_spike(mesh, count++, &(Spike){foot, vec3_madd(foot, reach, out), 0.035f * length});
        }
    }
    return mesh;
}

// ---- feathers ----

enum { FRONDS = 4, PAIRS = 8, BLADES = FRONDS * (1 + 2 * PAIRS) };

// A blade in the plane of along and `beside` (unit).
static void add_blade(Mesh *mesh, int64_t number, const Spike *blade, Vec3 beside, Vec3 upright)
{
    const float thin = 0.35f; // thickness over width
    uint32_t first = (uint32_t)(4 * number);
    Vec3 *corner = mesh->position + first;
    corner[0] = vec3_madd(blade->foot, blade->width, beside);
    corner[1] = vec3_madd(blade->foot, -blade->width, beside);
    corner[2] = vec3_madd(blade->foot, thin * blade->width, upright);
    corner[3] = blade->tip;
    static const uint32_t FACES[12] = {0, 1, 3, 1, 2, 3, 2, 0, 3, 2, 1, 0};
    Vec3 face = vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[3], corner[0]));
    bool inward = vec3_dot(face, upright) > 0.0f;
    for (int i = 0; i < 12; i++) {
        mesh->index[12 * number + i] = first + FACES[inward ? 11 - i : i];
    }
}

// u: unit, across d in the frond's plane.
static void add_frond(Mesh *mesh, int64_t *count, Vec3 d, Vec3 u, float length, uint64_t key)
{
    Vec3 upright = vec3_cross(d, u);
    Spike axis = {.tip = vec3_scale(d, length), .width = 0.028f * length};
    add_blade(mesh, (*count)++, &axis, u, upright);
    float reach = random_range(random_key(key, 0), 0.3f, 0.5f);
    for (uint64_t k = 0; k < 2 * PAIRS; k++) {
        uint64_t own = random_key(key, 1 + k);
        float side = k % 2 == 0 ? 1.0f : -1.0f;
        uint64_t pair = k / 2;
        float at = ((float)pair + random_range(own, 0.6f, 1.1f)) / (PAIRS + 1);
        float shape = at < 0.35f ? 0.45f + 1.57f * at : 1.55f * (1.0f - at);
        float far = reach * length * shape * random_range(random_key(own, 1), 0.6f, 1.1f);
        Vec3 out = vec3_add(vec3_scale(d, 0.5f), vec3_scale(u, 0.866f * side));
        Vec3 beside = vec3_add(vec3_scale(d, 0.866f), vec3_scale(u, -0.5f * side));
        Vec3 foot = vec3_scale(d, at * length);
        Spike blade = {foot, vec3_madd(foot, far, out), (0.014f + 0.05f * far) * length};
        add_blade(mesh, (*count)++, &blade, beside, upright);
    }
}

Mesh *hoar_feathers(float spread, uint64_t key, Error *e)
{
    Mesh *mesh = mesh_new(3, 4 * BLADES, 4 * BLADES, 0, e);
    if (!mesh) {
        return NULL;
    }
    int64_t count = 0;
    for (uint64_t i = 0; i < FRONDS; i++) {
        uint64_t own = random_key(key, i);
        float s, c;
        Vec3 d =
            direction_of(spread * RADIANS_PER_DEGREE * (i == 0 ? 0.15f : random_unit(own)), own);
        Vec3 out = vec3_cross(d, vec3_perpendicular(d)), other = vec3_perpendicular(d);
        exact_sincos(random_range(random_key(own, 1), 0.0f, PI_F), &s, &c);
        Vec3 u = vec3_add(vec3_scale(out, c), vec3_scale(other, s));
        float length = i == 0 ? 1.0f : random_range(random_key(own, 2), 0.35f, 0.85f);
        add_frond(mesh, &count, d, u, length, random_key(own, 3));
    }
    return mesh;
}
