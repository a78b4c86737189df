#include "grow/venation/young_leaf.h"

#include "base/memory.h"
#include "base/random.h"
#include "grow/venation/secondaries.h"

#define MIDRIB_NODES 24 // at least; more if the step asks for it
#define VEIN_NODES 16   // at least, of a young secondary vein up to its arch
#define ARCH_NODES 10   // ... and of its arch

enum { STREAM_ROOT_ID = 0 }; // of the seed

uint64_t veins_root_id(uint64_t seed)
{
    return random_key(seed, STREAM_ROOT_ID);
}

int64_t leaf_add_node(Leaf *leaf, Vec3 p, int64_t parent, Error *e)
{
    OutTree *tree = leaf->tree;
    uint64_t id = parent < 0 ? veins_root_id(leaf->params->seed)
                             : out_tree_child_id(tree->id[parent], leaf->children[parent]++);
    int64_t node = out_tree_add_node(tree, p, parent, leaf->birth, 0, id, e);
    if (node < 0 || !memory_reserve(&leaf->children, &leaf->child_capacity, tree->count,
                                    sizeof *leaf->children, e)) {
        return -1;
    }
    tree->normal[node] = vec3(0, 0, 1);
    leaf->children[node] = 0;
    return node;
}

static bool plant_midrib(Leaf *leaf, Error *e)
{
    const VeinParams *params = leaf->params;
    float height = params->midrib * leaf->scale * params->outline.length;
    int pieces = (int)(height / params->step);
    pieces = height > 0.0f && pieces < MIDRIB_NODES ? MIDRIB_NODES : pieces;
    int64_t node = leaf_add_node(leaf, vec3(0, 0, 0), -1, e);
    for (int i = 1; node >= 0 && i <= pieces; i++) {
        node = leaf_add_node(leaf, vec3(0, height * (float)i / (float)pieces, 0), node, e);
    }
    return node >= 0;
}

// The node of the midrib nearest to this height. The midrib is planted first, from the base up.
static int64_t midrib_node(const Leaf *leaf, int64_t midrib, float y)
{
    float top = leaf->tree->position[midrib - 1].y;
    int64_t node = top > 0.0f ? (int64_t)(y / top * (float)(midrib - 1) + 0.5f) : 0;
    return node < midrib ? node : midrib - 1;
}

static int pieces_of(const Leaf *leaf, float length, int least)
{
    int pieces = (int)(length / leaf->params->step);
    return pieces > least ? pieces : least;
}

// *join: on entry the node of the next vein toward the tip where this one's arch ends; on return
// that of this vein for the one below.
static bool plant_secondary(Leaf *leaf, const Secondary *vein, int64_t midrib, int64_t *join,
                            Error *e)
{
    const LeafOutline *outline = &leaf->params->outline;
    float s = leaf->scale;
    Vec3 base = secondary_point(outline, vein, 0.0f), turn = secondary_point(outline, vein, 1.0f);
    int pieces = pieces_of(leaf, s * vec3_distance(base, turn), VEIN_NODES);
    int64_t node = midrib_node(leaf, midrib, s * base.y), end = *join;
    int joined = (int)((float)pieces * (SECONDARY_JOIN / SECONDARY_TURN) + 0.5f);
    for (int i = 1; node >= 0 && i <= pieces; i++) {
        float t = (float)i / (float)pieces;
        node = leaf_add_node(leaf, vec3_scale(secondary_point(outline, vein, t), s), node, e);
        *join = i == joined ? node : *join;
    }
    if (node < 0 || !vein->has_arch) {
        return node >= 0;
    }
    Vec3 last = leaf->tree->position[end];
    pieces = pieces_of(leaf, vec3_distance(leaf->tree->position[node], last), ARCH_NODES);
    for (int i = 1; node >= 0 && i < pieces; i++) {
        float t = (float)i / (float)pieces;
        node = leaf_add_node(leaf, vec3_scale(secondary_arch_point(outline, vein, t), s), node, e);
    }
    leaf->report.loops++;
    return node >= 0 && leaf_add_node(leaf, last, node, e) >= 0;
}

static bool plant_secondaries(Leaf *leaf, Error *e)
{
    const VeinParams *params = leaf->params;
    int64_t midrib = leaf->tree->count;
    uint64_t key = random_key(random_key(params->seed, STREAM_ROOT_ID), 0);
    for (int side = -1; side <= 1; side += 2) {
        int64_t join = -1;
        for (int i = params->secondaries - 1; i >= 0; i--) {
            Secondary vein =
                secondary_make(&params->outline, i, params->secondaries, (float)side, key);
            if (!plant_secondary(leaf, &vein, midrib, &join, e)) {
                return false;
            }
        }
    }
    return true;
}

bool leaf_plant(Leaf *leaf, Error *e)
{
    return plant_midrib(leaf, e) && plant_secondaries(leaf, e);
}
