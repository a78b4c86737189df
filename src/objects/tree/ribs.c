#include "objects/tree/ribs.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>

// The dome of an end: along the axis and across it, in radii.
enum { DOME_NODES = 6 };
static const float DOME_ALONG[DOME_NODES] = {0.25f, 0.5f, 0.7f, 0.85f, 0.94f, 0.985f};
static const float DOME_ACROSS[DOME_NODES] = {0.97f, 0.87f, 0.71f, 0.53f, 0.34f, 0.17f};

static bool add_dome(OutTree *tree, int64_t end, Error *e)
{
    Vec3 from = tree->position[end];
    Vec3 along = vec3_normalize(vec3_sub(from, tree->position[tree->parent[end]]));
    float radius = tree->radius[end];
    int64_t parent = end;
    for (int i = 0; i < DOME_NODES; i++) {
        int64_t made = out_tree_add_node(tree, vec3_madd(from, DOME_ALONG[i] * radius, along),
                                         parent, tree->birth[parent], tree->colony[parent],
                                         out_tree_child_id(tree->id[parent], 0), e);
        if (made < 0) {
            return false;
        }
        tree->radius[made] = DOME_ACROSS[i] * radius;
        parent = made;
    }
    return true;
}

bool tree_round_ends(OutTree *tree, const TreeParams *params, Error *e)
{
    int64_t count = tree->count;
    if (params->trunk.ribs <= 0) {
        return true;
    }
    bool *goes_on = memory_alloc_zero(count, sizeof *goes_on, e);
    for (int64_t i = 0; goes_on && i < count; i++) {
        if (tree->parent[i] >= 0) {
            goes_on[tree->parent[i]] = true;
        }
    }
    bool done = goes_on;
    for (int64_t i = 0; done && i < count; i++) {
        bool bare = goes_on[i] || tree->parent[i] < 0 || tree->colony[i] == TREE_ROOTS;
        done = bare || add_dome(tree, i, e);
    }
    free(goes_on);
    return done;
}

// Depth of the groove, 0..1, at an angle (radians) about the branch: ribs are round, grooves sharp.
static float groove(float angle, int ribs)
{
    float sine, cosine;
    exact_sincos(0.5f * angle * (float)ribs, &sine, &cosine);
    return 1.0f - fabsf(cosine);
}

bool tree_ribs(Mesh *skin, const TreeParams *params, Error *e)
{
    const TrunkParams *trunk = &params->trunk;
    if (trunk->ribs <= 0 || trunk->rib_depth <= 0.0f) {
        return true;
    }
    for (int64_t i = 0; i < skin->vertex_count; i++) {
        float radius = skin->radius[i];
        float deep = radius > 0.0f ? groove(skin->uv[i].x / radius, trunk->ribs) : 0.0f;
        skin->position[i] =
            vec3_madd(skin->position[i], -deep * trunk->rib_depth * radius, skin->normal[i]);
    }
    return mesh_compute_normals(skin, e);
}
