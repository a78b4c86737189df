// Shoots of a climber that leave the surface and find nothing to hold.
#include "objects/climber/climber.h"

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

// Grows a shoot from the node. Its first piece leads away from the surface; then its weight bends
// it down.
static bool add_shoot(OutTree *tree, int64_t node, const ClimberParams *params,
                      const ShapeSurface *surface, uint64_t key, Error *e)
{
    const HangingParams *hanging = &params->hanging;
    float length = hanging->length * random_range(random_key(key, STREAM_LENGTH), 0.25f, 1.0f);
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
    for (int64_t i = params->start_count; i < clinging; i++) {
        uint64_t key = random_key(random_key(recipe->seed, STREAM_CLIMBER_HANGING), tree->id[i]);
        if (random_unit(random_key(key, STREAM_CHOICE)) < chance &&
            !add_shoot(tree, i, params, recipe->surface, key, e)) {
            return false;
        }
    }
    return true;
}
