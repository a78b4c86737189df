// Rivers as an out-tree on a plane: space colonization from outlets on the border, the main rivers
// first, then their brooks. Main rivers meander at every scale and run inland side by side, so that
// large basins are more elongated than small ones and river lengths follow Hack's law (length ~
// area^0.57).
#include "base/random.h"
#include "grow/colonize.h"
#include "objects/terrain/internal.h"
#include "outtree/chains.h"
#include "outtree/jitter.h"

#include "base/memory.h"

#include <stdlib.h>

enum { STREAM_X = 1, STREAM_Z = 2 }; // of an attractor
enum { STREAM_JITTER = 1 };          // of an outlet

// Points in a jittered grid: one per square, so that rivers reach all land.
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
        float x = ((float)(i % side) + random_unit(random_key(id, STREAM_X))) * cell - 0.5f * size;
        int64_t row = i / side;
        float z = ((float)row + random_unit(random_key(id, STREAM_Z))) * cell - 0.5f * size;
        if (!points_add(points, vec3(x, 0.0f, z), vec3(0, 1, 0), id, e)) {
            points_free(points);
            return NULL;
        }
    }
    points->measure = (double)size * (double)size;
    points->dimension = 2;
    return points;
}

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

// Clamps rivers to the plane and to the land.
static void project_on_land(const void *surface, Vec3 *p, Vec3 *normal)
{
    float half = 0.499f * ((const TerrainParams *)surface)->size;
    *p = vec3(clampf(p->x, -half, half), 0.0f, clampf(p->z, -half, half));
    *normal = vec3(0, 1, 0);
}

// Jitters the rivers at all scales; outlets and sources stay in place. *tree is replaced.
static bool wind_rivers(OutTree **tree, const TerrainParams *params, float spacing, uint64_t seed,
                        const Run *run, Error *e)
{
    OutTree *fine = out_tree_resample(*tree, 0.2f * spacing, e);
    if (!fine) {
        return false;
    }
    out_tree_free(*tree);
    *tree = fine;
    JitterParams jitter = jitter_params_default();
    jitter.hurst = 0.65f;
    jitter.amplitude = 1.4f * params->rivers.winding * spacing;
    jitter.reference = spacing;
    jitter.seed = seed;
    jitter.project = project_on_land;
    jitter.surface = params;
    jitter.stride = params->size; // on a plane one stride is enough
    return out_tree_jitter(fine, &jitter, run, e);
}

static bool grow_levels(OutTree **tree, const TerrainParams *params, const GuideField *field,
                        uint64_t seed, const Run *run, Error *e)
{
    ColonizeParams colonizing = colonize_params_default();
    colonizing.on_surface = true;
    colonizing.max_children = 2;
    colonizing.field = field;
    colonizing.field_weight = params->rivers.field_weight;
    colonizing.seed = random_key(seed, STREAM_RIVER_GROWTH);
    // Lengths in spacings of the level's own attractors. Brooks are relaxed, so that they are
    // straight on the scale of hillslopes.
    int64_t count = params->rivers.count > 12 ? params->rivers.count : 12;
    float winding = params->rivers.winding;
    const GrowLevel rivers = {.attractors = count / 8,
                              .step = 0.40f,
                              .kill = 0.9f,
                              .influence = 2.2f,
                              .noise = 1.5f * winding};
    const GrowLevel brooks = {.attractors = count,
                              .step = 0.45f,
                              .kill = 1.0f,
                              .influence = 2.2f,
                              .noise = winding,
                              .relax = 0.5f};
    if (rivers.attractors > 12) {
        float spacing = params->size / sqrtf((float)rivers.attractors);
        if (!grow_level(*tree, params, &rivers, &colonizing, random_key(seed, STREAM_RIVER_POINTS),
                        run, e) ||
            !wind_rivers(tree, params, spacing, random_key(seed, STREAM_WINDINGS), run, e)) {
            return false;
        }
    }
    return grow_level(*tree, params, &brooks, &colonizing, random_key(seed, STREAM_BROOK_POINTS),
                      run, e);
}

// The guide field with the outlets as nuclei.
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
        fields[i].pull = field_params_pull(&fields[i], rivers->field_weight);
    }
    float half = 0.5f * params->size;
    Aabb box = {vec3(-half, 0.0f, -half), vec3(half, 0.0f, half)};
    FieldSite site = {tree->position, tree->normal, tree->count, box, NULL};
    GuideField *field = guide_field_new(fields, rivers->field_count, &site, run, e);
    free(fields);
    return field;
}

bool terrain_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const TerrainParams *params = given;
    whole->tree = out_tree_new(e);
    if (!whole->tree ||
        !add_outlets(whole->tree, params, random_key(recipe->seed, STREAM_OUTLETS), e)) {
        return false;
    }
    GuideField *field = NULL;
    if (params->rivers.field_count > 0) {
        field = river_field(whole->tree, params, random_key(recipe->seed, STREAM_FIELD),
                            recipe->run, e);
        if (!field) {
            return false;
        }
    }
    bool done = grow_levels(&whole->tree, params, field, recipe->seed, recipe->run, e);
    guide_field_free(field);
    return done;
}
