// Ice on a surface: blades along the chains of the out-tree, and loose grains.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/common/blades.h"
#include "objects/frost/frost.h"
#include "objects/frost/surface.h"

#include <stdlib.h>

// Of a variant of grains; corner i of its mesh uses the first three + i.
enum { STREAM_BASE_RADIUS = 0, STREAM_TOP_RADIUS = 10, STREAM_TOP_HEIGHT = 20, STREAM_PLACES = 99 };
enum { STREAM_CHANCE = 1, STREAM_TILT = 2, STREAM_TURN = 3, STREAM_SIZE = 4 }; // of a grain

// A grain: a low truncated six-sided pyramid of unit half-width, closed.
static Mesh *grain_mesh(uint64_t seed, Error *e)
{
    enum { SIDES = 6 };
    Mesh *mesh = mesh_new(3, 2 * SIDES, 2 * SIDES + 2 * (SIDES - 2), 0, e);
    if (!mesh) {
        return NULL;
    }
    uint32_t *corner = mesh->index;
    for (uint32_t i = 0; i < SIDES; i++) {
        float s, c, r = random_range(random_key(seed, STREAM_BASE_RADIUS + i), 0.75f, 1.1f);
        exact_sincos(2.0f * PI_F * (float)i / SIDES, &s, &c);
        float top = random_range(random_key(seed, STREAM_TOP_RADIUS + i), 0.25f, 0.6f);
        mesh->position[i] = vec3(r * c, r * s, 0.0f);
        mesh->position[SIDES + i] =
            vec3(top * r * c, top * r * s,
                 random_range(random_key(seed, STREAM_TOP_HEIGHT + i), 0.4f, 0.75f));
        uint32_t j = (i + 1) % SIDES;
        const uint32_t sides[6] = {i, j, SIDES + j, i, SIDES + j, SIDES + i};
        for (int k = 0; k < 6; k++) {
            *corner++ = sides[k];
        }
    }
    for (uint32_t i = 1; i + 1 < SIDES; i++) {
        const uint32_t caps[6] = {0, i + 1, i, SIDES, SIDES + i, SIDES + i + 1};
        for (int k = 0; k < 6; k++) {
            *corner++ = caps[k];
        }
    }
    return mesh;
}

// Places grains densely near the border (on a bubble: near the nucleus), sparsely elsewhere. -1 and
// e on failure.
static int64_t place_grains(const FrostParams *params, uint64_t seed, int64_t wanted, float size,
                            Transform *instance, const Run *run, Error *e)
{
    PointSet *points = frost_points(params, wanted, seed, run, e);
    int64_t count = points ? 0 : -1;
    for (int64_t i = 0; points && i < points->count && count < wanted; i++) {
        if (!run_goes_on(run, i, e)) {
            count = -1;
            break;
        }
        uint64_t key = random_key(seed, (uint64_t)i);
        float depth = frost_depth(params, points->position[i]) / 0.3f;
        float chance = 0.06f + 0.94f / (1.0f + depth * depth * depth);
        if (random_unit(random_key(key, STREAM_CHANCE)) > chance) {
            continue;
        }
        Vec3 z = vec3_normalize(
            vec3_madd(points->normal[i], 0.25f, random_direction(random_key(key, STREAM_TILT))));
        Vec3 x = vec3_normalize(vec3_cross(random_direction(random_key(key, STREAM_TURN)), z));
        float u = random_unit(random_key(key, STREAM_SIZE)), s = size * (0.35f + 1.1f * u * u * u);
        instance[count++] =
            transform_from_axes(vec3_scale(x, s), vec3_scale(vec3_cross(z, x), s), vec3_scale(z, s),
                                vec3_madd(points->position[i], -0.1f * s, points->normal[i]));
    }
    points_free(points);
    return count;
}

static bool add_grains(const FrostParams *params, float size, int variant, int64_t wanted,
                       const Placing *placing, Error *e)
{
    const Recipe *recipe = placing->recipe;
    uint64_t key = random_key(random_key(recipe->seed, STREAM_FROST_GRAINS), (uint64_t)variant);
    Mesh *mesh = grain_mesh(key, e);
    Transform *instance = memory_alloc(wanted, sizeof *instance, e);
    int64_t count = mesh && instance ? place_grains(params, random_key(key, STREAM_PLACES), wanted,
                                                    size, instance, recipe->run, e)
                                     : -1;
    if (count <= 0) {
        mesh_free(mesh);
        free(instance);
        return count == 0;
    }
    Part part = {.mesh = mesh, .instance = instance, .instance_count = count};
    return placing_add(placing, part, variant % 2 ? FROST_RIME : FROST_ICE, e);
}

bool frost_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    enum { VARIANTS = 6 };
    const FrostParams *params = given;
    const OutTree *tree = grown->tree;
    const BladeParams blades = {.relief = params->relief, .white = params->rime};
    bool done = blades_add(tree, &blades, placing, (const int[2]){FROST_ICE, FROST_RIME}, e);
    float size = 0.0f; // as wide as the finest blades
    for (int64_t i = 0; i < tree->count; i++) {
        size = size == 0.0f || tree->radius[i] < size ? tree->radius[i] : size;
    }
    for (int v = 0; done && params->grains >= VARIANTS && v < VARIANTS; v++) {
        done = add_grains(params, size, v, params->grains / VARIANTS, placing, e);
    }
    return done;
}
