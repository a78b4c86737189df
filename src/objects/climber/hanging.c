// Shoots of a climber that leave the surface and find nothing to hold.
#include "objects/climber/climber.h"

#include "base/noise.h"
#include "base/random.h"
#include "shape/envelope.h"

enum { STREAM_CHOICE = 1, STREAM_LENGTH = 2, STREAM_SIDE = 3, STREAM_STEPS = 10 }; // of a shoot

// Pushes p out of the surface, to this distance (m) at least.
static Vec3 keep_off(const ShapeSurface *surface, Vec3 p, float distance)
{
    Vec3 foot = p, normal;
    surface->nearest(surface->user, &foot, &normal);
    float off = vec3_dot(vec3_sub(p, foot), normal);
    return off < distance ? vec3_madd(foot, distance, normal) : p;
}

// 0..1: how much of a mass of shoots is at p; 1 everywhere without masses.
static float mass_at(const HangingParams *hanging, Vec3 p, uint64_t key)
{
    Vec3 at = vec3_scale(p, 1.0f / hanging->clump_size);
    float noise = noise_space(at, key) + 0.4f * noise_space(vec3_scale(at, 2.7f), key + 1);
    return lerpf(1.0f, smoothstepf(-0.35f, 0.55f, noise), hanging->clumping);
}

// Grows a shoot from the node, in a mass of shoots (0..1) the longer. Its first piece leads away
// from the surface; then its weight bends it down.
static bool add_shoot(OutTree *tree, int64_t node, const ClimberParams *params, float mass,
                      const ShapeSurface *surface, uint64_t key, Error *e)
{
    const HangingParams *hanging = &params->hanging;
    float length =
        mass * hanging->length * random_range(random_key(key, STREAM_LENGTH), 0.25f, 1.0f);
    float step = 0.4f * params->spacing;
    Vec3 normal = tree->normal[node];
    Vec3 heading = vec3_madd(normal, 0.8f, random_direction(random_key(key, STREAM_SIDE)));
    heading = vec3_normalize(vec3_madd(heading, 0.3f, vec3(0, 1, 0)));
    int32_t birth = tree->birth[node], colony = tree->colony[node];
    int64_t last = node;
    for (int i = 0; (float)i * step < length; i++) {
        Vec3 noise = random_direction(random_key(key, STREAM_STEPS + (uint64_t)i));
        heading = vec3_madd(heading, 0.35f * params->wander, noise);
        heading = vec3_madd(heading, 0.08f + 0.5f * hanging->droop, vec3(0, -1, 0));
        heading = vec3_normalize(heading);
        Vec3 p = vec3_madd(tree->position[last], step, heading);
        p = keep_off(surface, p, params->offset + 0.01f);
        heading = vec3_normalize(vec3_sub(p, tree->position[last]));
        uint64_t id = random_key(key, (uint64_t)i);
        int64_t next = out_tree_add_node(tree, p, last, birth + i + 1, colony, id, e);
        if (next < 0) {
            return false;
        }
        tree->normal[next] = normal;
        last = next;
    }
    return true;
}

bool climber_add_hanging(OutTree *tree, const ClimberParams *params, const Recipe *recipe, Error *e)
{
    int64_t clinging = tree->count;
    float chance = (float)params->hanging.count / (float)(clinging > 0 ? clinging : 1);
    uint64_t masses = random_key(recipe->seed, STREAM_CLIMBER_MASSES);
    for (int64_t i = params->start_count; i < clinging; i++) {
        uint64_t key = random_key(random_key(recipe->seed, STREAM_CLIMBER_HANGING), tree->id[i]);
        float mass = mass_at(&params->hanging, tree->position[i], masses);
        if (random_unit(random_key(key, STREAM_CHOICE)) < chance * mass &&
            !add_shoot(tree, i, params, mass, recipe->surface, key, e)) {
            return false;
        }
    }
    return true;
}
