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

// The way as a Bezier curve of four points, or of three: then the first counts twice.
typedef struct Way {
    Vec3 point[4];
    bool swept;
} Way;

// A swept vessel begins where it leaves its mother, in her direction.
static Way make_way(const OutTree *tree, int64_t parent, const GreatVessel *great)
{
    Vec3 by = great->bent ? great->by : vec3_lerp(great->from, great->to, 0.5f);
    Way way = {{great->from, great->from, by, great->to}, false};
    int32_t before = parent >= 0 ? tree->parent[parent] : -1;
    if (great->sweep > 0.0f && before >= 0) {
        Vec3 origin = tree->position[parent];
        Vec3 along = vec3_normalize(vec3_sub(origin, tree->position[before]));
        way.point[0] = origin;
        way.point[1] = vec3_madd(origin, great->sweep, along);
        way.swept = true;
    }
    return way;
}

static Vec3 way_at(const Way *way, float t)
{
    const Vec3 *p = way->point;
    Vec3 end = vec3_lerp(vec3_lerp(p[1], p[2], t), vec3_lerp(p[2], p[3], t), t);
    if (!way->swept) {
        return end;
    }
    Vec3 start = vec3_lerp(vec3_lerp(p[0], p[1], t), vec3_lerp(p[1], p[2], t), t);
    return vec3_lerp(start, end, t);
}

// Appends nodes from `parent` (-1 = a new root) along the way to its end.
static bool follow(OutTree *tree, int64_t parent, const GreatVessel *great, float spacing,
                   int32_t colony, uint64_t id, Error *e)
{
    const Way way = make_way(tree, parent, great);
    float length = 0.0f;
    for (int k = 0; k < 3; k++) {
        length += vec3_distance(way.point[k], way.point[k + 1]);
    }
    int pieces = (int)(length / spacing) + 1;
    for (int k = 0; k <= pieces; k++) {
        Vec3 at = way_at(&way, (float)k / (float)pieces);
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
