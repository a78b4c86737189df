// Rivers on the finished land: courses and beds. Noise, erosion and terraces change the land
// after the rivers' heights are computed, so water levels are fitted to the final land and always
// fall downstream.
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "objects/terrain/form.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- the water as an out-tree

// The child with the largest drainage area; -1 = none.
static int32_t *heaviest_children(const Terrain *terrain, Error *e)
{
    const OutTree *rivers = terrain->tree;
    int32_t *heaviest = memory_alloc(rivers->count, sizeof *heaviest, e);
    for (int64_t i = 0; heaviest && i < rivers->count; i++) {
        int32_t parent = rivers->parent[i];
        heaviest[i] = -1;
        if (parent >= 0 &&
            (heaviest[parent] < 0 || terrain->area[i] > terrain->area[heaviest[parent]])) {
            heaviest[parent] = (int32_t)i;
        }
    }
    return heaviest;
}

// Adds the piece of river from its lower end (a node of `water`) up to river node i, in steps of at
// most `step`. A tributary enters a wider river with its own width. Returns the upper end or -1.
static int64_t add_piece(OutTree *water, const OutTree *rivers, int64_t i, int64_t lower, bool main,
                         float step, Error *e)
{
    Vec3 from = rivers->position[rivers->parent[i]], to = rivers->position[i];
    float wide = main ? rivers->radius[rivers->parent[i]] : rivers->radius[i];
    float dx = to.x - from.x, dz = to.z - from.z;
    int steps = 1 + (int)(sqrtf(dx * dx + dz * dz) / step);
    for (int k = 1; k <= steps && lower >= 0; k++) {
        float t = (float)k / (float)steps;
        lower = out_tree_add_node(water, vec3_lerp(from, to, t), lower, 0, 0,
                                  random_key(rivers->id[i], (uint64_t)k), e);
        if (lower >= 0) {
            water->radius[lower] = lerpf(wide, rivers->radius[i], t);
        }
    }
    return lower;
}

// The rivers that the grid resolves, in steps of at most half a cell; empty if there are none.
static OutTree *wide_rivers(const Terrain *terrain, float cell, Error *e)
{
    const OutTree *rivers = terrain->tree;
    float least = 0.6f * cell; // narrower channels would be gaps in the grid's cells
    OutTree *water = out_tree_new(e);
    int32_t *heaviest = water ? heaviest_children(terrain, e) : NULL;
    int64_t *place = heaviest ? memory_alloc(rivers->count, sizeof *place, e) : NULL;
    bool done = place;
    for (int64_t i = 0; done && i < rivers->count; i++) {
        int32_t parent = rivers->parent[i];
        place[i] = -1;
        if (rivers->radius[i] < least || (parent >= 0 && place[parent] < 0)) {
            continue;
        }
        if (parent < 0) {
            place[i] = out_tree_add_node(water, rivers->position[i], -1, 0, 0, rivers->id[i], e);
            if (place[i] >= 0) {
                water->radius[place[i]] = rivers->radius[i];
            }
        } else {
            place[i] =
                add_piece(water, rivers, i, place[parent], heaviest[parent] == i, 0.5f * cell, e);
        }
        done = place[i] >= 0;
    }
    free(place);
    free(heaviest);
    if (!done) {
        out_tree_free(water);
        return NULL;
    }
    return water;
}

// The widest child; -1 = none.
int32_t *terrain_main_children(const OutTree *water, Error *e)
{
    int32_t *main = memory_alloc(water->count, sizeof *main, e);
    for (int64_t i = 0; main && i < water->count; i++) {
        int32_t parent = water->parent[i];
        main[i] = -1;
        if (parent >= 0 && (main[parent] < 0 || water->radius[i] > water->radius[main[parent]])) {
            main[parent] = (int32_t)i;
        }
    }
    return main;
}

// Smooths bends over a cell or two: each node moves toward the middle of its neighbours, except
// where a river begins or ends.
static bool round_bends(OutTree *water, Error *e)
{
    enum { TIMES = 24 };
    int32_t *main = terrain_main_children(water, e);
    Vec3 *moved = main ? memory_alloc(water->count, sizeof *moved, e) : NULL;
    for (int k = 0; moved && k < TIMES; k++) {
        for (int64_t i = 0; i < water->count; i++) {
            int32_t below = water->parent[i], above = main[i];
            moved[i] = water->position[i];
            if (below >= 0 && above >= 0) {
                Vec3 middle = vec3_lerp(water->position[below], water->position[above], 0.5f);
                moved[i] = vec3_lerp(moved[i], middle, 0.5f);
            }
        }
        memcpy(water->position, moved, sizeof *moved * (size_t)water->count);
    }
    bool done = moved;
    free(moved);
    free(main);
    return done;
}

// ---- the shore

