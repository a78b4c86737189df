// The out-tree of ridges: grown from its start points, read from a file or traced from a picture;
// and the land that it lifts.
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/internal.h"

#include <stdlib.h>

static bool add_starts(OutTree *tree, const TerrainParams *params, uint64_t seed, Error *e)
{
    const RidgeParams *ridges = &params->ridges;
    const RidgeStart middle = {{0.0f, 0.0f}};
    int count = ridges->start_count > 0 ? ridges->start_count : 1;
    for (int i = 0; i < count; i++) {
        const RidgeStart *start = ridges->start_count > 0 ? &ridges->starts[i] : &middle;
        Vec3 p = {start->at[0] * params->size, 0.0f, start->at[1] * params->size};
        if (out_tree_add_node(tree, p, -1, 0, i, random_key(seed, (uint64_t)i), e) < 0) {
            return false;
        }
    }
    return true;
}

bool terrain_grow_ridges(OutTree **tree, const TerrainParams *params, const Recipe *recipe,
                         Error *e)
{
    const RidgeParams *ridges = &params->ridges;
    if (tree_source_given(&ridges->source)) {
        *tree = terrain_read_tree(params, &ridges->source, TREE_RISES, recipe, e);
        return *tree || error_key(e, ridges->source.file ? "ridges.file" : "ridges.image");
    }
    *tree = out_tree_new(e);
    PlaneGrowth growth = {
        .size = params->size,
        .ellipse = true,
        .extent = {ridges->extent[0] * params->size, ridges->extent[1] * params->size},
        .count = ridges->count,
        .winding = ridges->winding,
        .fields = ridges->fields,
        .field_count = ridges->field_count,
        .field_weight = ridges->field_weight};
    return *tree && add_starts(*tree, params, random_key(recipe->seed, STREAM_OUTLETS), e) &&
           terrain_grow_plane(tree, &growth, recipe, e);
}

// ---- shares: the height and the half width of each node's band, of those of the widest

// From every fork a ridge falls evenly to its farthest tip. Radii are set to the shares.
static bool fall_to_tips(OutTree *tree, float tip, Error *e)
{
    float *ahead = memory_alloc_zero(tree->count, sizeof *ahead, e); // m to the farthest tip
    for (int64_t i = ahead ? tree->count - 1 : -1; i >= 0; i--) {
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            float far = ahead[i] + vec3_distance(tree->position[i], tree->position[parent]);
            ahead[parent] = far > ahead[parent] ? far : ahead[parent];
        }
    }
    for (int64_t i = 0; ahead && i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        tree->radius[i] = 1.0f;
        if (parent >= 0) {
            float step = vec3_distance(tree->position[i], tree->position[parent]);
            float whole = ahead[i] + step;
            float left = whole > 0.0f ? ahead[i] / whole : 1.0f;
            tree->radius[i] = tip + (tree->radius[parent] - tip) * left;
        }
    }
    bool done = ahead;
    free(ahead);
    return done;
}

static float largest_radius(const OutTree *tree)
{
    float largest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        largest = tree->radius[i] > largest ? tree->radius[i] : largest;
    }
    return largest;
}

float terrain_lift_width(const TerrainParams *params)
{
    return params->form == TERRAIN_MAP ? 0.15f : params->ridges.width;
}

float terrain_lift_relief(const TerrainParams *params)
{
    const float natural = 0.65f; // tan(33 degrees): slopes of loose rock
    return params->relief > 0.0f ? params->relief
                                 : natural * terrain_lift_width(params) * params->size;
}

bool terrain_raise_ridges(Terrain *terrain, const Run *run, Error *e)
{
    (void)run;
    const TerrainParams *params = terrain->params;
    OutTree *tree = terrain->tree;
    float largest = largest_radius(tree);
    if (!(largest > 0.0f)) { // grown, or of a file without radii
        if (!fall_to_tips(tree, params->ridges.tip, e)) {
            return false;
        }
        largest = 1.0f;
    }
    LiftCurve curve = terrain_lift_curve(params);
    float crest = lift_curve_at(&curve, 0.0f) * terrain_lift_relief(params);
    for (int64_t i = 0; i < tree->count; i++) {
        float share = tree->radius[i] / largest;
        tree->radius[i] = share * params->ridges.width * params->size;
        tree->position[i].y = share * crest * terrain_lift_sign(params);
    }
    return true;
}

