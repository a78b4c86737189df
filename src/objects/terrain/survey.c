// Surveyed land: the heights of a raster, the rivers that drain them, and detail finer than its
// cells.
#include "land/survey.h"

#include "base/memory.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <stdlib.h>

static bool covers(const HeightField *raster, const SurveyParams *survey, float size, Error *e)
{
    float half[2] = {-raster->origin.x, -raster->origin.y};
    for (int i = 0; i < 2; i++) {
        if (fabsf(survey->center[i]) + 0.5f * size > half[i] * 1.0001f) {
            error_set(e, ERROR_INPUT,
                      "'%s' covers %.9g x %.9g m; a square of %.9g m about [%.9g, %.9g] is not all "
                      "within it",
                      survey->file, (double)(2.0f * half[0]), (double)(2.0f * half[1]),
                      (double)size, (double)survey->center[0], (double)survey->center[1]);
            return error_key(e, "size");
        }
    }
    return true;
}

// The square on cells as fine as the raster's finer side.
static HeightField *cut_out(const HeightField *raster, const TerrainParams *params, Error *e)
{
    const SurveyParams *survey = &params->survey;
    float finest = raster->cell.x < raster->cell.y ? raster->cell.x : raster->cell.y;
    int cells = (int)ceilf(params->size / finest);
    cells = cells < 2 ? 2 : (cells < HEIGHT_FIELD_MAX ? cells : HEIGHT_FIELD_MAX - 1);
    float cell = params->size / (float)cells, corner = -0.5f * params->size;
    HeightField *square =
        height_field_new(cells + 1, cells + 1, (Vec2){cell, cell}, (Vec2){corner, corner}, e);
    if (square && !height_field_take_place(square, raster, (double)survey->center[0],
                                           (double)survey->center[1], e)) {
        height_field_free(square);
        return NULL;
    }
    for (int64_t i = 0; square && i < height_field_count(square); i++) {
        int64_t column = i % (cells + 1), row = i / (cells + 1);
        float x = corner + cell * (float)column + survey->center[0];
        float z = corner + cell * (float)row + survey->center[1];
        square->height[i] = survey->exaggeration * height_field_smooth_at(raster, x, z);
    }
    return square;
}

HeightField *terrain_read_survey(const TerrainParams *params, const Run *run, Error *e)
{
    HeightField *raster = survey_read(params->survey.file, params->survey.band, run, e);
    if (!raster) {
        error_key(e, "survey.file");
        return NULL;
    }
    HeightField *square =
        covers(raster, &params->survey, params->size, e) ? cut_out(raster, params, e) : NULL;
    height_field_free(raster);
    if (square) {
        float low, high;
        height_field_range(square, &low, &high);
        for (int64_t i = 0; i < height_field_count(square); i++) {
            square->height[i] -= low;
        }
    }
    return square;
}

// ---- rivers ----

// The place of a river's sample: a third of the way toward the mean of its upper and its lower
// neighbour, so that courses do not run in steps of 45 degrees.
static void round_courses(OutTree *tree, const int64_t *upper)
{
    enum { ROUNDS = 4 };
    for (int round = 0; round < ROUNDS; round++) {
        for (int64_t i = tree->count - 1; i >= 0; i--) {
            int32_t lower = tree->parent[i];
            if (lower < 0 || upper[i] < 0) {
                continue;
            }
            Vec3 middle = vec3_lerp(tree->position[lower], tree->position[upper[i]], 0.5f);
            Vec3 p = vec3_lerp(tree->position[i], middle, 0.33f);
            tree->position[i].x = p.x;
            tree->position[i].z = p.z;
        }
    }
}

// The samples that drain at least `least` m^2, as a tree with its roots on the rim. Radii: the
// roots of these areas.
static bool gather_rivers(OutTree *tree, const HeightField *field, const Drainage *drainage,
                          double least, uint64_t seed, Error *e)
{
    int64_t *node = memory_alloc(drainage->samples, sizeof *node, e); // of samples; -1 = no river
    int64_t *upper = memory_alloc(drainage->count, sizeof *upper, e); // of nodes: the largest
    bool done = node && upper;
    for (int64_t k = 0; done && k < drainage->count; k++) {
        int32_t i = drainage->order[k], to = drainage->receiver[i];
        node[i] = -1;
        if (drainage->area[i] < least || (to != i && node[to] < 0)) {
            continue;
        }
        int64_t parent = to == i ? -1 : node[to];
        int column = i % field->columns, row = i / field->columns;
        Vec3 p = vec3(field->origin.x + field->cell.x * (float)column, drainage->filled[i],
                      field->origin.y + field->cell.y * (float)row);
        int32_t birth = parent < 0 ? 0 : tree->birth[parent] + 1;
        node[i] = out_tree_add_node(tree, p, parent, birth, 0, random_key(seed, (uint64_t)i), e);
        done = node[i] >= 0;
        if (done) {
            tree->radius[node[i]] = sqrtf((float)drainage->area[i]);
            upper[node[i]] = -1;
            if (parent >= 0 &&
                (upper[parent] < 0 || tree->radius[upper[parent]] < tree->radius[node[i]])) {
                upper[parent] = node[i];
            }
        }
    }
    if (done) {
        round_courses(tree, upper);
    }
    free(node);
    free(upper);
    return done;
}

bool terrain_find_rivers(OutTree **tree, const TerrainParams *params, const Recipe *recipe,
                         Error *e)
{
    *tree = out_tree_new(e);
    if (!*tree || params->rivers.water <= 0.0f) {
        return *tree;
    }
    HeightField *square = terrain_read_survey(params, recipe->run, e);
    bool done = square && height_field_fill(square, 1e-5f, e);
    Drainage *drainage = done ? drainage_new(square, e) : NULL;
    double least = (double)params->size * (double)params->size / (double)params->rivers.count;
    done = drainage && gather_rivers(*tree, square, drainage, least, recipe->seed, e);
    drainage_free(drainage);
    height_field_free(square);
    return done;
}

bool terrain_finish_survey(Terrain *terrain, const Run *run, Error *e)
{
    (void)run;
    OutTree *tree = terrain->tree;
    terrain->area = memory_alloc(tree->count, sizeof *terrain->area, e);
    terrain->uplift = memory_alloc(tree->count, sizeof *terrain->uplift, e);
    if (!terrain->area || !terrain->uplift) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        terrain->area[i] = tree->radius[i] * tree->radius[i];
        terrain->uplift[i] = 1.0f;
        tree->radius[i] *= terrain->params->rivers.water;
    }
    return true;
}

// ---- heights ----

float terrain_surveyed_at(const Terrain *terrain, float x, float z)
{
    const TerrainNoiseParams *noise = &terrain->params->noise;
    const HeightField *map = terrain->map;
    float height = height_field_smooth_at(map, x, z), cell = map->cell.x;
    if (noise->iterations == 0) {
        return height;
    }
    float dx = height_field_smooth_at(map, x + cell, z) - height_field_smooth_at(map, x - cell, z);
    float dz = height_field_smooth_at(map, x, z + cell) - height_field_smooth_at(map, x, z - cell);
    float slope = 0.5f * sqrtf(dx * dx + dz * dz) / cell;
    float wavelength =
        noise->wavelength > 0.0f ? noise->wavelength * terrain->params->size : 2.0f * cell;
    float n = sparse_noise_fractal(x / wavelength, z / wavelength, noise->iterations, noise->gain,
                                   noise->ridged, random_key(terrain->seed, STREAM_NOISE));
    return height + n * noise->amplitude * wavelength * (slope < 1.5f ? slope : 1.5f);
}
