#include "grow/venation/young_leaf.h"

#include "base/memory.h"
#include "base/random.h"
#include "grow/venation/secondaries.h"
#include "grow/venation/tertiaries.h"

#define MIDRIB_NODES 24 // at least; more if the step asks for it
#define VEIN_NODES 16   // at least, of a young secondary vein up to its arch
#define ARCH_NODES 10   // ... and of its arch
#define RUNG_NODES 6    // ... and of a tertiary vein

enum { STREAM_ROOT_ID = 0 };     // of the seed
enum { STREAM_TERTIARIES = -1 }; // of the secondary veins' key, which takes 0 and up itself

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

// A secondary vein that is planted: its nodes up to its turn follow each other.
typedef struct Planted {
    Secondary vein;
    int64_t first; // of its nodes beyond the midrib
    int pieces;
} Planted;

// Its node nearest to this share of the way to its turn.
static int64_t planted_node(const Planted *planted, float t)
{
    int piece = (int)(t * (float)planted->pieces + 0.5f);
    return planted->first + (piece > 1 ? piece - 1 : 0);
}

// *join: on entry the node of the next vein toward the tip where this one's arch ends; on return
// that of this vein for the one below.
static bool plant_secondary(Leaf *leaf, Planted *planted, int64_t midrib, int64_t *join, Error *e)
{
    const LeafOutline *outline = &leaf->params->outline;
    const Secondary *vein = &planted->vein;
    float s = leaf->scale;
    Vec3 base = secondary_point(outline, vein, 0.0f), turn = secondary_point(outline, vein, 1.0f);
    int pieces = pieces_of(leaf, s * vec3_distance(base, turn), VEIN_NODES);
    int64_t node = midrib_node(leaf, midrib, s * base.y), end = *join;
    planted->first = leaf->tree->count;
    planted->pieces = pieces;
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

// From node to node of the two secondary veins. Smoothing moves neither end.
static bool plant_tertiary(Leaf *leaf, const Planted *lower, const Planted *upper,
                           const Tertiary *vein, Error *e)
{
    const LeafOutline *outline = &leaf->params->outline;
    int64_t node = planted_node(lower, vein->from), end = planted_node(upper, vein->to);
    Vec3 last = leaf->tree->position[end];
    int pieces = pieces_of(leaf, vec3_distance(leaf->tree->position[node], last), RUNG_NODES);
    for (int i = 1; node >= 0 && i < pieces; i++) {
        float t = (float)i / (float)pieces;
        Vec3 p = tertiary_point(outline, &lower->vein, &upper->vein, vein, t);
        node = leaf_add_node(leaf, vec3_scale(p, leaf->scale), node, e);
    }
    leaf->report.loops++;
    return node >= 0 && leaf_add_node(leaf, last, node, e) >= 0;
}

static bool plant_tertiaries(Leaf *leaf, const Planted *lower, const Planted *upper, uint64_t key,
                             Error *e)
{
    for (int i = 0; i < leaf->params->tertiaries; i++) {
        Tertiary vein = tertiary_make(i, leaf->params->tertiaries, key);
        if (!plant_tertiary(leaf, lower, upper, &vein, e)) {
            return false;
        }
    }
    return true;
}

static bool plant_secondaries(Leaf *leaf, Error *e)
{
    const VeinParams *params = leaf->params;
    int64_t midrib = leaf->tree->count;
    uint64_t key = random_key(random_key(params->seed, STREAM_ROOT_ID), 0);
    for (int side = -1; side <= 1; side += 2) {
        int64_t join = -1;
        Planted upper = {0};
        for (int i = params->secondaries - 1; i >= 0; i--) {
            Planted planted = {
                secondary_make(&params->outline, i, params->secondaries, (float)side, key), 0, 0};
            uint64_t own = random_key(random_key(key, (uint64_t)STREAM_TERTIARIES),
                                      2 * (uint64_t)i + (side > 0));
            if (!plant_secondary(leaf, &planted, midrib, &join, e) ||
                (upper.pieces > 0 && !plant_tertiaries(leaf, &planted, &upper, own, e))) {
                return false;
            }
            upper = planted;
        }
    }
    return true;
}

bool leaf_plant(Leaf *leaf, Error *e)
{
    return plant_midrib(leaf, e) && plant_secondaries(leaf, e);
}
