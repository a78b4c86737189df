// Rivers as an out-tree on a plane: space colonization from outlets on the border, in levels.
#include "base/random.h"
#include "grow/colonize.h"
#include "model/terrain_internal.h"

#include "base/memory.h"

#include <stdlib.h>

// Points in a jittered grid: every square has one, so no land stays without a river.
static PointSet *scatter_plane(float size, int64_t count, uint64_t seed, Error *e)
{
    PointSet *points = points_new(e);
    if (!points) {
        return NULL;
    }
    int64_t side = 1;
    while ((side + 1) * (side + 1) <= count) {
        side++;
    }
    float cell = size / (float)side;
    for (int64_t i = 0; i < side * side; i++) {
        uint64_t id = random_key(seed, (uint64_t)i);
        float x = ((float)(i % side) + random_unit(random_key(id, 1))) * cell - 0.5f * size;
        int64_t row = i / side;
        float z = ((float)row + random_unit(random_key(id, 2))) * cell - 0.5f * size;
        if (!points_add(points, vec3(x, 0.0f, z), vec3(0, 1, 0), id, e)) {
            points_free(points);
            return NULL;
        }
    }
    points->measure = (double)size * (double)size;
    points->dimension = 2;
    return points;
}

// Outlets stand evenly along their sides, each moved by a random share of its room.
static bool add_outlets(OutTree *tree, const TerrainParams *params, uint64_t seed, Error *e)
{
    const RiverParams *rivers = &params->rivers;
    float half = 0.5f * params->size, sides = rivers->side == SIDE_ALL ? 4.0f : 1.0f;
    float first = rivers->side == SIDE_ALL ? 0.0f : (float)(rivers->side - SIDE_NORTH);
    for (int i = 0; i < rivers->outlets; i++) {
        uint64_t id = random_key(seed, (uint64_t)i);
        float jitter = random_range(random_key(id, 1), 0.2f, 0.8f);
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

static void relax(OutTree *tree, int64_t first, float share)
{
    for (int64_t i = tree->count - 1; i >= first; i--) {
        if (tree->parent[i] >= 0) {
            tree->position[i] =
                vec3_lerp(tree->position[i], tree->position[tree->parent[i]], share);
        }
    }
}

static bool grow_level(OutTree *tree, const TerrainParams *params, const GrowLevel *level,
                       ColonizeParams *colonizing, uint64_t seed, const Run *run, Error *e)
{
    PointSet *points = scatter_plane(params->size, level->attractors, seed, e);
    if (!points) {
        return false;
    }
    ColonizeParams mine = *colonizing;
    mine.noise = level->noise;
    colonize_auto(&mine, points_spacing(points), level->step, level->kill, level->influence);
    int64_t before = tree->count;
    GrowReport report;
    bool done = colonize(tree, points, &mine, run, &report, e);
    if (done) {
        colonizing->first_step += (int32_t)report.steps;
        relax(tree, before, level->relax);
    }
    points_free(points);
    return done;
}

static bool grow_levels(OutTree *tree, const TerrainParams *params, const GuideField *field,
                        uint64_t seed, const Run *run, Error *e)
{
    // Lengths in spacings of the level's own attractors.
    const GrowLevel shape[4] = {{.step = 0.15f, .kill = 0.5f, .influence = 4.0f},
                                {.step = 0.30f, .kill = 0.8f, .influence = 2.5f},
                                {.step = 0.40f, .kill = 0.9f, .influence = 2.2f},
                                {.step = 0.45f, .kill = 1.0f, .influence = 2.2f}};
    ColonizeParams colonizing = colonize_params_default();
    colonizing.on_surface = true;
    colonizing.max_children = 2;
    colonizing.field = field;
    colonizing.field_weight = params->rivers.field_weight;
    colonizing.seed = random_key(seed, 2);
    int64_t most = params->rivers.count;
    const int64_t counts[4] = {most / 500, most / 60, most / 8, most};
    for (int i = 0; i < 4; i++) {
        GrowLevel level = shape[i];
        level.attractors = counts[i] > 12 ? counts[i] : 12;
        level.noise = params->rivers.winding;
        level.relax = 0.5f;
        if ((i == 3 || counts[i] > 12) && !grow_level(tree, params, &level, &colonizing,
                                                      random_key(seed, 10 + (uint64_t)i), run, e)) {
            return false;
        }
    }
    return true;
}

// The guide field about the outlets.
static GuideField *river_field(const OutTree *tree, const TerrainParams *params, uint64_t seed,
                               const Run *run, Error *e)
{
    const RiverParams *rivers = &params->rivers;
    FieldParams *fields = memory_alloc(rivers->field_count, sizeof *fields, e);
    if (!fields) {
        return NULL;
    }
    for (int i = 0; i < rivers->field_count; i++) {
        fields[i] = rivers->fields[i];
        fields[i].seed = random_key(seed, (uint64_t)i);
    }
    float half = 0.5f * params->size;
    Aabb box = {vec3(-half, 0.0f, -half), vec3(half, 0.0f, half)};
    GuideField *field = guide_field_new(fields, rivers->field_count, tree->position, tree->normal,
                                        tree->count, box, run, e);
    free(fields);
    return field;
}

OutTree *terrain_rivers(const TerrainParams *params, const Recipe *recipe, Error *e)
{
    OutTree *tree = out_tree_new(e);
    GuideField *field = NULL;
    bool done = tree && add_outlets(tree, params, random_key(recipe->seed, 1), e);
    if (done && params->rivers.field_count > 0) {
        field = river_field(tree, params, random_key(recipe->seed, 4), recipe->run, e);
        done = field;
    }
    done = done && grow_levels(tree, params, field, recipe->seed, recipe->run, e) &&
           out_tree_keep_births(tree, recipe->grow_to, e);
    guide_field_free(field);
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}