// The envelope of the distances to the water: to each node's segment (to its parent), less half the
// water's width.
static TroughEnvelope *make_shore(const OutTree *water, float size, const Run *run, Error *e)
{
    Trough *trough = memory_alloc(water->count, sizeof *trough, e);
    if (!trough) {
        return NULL;
    }
    for (int64_t i = 0; i < water->count; i++) {
        int64_t below = water->parent[i] >= 0 ? water->parent[i] : i;
        Vec3 a = water->position[below], b = water->position[i];
        float dx = b.x - a.x, dz = b.z - a.z, length = sqrtf(dx * dx + dz * dz);
        // At most half of a distance's gradient, where a brook enters a wide river.
        float widens = clampf(water->radius[below] - water->radius[i], 0.0f, 0.5f * length);
        trough[i] = (Trough){.x = a.x,
                             .z = a.z,
                             .dx = length > 0.0f ? dx / length : 1.0f,
                             .dz = length > 0.0f ? dz / length : 0.0f,
                             .length = length,
                             .h0 = -water->radius[i] - widens,
                             .slope = length > 0.0f ? widens / length : 0.0f,
                             .gradient = 1.0f};
    }
    TroughEnvelope *shore = trough_envelope_new(trough, water->count, size, 0.0f, run, e);
    free(trough);
    return shore;
}

float terrain_shore(const Terrain *terrain, float x, float z)
{
    int32_t nearest;
    return terrain->shore ? trough_envelope_at(terrain->shore, x, z, &nearest) : INFINITY;
}

// ---- beds

// The water's level next to a place whose nearest segment is that of `node`.
static float level_at(const OutTree *water, int32_t node, float x, float z)
{
    int32_t below = water->parent[node] >= 0 ? water->parent[node] : node;
    Vec3 a = water->position[below], b = water->position[node];
    float dx = b.x - a.x, dz = b.z - a.z, squared = dx * dx + dz * dz;
    float t = squared > 0.0f ? ((x - a.x) * dx + (z - a.z) * dz) / squared : 0.0f;
    return lerpf(a.y, b.y, clampf(t, 0.0f, 1.0f));
}

// Walls of falls are uneven: where the level is looked up at a place, moved along the river.
static float uneven_level_at(const Terrain *terrain, int32_t node, float x, float z, float cell)
{
    const OutTree *water = terrain->water;
    int32_t below = water->parent[node];
    if (!terrain->flow[node].at_fall || below < 0) {
        return level_at(water, node, x, z);
    }
    Vec3 way = vec3_sub(water->position[below], water->position[node]);
    way = vec3_normalize(vec3(way.x, 0.0f, way.z));
    float scale = 0.5f / water->radius[node];
    uint64_t seed = random_key(terrain->seed, STREAM_LIPS);
    // Downstream alone: strands begin at the lip (falls.c).
    float noise = noise_plane_fractal(scale * x, scale * z, 4, seed);
    float moved = -2.0f * cell * clampf(0.4f + 1.3f * noise, 0.0f, 1.0f);
    float at_x = x + moved * way.x, at_z = z + moved * way.z;
    int32_t other;
    trough_envelope_at(terrain->shore, at_x, at_z, &other);
    return level_at(water, other, at_x, at_z);
}

static float bed_at(const Terrain *terrain, int32_t node, float x, float z, float away, float cell)
{
    float half = terrain->water->radius[node];
    return uneven_level_at(terrain, node, x, z, cell) - terrain_bed_depth(half, half + away);
}

// x and z of a sample.
static Vec2 sample_at(const HeightField *field, int row, int column)
{
    return (Vec2){field->origin.x + (float)column * field->cell.x,
                  field->origin.y + (float)row * field->cell.y};
}

// Where a river has cut into a wall, what stands above a bank this steep rises over some cells, by
// the exact distance to the water. A step from one sample to the next would follow the samples, not
// the shore: a wall at an angle to them would be a row of ribs, as tall as the wall.
#define BANK_SLOPE 2.0f
#define BANK_CELLS 2.5f

// The height of land of this height at a place beside a bed whose edge has a height; outside: m
// from that edge.
static float beside_bed(float land, float edge, float outside, float cell)
{
    float bank = edge + BANK_SLOPE * outside, share = outside / (BANK_CELLS * cell);
    return land > bank && share < 1.0f ? lerpf(bank, land, share) : land;
}

static bool dig_beds(const Terrain *terrain, HeightField *field, const Run *run)
{
    const float cell = field->cell.x, reach = TERRAIN_STRAND * cell;
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < field->columns && !run_is_cancelled(run); column++) {
            int64_t i = (int64_t)row * field->columns + column;
            Vec2 at = sample_at(field, row, column);
            int32_t node;
            float away = trough_envelope_at(terrain->shore, at.x, at.y, &node);
            if (away >= reach + BANK_CELLS * cell) {
                continue;
            }
            float bed = bed_at(terrain, node, at.x, at.y, away, cell);
            if (away < reach) {
                terrain->bank[i] = 1;
                field->height[i] = bed;
            } else {
                field->height[i] = beside_bed(field->height[i], bed, away - reach, cell);
            }
        }
    }
    return !run_is_cancelled(run);
}

