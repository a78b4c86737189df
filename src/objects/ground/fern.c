#include "objects/ground/fern.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "mesh/geometry.h"
#include "mesh/leaf/leaf.h"

#include <stdlib.h>

enum { STREAM_LENGTH = 1, STREAM_ARCH = 2, STREAM_PAIRS = 10 }; // of a frond; PAIRS + i: pair i
enum { STREAM_DROOP_FIRST = 0, STREAM_DROOP_SECOND = 2 };       // of a pair of leaflets

enum { FRONDS = 11, PAIRS = 18 };
#define GOLDEN_ANGLE 2.39996323f

// Position and direction at t = 0..1 along a frond, which starts steeply, arches over and droops.
static void frond_at(Vec3 out, float length, float arch, float t, Vec3 *position, Vec3 *along)
{
    enum { PIECES = 16 };
    Vec3 p = vec3(0, 0, 0), d = vec3(0, 1, 0);
    for (int i = 0; i < PIECES; i++) {
        float sine, cosine;
        exact_sincos(0.3f + arch * t * ((float)i + 0.5f) / PIECES, &sine, &cosine);
        d = vec3_madd(vec3_scale(out, sine), cosine, vec3(0, 1, 0));
        p = vec3_madd(p, length * t / PIECES, d);
    }
    *position = p;
    *along = d;
}

// Two leaflets at t along the frond, longest a third of the way up.
static void add_pair(Part *part, Vec3 out, float length, float arch, float t, uint64_t key)
{
    Vec3 p, along;
    frond_at(out, length, arch, t, &p, &along);
    Vec3 side = vec3_normalize(vec3_cross(along, vec3(0, 1, 0)));
    side = vec3_dot(side, side) > 0.5f ? side : vec3(out.z, 0, -out.x);
    Vec3 up = vec3_cross(side, along);
    float size =
        length * 0.3f * (t < 0.33f ? 0.35f + 1.97f * t : 1.5f - 1.5f * t) + 0.015f * length;
    for (int s = -1; s <= 1; s += 2) {
        Vec3 y = vec3_normalize(vec3_add(vec3_scale(side, (float)s), vec3_scale(along, 0.45f)));
        y = vec3_normalize(vec3_madd(
            y,
            random_range(random_key(key, s < 0 ? STREAM_DROOP_FIRST : STREAM_DROOP_SECOND), -0.2f,
                         0.0f),
            up));
        Vec3 z = vec3_normalize(vec3_madd(up, -vec3_dot(up, y), y));
        part->instance[part->instance_count++] = transform_from_axes(
            vec3_scale(vec3_cross(y, z), size), vec3_scale(y, size), vec3_scale(z, size), p);
    }
}

Mesh *fern_mesh_new(float height, uint64_t seed, Error *e)
{
    LeafParams leaflet = {
        .length = 1.0f, .width = 0.24f, .fold = 8.0f, .curl = 18.0f, .wave = 0.03f, .detail = 1};
    Part part = {.kind = PART_MESH, .mesh = leaf_mesh_new(&leaflet, seed, e)};
    part.instance = memory_alloc(2 * FRONDS * PAIRS, sizeof *part.instance, e);
    Mesh *mesh = NULL;
    if (part.mesh && part.instance) {
        for (int f = 0; f < FRONDS; f++) {
            uint64_t key = random_key(seed, (uint64_t)f);
            float sine, cosine;
            exact_sincos((float)f * GOLDEN_ANGLE, &sine, &cosine);
            float length =
                1.25f * height * random_range(random_key(key, STREAM_LENGTH), 0.7f, 1.05f);
            float arch = random_range(random_key(key, STREAM_ARCH), 1.2f, 1.9f);
            for (int i = 0; i < PAIRS; i++) {
                float t = 0.12f + 0.88f * ((float)i + 0.5f) / PAIRS;
                add_pair(&part, vec3(sine, 0, cosine), length, arch, t,
                         random_key(key, STREAM_PAIRS + (uint64_t)i));
            }
        }
        Run run = run_default();
        mesh = geometry_bake(&part, &run, e);
    }
    mesh_free(part.mesh);
    free(part.instance);
    return mesh;
}