// ---- the lift

// Convex flanks fall from a sharp crest and end level with the plain, as those of worn mountains.
static const LiftStop OWN_STOPS[] = {{0.0f, 1.0f},  {0.15f, 0.76f}, {0.35f, 0.48f},
                                     {0.6f, 0.21f}, {0.8f, 0.07f},  {1.0f, 0.0f}};

const LiftStop *terrain_lift_stops(const TerrainParams *params, int *count)
{
    bool own = params->ridges.lift_count == 0;
    *count = own ? (int)(sizeof OWN_STOPS / sizeof OWN_STOPS[0]) : params->ridges.lift_count;
    return own ? OWN_STOPS : params->ridges.lift;
}

float terrain_lift_sign(const TerrainParams *params)
{
    int count;
    const LiftStop *stop = terrain_lift_stops(params, &count);
    for (int i = 0; i < count && params->form == TERRAIN_RIDGES; i++) {
        if (stop[i].height < 0.0f) {
            return -1.0f;
        }
    }
    return 1.0f;
}

LiftCurve terrain_lift_curve(const TerrainParams *params)
{
    LiftStop stops[LIFT_MOST_STOPS];
    int count;
    const LiftStop *stop = terrain_lift_stops(params, &count);
    for (int i = 0; i < count; i++) {
        stops[i] = (LiftStop){stop[i].distance, fabsf(stop[i].height)};
    }
    return lift_curve(stops, count);
}

static RidgeBand band_of(const OutTree *tree, int64_t i, float half)
{
    int64_t below = tree->parent[i] >= 0 ? tree->parent[i] : i;
    Vec3 a = tree->position[below], b = tree->position[i];
    float dx = b.x - a.x, dz = b.z - a.z, length = sqrtf(dx * dx + dz * dz);
    return (RidgeBand){.x = a.x,
                       .z = a.z,
                       .dx = length > 0.0f ? dx / length : 1.0f,
                       .dz = length > 0.0f ? dz / length : 0.0f,
                       .length = length,
                       .share0 = tree->radius[below] / half,
                       .share1 = tree->radius[i] / half};
}

RidgeLift *terrain_ridge_lift(const Terrain *terrain, float margin, const Run *run, Error *e)
{
    const TerrainParams *params = terrain->params;
    const OutTree *tree = terrain->tree;
    float half = params->ridges.width * params->size;
    RidgeBand *band = memory_alloc(tree->count, sizeof *band, e);
    int64_t count = 0;
    for (int64_t i = 0; band && i < tree->count; i++) {
        RidgeBand own = band_of(tree, i, half);
        band[count] = own;
        count += own.share0 > 0.0f || own.share1 > 0.0f;
    }
    LiftCurve curve = terrain_lift_curve(params);
    RidgeLift *lift =
        band ? ridge_lift_new(band, count, &curve, half, params->size, margin, run, e) : NULL;
    free(band);
    return lift;
}

// The lift at a place, 0..1.
static float lift_at(const Terrain *terrain, float x, float z)
{
    return terrain->map ? clampf(height_field_smooth_at(terrain->map, x, z), 0.0f, 1.0f)
                        : ridge_lift_at(terrain->lift, x, z);
}

float terrain_lifted_at(const Terrain *terrain, float x, float z)
{
    const TerrainParams *params = terrain->params;
    float relief = terrain_lift_relief(params), sign = terrain_lift_sign(params);
    if (params->noise.iterations == 0) {
        return sign * relief * lift_at(terrain, x, z);
    }
    float at_x = x, at_z = z;
    terrain_warp(terrain, 1.0f, &at_x, &at_z);
    float lift = lift_at(terrain, at_x, at_z);
    float up = relief / (terrain_lift_width(params) * params->size);
    float noise = terrain_noise_at(terrain, x, z) * (up < 1.5f ? up : 1.5f);
    return sign * relief * lift + noise * smoothstepf(0.0f, 0.4f, lift);
}
