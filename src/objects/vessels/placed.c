// Great vessels that the user has placed: VesselsParams.great.
#include "base/memory.h"
#include "base/random.h"
#include "objects/vessels/grow.h"
#include "objects/vessels/stem.h"

#include <math.h>
#include <stdlib.h>

#define NODE_SPACING 0.03f // of the reach

// The nearest node that is no fork: forks are binary. -1 without nodes.
static bool find_origin(const OutTree *tree, Vec3 place, int64_t *nearest, Error *e)
{
    int32_t *children = vessel_child_counts(tree, NULL, e);
    float least = INFINITY;
    *nearest = -1;
    for (int64_t i = 0; children && i < tree->count; i++) {
        float distance = vec3_distance(tree->position[i], place);
        int most = tree->parent[i] < 0 ? 1 : 2; // a root with two vessels has no mother
        if (children[i] < most && distance < least) {
            least = distance;
            *nearest = i;
        }
    }
    free(children);
    return children;
}

// Appends nodes from `parent` (-1 = a new root) along the way to its end.
static bool follow(OutTree *tree, int64_t parent, const GreatVessel *way, float spacing,
                   int32_t colony, uint64_t id, Error *e)
{
    Vec3 by = way->bent ? way->by : vec3_lerp(way->from, way->to, 0.5f);
    float length = vec3_distance(way->from, by) + vec3_distance(by, way->to);
    int pieces = (int)(length / spacing) + 1;
    for (int k = 0; k <= pieces; k++) {
        float t = (float)k / (float)pieces;
        Vec3 at = vec3_lerp(vec3_lerp(way->from, by, t), vec3_lerp(by, way->to, t), t);
        if (parent >= 0 && vec3_distance(at, tree->position[parent]) < 0.25f * spacing) {
            continue; // the vessel begins where it leaves the other
        }
        int32_t birth = parent < 0 ? 0 : tree->birth[parent] + 1;
        parent = out_tree_add_node(tree, at, parent, birth, colony, id, e);
        if (parent < 0) {
            return false;
        }
        id = out_tree_child_id(id, 0);
    }
    return true;
}

bool vessels_plant_placed(OutTree *tree, const VesselsParams *params, int32_t colony, float reach,
                          uint64_t seed, Error *e)
{
    enum { MOST_NODES = 2000 }; // of one stretch
    for (int i = 0; i < params->great_count; i++) {
        const GreatVessel *way = &params->great[i];
        int64_t origin;
        if (way->vein != (colony == VESSELS_VEINS)) {
            continue;
        }
        float spacing = fmaxf(NODE_SPACING * reach,
                              2.0f * vec3_distance(way->from, way->to) / (float)MOST_NODES);
        uint64_t id = random_key(random_key(seed, (uint64_t)colony), (uint64_t)i);
        if (!find_origin(tree, way->from, &origin, e) ||
            !follow(tree, origin, way, spacing, colony, id, e)) {
            return false;
        }
    }
    return true;
}
