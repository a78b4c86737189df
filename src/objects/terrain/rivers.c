// The out-tree of rivers: grown inland from outlets on the border, read from a file or traced from
// a picture.
#include "base/random.h"
#include "objects/terrain/internal.h"

enum { STREAM_JITTER = 1 }; // of an outlet

// Places outlets evenly along their sides, each moved at random within its interval.
static bool add_outlets(OutTree *tree, const TerrainParams *params, uint64_t seed, Error *e)
{
    const RiverParams *rivers = &params->rivers;
    float half = 0.5f * params->size, sides = rivers->side == SIDE_ALL ? 4.0f : 1.0f;
    float first = rivers->side == SIDE_ALL ? 0.0f : (float)(rivers->side - SIDE_NORTH);
    for (int i = 0; i < rivers->outlets; i++) {
        uint64_t id = random_key(seed, (uint64_t)i);
        float jitter = random_range(random_key(id, STREAM_JITTER), 0.2f, 0.8f);
        float place = first + sides * ((float)i + jitter) / (float)rivers->outlets;
        int side = (int)place & 3;
        float along = params->size * (place - (float)(int)place) - half;
        Vec3 at = side == 0   ? vec3(along, 0.0f, -half)
                  : side == 1 ? vec3(half, 0.0f, along)
                  : side == 2 ? vec3(-along, 0.0f, half)
                              : vec3(-half, 0.0f, -along);
        if (out_tree_add_node(tree, at, -1, 0, i, id, e) < 0) {
            return false;
        }
    }
    return true;
}

bool terrain_grow_rivers(OutTree **tree, const TerrainParams *params, const Recipe *recipe,
                         Error *e)
{
    const RiverParams *rivers = &params->rivers;
    if (tree_source_given(&rivers->source)) {
        *tree = terrain_read_tree(params, &rivers->source, TREE_DRAINS, recipe, e);
        return *tree || error_key(e, rivers->source.file ? "rivers.file" : "rivers.image");
    }
    *tree = out_tree_new(e);
    PlaneGrowth growth = {.size = params->size,
                          .count = rivers->count,
                          .winding = rivers->winding,
                          .fields = rivers->fields,
                          .field_count = rivers->field_count,
                          .field_weight = rivers->field_weight};
    return *tree && add_outlets(*tree, params, random_key(recipe->seed, STREAM_OUTLETS), e) &&
           terrain_grow_plane(tree, &growth, recipe, e);
}
