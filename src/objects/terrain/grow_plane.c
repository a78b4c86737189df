// Growth of an out-tree on the terrain's plane: space colonization from its roots, main branches
// first, then their brooks or spurs. Main rivers meander at every scale and run inland side by
// side, so that large basins are more elongated than small ones and river lengths follow Hack's law
// (length ~ area^0.57).
#include "base/memory.h"
#include "base/random.h"
#include "grow/colonize.h"
#include "objects/terrain/internal.h"
#include "outtree/chains.h"
#include "outtree/jitter.h"

#include <stdlib.h>

enum { STREAM_X = 1, STREAM_Z = 2 }; // of an attractor

static bool is_grown_over(const PlaneGrowth *growth, float x, float z)
{
    if (!growth->ellipse) {
        return true;
    }
    float u = 2.0f * x / growth->extent[0], v = 2.0f * z / growth->extent[1];
    return u * u + v * v <= 1.0f;
}

// Points in a jittered grid: one per square, so that branches reach all land. `count` of them would
// cover the whole square.
static PointSet *scatter_plane(const PlaneGrowth *growth, int64_t count, uint64_t seed, Error *e)
{
    float size = growth->size;
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
        if (is_grown_over(growth, x, z) &&
            !points_add(points, vec3(x, 0.0f, z), vec3(0, 1, 0), id, e)) {
            points_free(points);
            return NULL;
        }
    }
    points->measure = (double)size * (double)size * ((double)points->count / (double)(side * side));
    points->dimension = 2;
    return points;
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

static bool grow_level(OutTree *tree, const PlaneGrowth *growth, const GrowLevel *level,
                       ColonizeParams *colonizing, uint64_t seed, const Run *run, Error *e)
{
    PointSet *points = scatter_plane(growth, level->attractors, seed, e);
    if (!points || points->count == 0) {
        points_free(points);
        return points;
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

// Clamps branches to the plane and to the land.
static void project_on_land(const void *surface, Vec3 *p, Vec3 *normal)
{
    float half = 0.499f * ((const PlaneGrowth *)surface)->size;
    *p = vec3(clampf(p->x, -half, half), 0.0f, clampf(p->z, -half, half));
    *normal = vec3(0, 1, 0);
}

// Jitters the branches at all scales; roots and tips stay in place. *tree is replaced.
static bool wind_branches(OutTree **tree, const PlaneGrowth *growth, float spacing, uint64_t seed,
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
    jitter.amplitude = 1.4f * growth->winding * spacing;
    jitter.reference = spacing;
    jitter.seed = seed;
    jitter.project = project_on_land;
    jitter.surface = growth;
    jitter.stride = growth->size; // on a plane one stride is enough
    return out_tree_jitter(fine, &jitter, run, e);
}

static bool grow_levels(OutTree **tree, const PlaneGrowth *growth, const GuideField *field,
                        uint64_t seed, const Run *run, Error *e)
{
    ColonizeParams colonizing = colonize_params_default();
    colonizing.on_surface = true;
    colonizing.max_children = 2;
    colonizing.field = field;
    colonizing.field_weight = growth->field_weight;
    colonizing.seed = random_key(seed, STREAM_RIVER_GROWTH);
    // Lengths in spacings of the level's own attractors. The fine level is relaxed, so that they
    // are straight on the scale of hillslopes.
    int64_t count = growth->count > 12 ? growth->count : 12;
    float winding = growth->winding;
    const GrowLevel main = {.attractors = count / 8,
                            .step = 0.40f,
                            .kill = 0.9f,
                            .influence = 2.2f,
                            .noise = 1.5f * winding};
    const GrowLevel fine = {.attractors = count,
                            .step = 0.45f,
                            .kill = 1.0f,
                            .influence = 2.2f,
                            .noise = winding,
                            .relax = 0.5f};
    if (main.attractors > 12) {
        float spacing = growth->size / sqrtf((float)main.attractors);
        if (!grow_level(*tree, growth, &main, &colonizing, random_key(seed, STREAM_RIVER_POINTS),
                        run, e) ||
            !wind_branches(tree, growth, spacing, random_key(seed, STREAM_WINDINGS), run, e)) {
            return false;
        }
    }
    return grow_level(*tree, growth, &fine, &colonizing, random_key(seed, STREAM_BROOK_POINTS), run,
                      e);
}

// The guide field with the roots as nuclei.
static GuideField *plane_field(const OutTree *tree, const PlaneGrowth *growth, uint64_t seed,
                               const Run *run, Error *e)
{
    FieldParams *fields = memory_alloc(growth->field_count, sizeof *fields, e);
    if (!fields) {
        return NULL;
    }
    for (int i = 0; i < growth->field_count; i++) {
        fields[i] = growth->fields[i];
        fields[i].seed = random_key(seed, (uint64_t)i);
        fields[i].pull = field_params_pull(&fields[i], growth->field_weight);
    }
    float half = 0.5f * growth->size;
    Aabb box = {vec3(-half, 0.0f, -half), vec3(half, 0.0f, half)};
    FieldSite site = {tree->position, tree->normal, tree->count, box, NULL};
    GuideField *field = guide_field_new(fields, growth->field_count, &site, run, e);
    free(fields);
    return field;
}

bool terrain_grow_plane(OutTree **tree, const PlaneGrowth *growth, const Recipe *recipe, Error *e)
{
    GuideField *field = NULL;
    if (growth->field_count > 0) {
        field = plane_field(*tree, growth, random_key(recipe->seed, STREAM_FIELD), recipe->run, e);
        if (!field) {
            return false;
        }
    }
    bool done = grow_levels(tree, growth, field, recipe->seed, recipe->run, e);
    guide_field_free(field);
    return done;
}
