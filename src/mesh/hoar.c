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

Mesh *hoar_tuft(float spread, uint64_t key, Error *e)
{
    Mesh *mesh = mesh_new(3, 4 * SPIKES, 4 * SPIKES, 0, e);
    if (!mesh) {
        return NULL;
    }
    int64_t count = 0;
    for (uint64_t i = 0; i < NEEDLES; i++) {
        uint64_t own = random_key(key, i);
        float turn = random_range(random_key(own, 0), 0.0f, 2.0f * PI_F);
        float tilt = spread * RADIANS_PER_DEGREE * (i == 0 ? 0.2f : random_unit(own));
        float s, c, sine, cosine;
        exact_sincos(tilt, &s, &c);
        exact_sincos(turn, &sine, &cosine);
        Vec3 d = vec3(s * cosine, c, s * sine), u = vec3_perpendicular(d);
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