// The share of its depth that a bed has at a node: none at the lip of a fall, where the rock is an
// even sill that the water runs over as a sheet, all of it from half the river's width upstream on.
static float sill_share(const Terrain *terrain, int32_t node)
{
    const OutTree *water = terrain->water;
    const float reach = water->radius[node];
    float run = 0.0f;
    for (int32_t i = node; run < reach && water->parent[i] >= 0; i = water->parent[i]) {
        if (terrain->drop[i] > 0.0f) {
            return smoothstepf(0.0f, reach, run);
        }
        Vec3 step = vec3_sub(water->position[i], water->position[water->parent[i]]);
        run += sqrtf(step.x * step.x + step.z * step.z);
    }
    return 1.0f;
}

// m by which the bed above the lip of a fall is raised to its sill, but for a notch along the
// river's middle, as wide as it takes for the samples in it to touch: through it the bed behind
// drains.
static float sill_at(const Terrain *terrain, int32_t node, float away, float cell)
{
    const float notch = 0.72f * cell;
    float half = terrain->water->radius[node];
    float more = terrain_bed_depth(half, half + away) - terrain_bed_depth(half, half);
    more *= smoothstepf(notch, notch + cell, half + away);
    return (1.0f - sill_share(terrain, node)) * more;
}

float terrain_bed_at(const Terrain *terrain, int32_t node, float x, float z, float away, float cell)
{
    float sill = away < 0.0f ? sill_at(terrain, node, away, cell) : 0.0f;
    return bed_at(terrain, node, x, z, away, cell) + sill;
}

static bool raise_sills(const Terrain *terrain, HeightField *field, const Run *run)
{
    const float cell = fmaxf(field->cell.x, field->cell.y);
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < field->columns && !run_is_cancelled(run); column++) {
            int64_t i = (int64_t)row * field->columns + column;
            Vec2 at = sample_at(field, row, column);
            int32_t node = 0;
            float away =
                terrain->bank[i] ? trough_envelope_at(terrain->shore, at.x, at.y, &node) : 0.0f;
            if (away < 0.0f) {
                field->height[i] += sill_at(terrain, node, away, cell);
            }
        }
    }
    return !run_is_cancelled(run);
}

// A river that crosses a lake is as high as the lake.
static void rest_on_lakes(Terrain *terrain, const HeightField *field)
{
    OutTree *water = terrain->water;
    for (int64_t i = 0; i < water->count; i++) {
        Vec3 *p = &water->position[i];
        float level = terrain_lake_at(terrain, field, p->x, p->z);
        p->y = level > -INFINITY ? level : p->y;
    }
}

bool terrain_lay_rivers(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    float water = terrain_evolves(terrain->params) ? terrain->params->canyon.river
                                                   : terrain->params->rivers.water;
    if (water <= 0.0f) {
        return true;
    }
    terrain->water = wide_rivers(terrain, field->cell.x, e);
    if (!terrain->water || terrain->water->count == 0) {
        return terrain->water;
    }
    if (!round_bends(terrain->water, e)) {
        return false;
    }
    const TerrainParams *params = terrain->params;
    terrain->drop = terrain_find_levels(terrain->water, &params->rivers, field, e);
    if (terrain->drop) {
        rest_on_lakes(terrain, field);
    }
    terrain->flow =
        terrain->drop ? terrain_find_flow(params, terrain->water, terrain->drop, e) : NULL;
    if (!terrain->flow) {
        return false;
    }
    terrain_widen_pools(terrain->water, terrain->drop);
    terrain->shore = make_shore(terrain->water, terrain->params->size, run, e);
    terrain->bank = memory_alloc_zero(height_field_count(field), 1, e);
    return terrain->shore && terrain->bank &&
           (dig_beds(terrain, field, run) || run_cancel_error(e)) &&
           height_field_fill(field, 0.0f, e) &&
           (raise_sills(terrain, field, run) || run_cancel_error(e));
}

// ---- the water over the land

// Rivers wet what is this near to them, in cells beyond the water's edge.
static const float RIVERSIDE = 4.0f;

static float water_over(const Terrain *terrain, const HeightField *field, float lake, float x,
                        float z)
{
    int32_t node;
    if (!terrain->shore ||
        trough_envelope_at(terrain->shore, x, z, &node) > RIVERSIDE * field->cell.x) {
        return lake;
    }
    float river = level_at(terrain->water, node, x, z);
    return river > lake ? river : lake;
}

static float *new_levels(const HeightField *field, float level, Error *e)
{
    float *water = memory_alloc(height_field_count(field), sizeof *water, e);
    for (int64_t i = 0; water && i < height_field_count(field); i++) {
        water[i] = level;
    }
    return water;
}

bool terrain_record_water(const Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    bool rivers = terrain->shore != NULL, lake = terrain->params->water_level > 0.0f;
    if (terrain_form(terrain->params)->water || (!rivers && !lake)) {
        return true;
    }
    float level = lake ? terrain_water_height(terrain->params, field) : -INFINITY;
    if (!field->water && !(field->water = new_levels(field, level, e))) {
        return false;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < field->columns && !run_is_cancelled(run); column++) {
            Vec2 at = sample_at(field, row, column);
            float *water = &field->water[(int64_t)row * field->columns + column];
            *water = water_over(terrain, field, *water, at.x, at.y);
        }
    }
    return !run_is_cancelled(run) || run_cancel_error(e);
}
