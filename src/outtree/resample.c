// Resamples an out-tree to even segments; see chains.h.
#include "base/memory.h"
#include "base/random.h"
#include "outtree/chains.h"

#include <stdlib.h>

typedef struct Resampler {
    const OutTree *tree;
    OutTree *out;
    float segment;
    int32_t *children; // per old node
    int32_t *place;    // new index of each kept old node
} Resampler;

static bool stays(const Resampler *r, int32_t node)
{
    return r->tree->parent[node] < 0 || r->children[node] != 1;
}

static float edge_length(const OutTree *tree, int32_t a, int32_t b)
{
    return vec3_distance(tree->position[a], tree->position[b]);
}

// Adds the node at fraction t between the old nodes a and b.
static int64_t add_between(Resampler *r, int32_t a, int32_t b, float t, int64_t parent, uint64_t id,
                           Error *e)
{
    const OutTree *tree = r->tree;
    float birth = lerpf((float)tree->birth[a], (float)tree->birth[b], t);
    int64_t node = out_tree_add_node(r->out, vec3_lerp(tree->position[a], tree->position[b], t),
                                     parent, (int32_t)(birth + 0.5f), tree->colony[b], id, e);
    if (node >= 0) {
        r->out->radius[node] = lerpf(tree->radius[a], tree->radius[b], t);
        Vec3 normal = vec3_normalize(vec3_lerp(tree->normal[a], tree->normal[b], t));
        r->out->normal[node] = vec3_dot(normal, normal) > 0.5f ? normal : tree->normal[b];
    }
    return node;
}

// Resamples the path node[0] .. node[count - 1] between two kept nodes.
static bool resample_piece(Resampler *r, const int32_t *node, int64_t count, Error *e)
{
    const OutTree *tree = r->tree;
    float length = 0.0f;
    for (int64_t k = 1; k < count; k++) {
        length += edge_length(tree, node[k - 1], node[k]);
    }
    float wanted = length / r->segment + 0.5f;
    if (!(wanted < 1e8f)) {
        return error_set(e, ERROR_INPUT,
                         "segments of %g m make too many of a branch of %g m; make them longer",
                         (double)r->segment, (double)length);
    }
    int64_t pieces = wanted > 1.0f ? (int64_t)wanted : 1, k = 1;
    int32_t last = node[count - 1];
    int64_t parent = r->place[node[0]];
    float before = 0.0f, edge = edge_length(tree, node[0], node[1]);
    for (int64_t i = 1; parent >= 0 && i < pieces; i++) {
        float at = length * (float)i / (float)pieces;
        while (k < count - 1 && before + edge < at) {
            before += edge;
            edge = edge_length(tree, node[k], node[k + 1]);
            k++;
        }
        float t = edge > 0.0f ? clampf((at - before) / edge, 0.0f, 1.0f) : 1.0f;
        uint64_t id = random_key(tree->id[last], (uint64_t)i);
        parent = add_between(r, node[k - 1], node[k], t, parent, id, e);
    }
    r->place[last] =
        parent < 0 ? -1 : (int32_t)add_between(r, last, last, 1.0f, parent, tree->id[last], e);
    return r->place[last] >= 0;
}

static bool resample_chain(Resampler *r, const int32_t *node, int64_t count, bool from_root,
                           Error *e)
{
    if (from_root) {
        int32_t root = node[0];
        int64_t at = add_between(r, root, root, 1.0f, -1, r->tree->id[root], e);
        if (at < 0) {
            return false;
        }
        r->place[root] = (int32_t)at;
    }
    for (int64_t start = 0, end = 1; end < count; end++) {
        if (stays(r, node[end])) {
            if (!resample_piece(r, node + start, end - start + 1, e)) {
                return false;
            }
            start = end;
        }
    }
    return true;
}

OutTree *out_tree_resample(const OutTree *tree, float segment, Error *e)
{
    if (!(segment > 0.0f)) {
        error_set(e, ERROR_INPUT, "segments of %g m; they must be longer than 0", (double)segment);
        return NULL;
    }
    Resampler r = {.tree = tree, .segment = segment, .out = out_tree_new(e)};
    ChainSet *chains = out_tree_chains(tree, e);
    r.children = out_tree_count_children(tree, e);
    r.place = memory_alloc(tree->count, sizeof *r.place, e);
    bool done = r.out && chains && r.children && r.place;
    for (int64_t c = 0; done && c < chains->count; c++) {
        done = resample_chain(&r, chains->node + chains->first[c],
                              chains->first[c + 1] - chains->first[c], chains->parent[c] < 0, e);
    }
    chains_free(chains);
    free(r.children);
    free(r.place);
    if (!done) {
        out_tree_free(r.out);
        return NULL;
    }
    return r.out;
}
