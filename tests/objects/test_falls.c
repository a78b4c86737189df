// Rivers that drop: levels that keep steps of the land, the flow along them, and the water that
// falls.
#include "making_terrain.h"

#include "base/memory.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "land/height_maps.h"
#include "land/height_mesh.h"
#include "mesh/geometry.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/spray.h"
#include "objects/terrain/white_water.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 256, NODES = 100 };
static const float SIZE = 400.0f, HALF = 6.0f; // m

// A straight river down a valley along z, with the profile of its floor.
typedef struct Valley {
    TerrainParams params;
    Terrain terrain;
    HeightField *field;
    float area[NODES];
} Valley;

typedef float Profile(float z);

// Falls 0.002 to the south, and over a wall of 12 m in the middle.
static float stepped(float z)
{
    return 40.0f - 0.002f * z - (z > 0.5f ? 12.0f : 0.0f);
}

static float calm(float z)
{
    return 40.0f - 0.002f * z;
}

static float steep(float z)
{
    return 100.0f - 0.3f * z;
}

static Valley make_valley(Profile *profile)
{
    Error e = {0};
    Valley v = {.params = terrain_params_default()};
    v.params.size = SIZE;
    v.params.resolution = CELLS;
    v.params.rivers.water = 0.006f;
    float cell = SIZE / CELLS;
    v.field = height_field_new(CELLS + 1, CELLS + 1, (Vec2){cell, cell},
                               (Vec2){-0.5f * SIZE, -0.5f * SIZE}, &e);
    assert_non_null(v.field);
    for (int64_t i = 0; i < height_field_count(v.field); i++) {
        float x = -0.5f * SIZE + cell * (float)(i % (CELLS + 1));
        float z = -0.5f * SIZE + cell * (float)(i / (CELLS + 1));
        v.field->height[i] = profile(z) + 0.3f * fmaxf(fabsf(x) - 3.0f * HALF, 0.0f);
    }
    v.terrain = (Terrain){.seed = 1, .tree = out_tree_new(&e)};
    for (int i = 0; i < NODES; i++) {
        float z = SIZE * (0.5f - (float)i / (float)(NODES - 1));
        int64_t node = out_tree_add_node(v.terrain.tree, vec3(0.0f, 0.0f, z), i - 1, i, 0,
                                         random_key(7, (uint64_t)i), &e);
        assert_int_equal(node, i);
        v.terrain.tree->radius[i] = HALF;
        v.area[i] = 1e6f;
    }
    return v;
}

static void lay(Valley *v)
{
    Error e = {0};
    Run run = run_default();
    v->terrain.params = &v->params;
    v->terrain.area = v->area;
    assert_true(terrain_lay_rivers(&v->terrain, v->field, &run, &e));
}

static void drop_valley(Valley *v)
{
    Terrain *t = &v->terrain;
    out_tree_free(t->tree);
    out_tree_free(t->water);
    trough_envelope_free(t->shore);
    free(t->bank);
    free(t->drop);
    free(t->flow);
    height_field_free(v->field);
}

// The number of falls; *lip: the last of them.
static int count_falls(const Valley *v, int64_t *lip)
{
    int count = 0;
    for (int64_t i = 0; i < v->terrain.water->count; i++) {
        if (v->terrain.drop[i] > 0.0f) {
            count++;
            *lip = i;
        }
    }
    return count;
}

// ---- levels

static void a_stepped_bed_keeps_its_step(void **state)
{
    (void)state;
    Valley v = make_valley(stepped);
    lay(&v);
    const OutTree *water = v.terrain.water;
    int64_t lip = -1;
    assert_int_equal(count_falls(&v, &lip), 1);
    assert_float_equal(v.terrain.drop[lip], 12.0f, 0.1f);
    float cell = v.field->cell.x;
    assert_true(fabsf(water->position[lip].z - 0.5f) < 2.0f * cell);
    for (int64_t i = 0; i < water->count; i++) {
        Vec3 p = water->position[i];
        if (i != lip) { // levels are those of the land, but for the samples' width
            bool under = i < lip;
            float wall = under ? 12.0f : 0.0f;
            assert_float_equal(p.y, calm(p.z) - wall, 0.05f);
        }
        if (water->parent[i] >= 0) {
            assert_true(water->position[water->parent[i]].y <= p.y);
        }
    }
    // Where the wall is, the dug bed drops within two cells, at an uneven lip.
    float most = 0.0f, above = height_field_at(v.field, 0.0f, water->position[lip].z - 4.0f * cell);
    for (int k = -4; k < 4; k++) {
        float z = water->position[lip].z + (float)k * cell;
        float falls =
            height_field_at(v.field, 0.0f, z) - height_field_at(v.field, 0.0f, z + 2.0f * cell);
        most = fmaxf(most, falls);
    }
    float below = height_field_at(v.field, 0.0f, water->position[lip].z + 4.0f * cell);
    assert_float_equal(most, 12.0f, 1.0f);
    assert_float_equal(above - below, 12.0f, 0.5f);
    drop_valley(&v);
}

static void without_falls_a_step_is_a_ramp(void **state)
{
    (void)state;
    Valley v = make_valley(stepped);
    v.params.rivers.fall_height = 0.0f;
    lay(&v);
    const OutTree *water = v.terrain.water;
    int64_t lip = -1;
    assert_int_equal(count_falls(&v, &lip), 0);
    float most = 0.0f;
    for (int64_t i = 1; i < water->count; i++) {
        most = fmaxf(most, water->position[i].y - water->position[water->parent[i]].y);
    }
    assert_true(most < 3.0f);
    drop_valley(&v);
}

static void an_even_slope_has_no_falls(void **state)
{
    (void)state;
    Profile *const profiles[] = {calm, steep};
    for (int k = 0; k < 2; k++) {
        Valley v = make_valley(profiles[k]);
        lay(&v);
        int64_t lip = -1;
        assert_int_equal(count_falls(&v, &lip), 0);
        drop_valley(&v);
    }
}

// A step lower than `fall_height` is none.
static void a_step_must_be_high_and_steep(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        Valley v = make_valley(stepped);
        v.params.rivers.fall_height = k == 0 ? 11.0f : k == 1 ? 13.0f : 2.0f;
        v.params.rivers.fall_slope = k == 2 ? 3.0f : k == 3 ? 5.0f : 1.0f; // 12 m in 3.1 m: 3.8
        lay(&v);
        int64_t lip = -1;
        assert_int_equal(count_falls(&v, &lip), k % 2 == 0 ? 1 : 0);
        drop_valley(&v);
    }
}

// ---- banks

// A gorge with upright walls that the river, at an angle to the samples, has cut into.
static const float OBLIQUE = 0.15f, WALL = 12.0f; // x per z; m

static Valley make_gorge(void)
{
    Valley v = make_valley(calm);
    for (int64_t i = 0; i < height_field_count(v.field); i++) {
        float x = v.field->origin.x + v.field->cell.x * (float)(i % (CELLS + 1));
        float z = v.field->origin.y + v.field->cell.y * (float)(i / (CELLS + 1));
        float wall = fabsf(x - OBLIQUE * z) > 0.8f * HALF ? WALL : 0.0f;
        v.field->height[i] = calm(z) + wall;
    }
    for (int i = 0; i < NODES; i++) {
        v.terrain.tree->position[i].x = OBLIQUE * v.terrain.tree->position[i].z;
    }
    return v;
}

// How far from the river's middle, in x, its right wall is at half of its height.
static float wall_at(const Valley *v, int row)
{
    float cell = v->field->cell.x, z = v->field->origin.y + (float)row * v->field->cell.y;
    const float *h = v->field->height + (int64_t)row * v->field->columns;
    float half = calm(z) + 0.5f * WALL;
    int k = (int)((OBLIQUE * z - v->field->origin.x) / cell);
    while (h[k] < half) {
        k++;
    }
    float t = (half - h[k - 1]) / (h[k] - h[k - 1]);
    return v->field->origin.x + cell * ((float)(k - 1) + t) - OBLIQUE * z;
}

// A wall beside the water follows the water, not the samples: no ribs, of half a cell before.
static void walls_beside_rivers_have_no_ribs(void **state)
{
    (void)state;
    Valley v = make_gorge();
    lay(&v);
    float least = INFINITY, most = -INFINITY;
    for (int row = CELLS / 4; row < 3 * CELLS / 4; row++) {
        float away = wall_at(&v, row);
        least = fminf(least, away);
        most = fmaxf(most, away);
    }
    printf("    the wall bends by %.2f cells\n", (double)((most - least) / v.field->cell.x));
    assert_true(most - least < 0.3f * v.field->cell.x);
    drop_valley(&v);
    // Gentle land is left as it is.
    v = make_valley(calm);
    int64_t count = height_field_count(v.field);
    float *before = memory_alloc(count, sizeof *before, NULL);
    memcpy(before, v.field->height, sizeof *before * (size_t)count);
    lay(&v);
    for (int64_t i = 0; i < count; i++) {
        assert_true(v.terrain.bank[i] || v.field->height[i] == before[i]);
    }
    free(before);
    drop_valley(&v);
}

// ---- the flow

static void the_flow_is_continuous_and_jarretts(void **state)
{
    (void)state;
    static const float slopes[] = {0.002f, 0.02f, 0.1f, 0.4f};
    for (int k = 0; k < 4; k++) {
        RiverFlow f = terrain_flow_of(12.0f, 5.0f, slopes[k]);
        assert_float_equal(f.speed * f.depth * 10.0f, 12.0f, 1e-3f);
        double speed = 3.17 * pow((double)f.depth, 0.83) * pow((double)slopes[k], 0.12);
        assert_true(fabs((double)f.speed / speed - 1.0) < 1e-4);
    }
}

static void foam_grows_with_the_slope(void **state)
{
    (void)state;
    static const float discharges[] = {0.5f, 5.0f, 80.0f};
    for (int k = 0; k < 3; k++) {
        float last = 0.0f, half = 2.4f * sqrtf(discharges[k]);
        for (float slope = 1e-4f; slope < 1.0f; slope *= 1.1f) {
            float foam = terrain_flow_of(discharges[k], half, slope).foam;
            assert_true(foam >= last && foam <= 1.0f);
            assert_true(slope > 0.007f || foam == 0.0f);
            last = foam;
        }
        assert_true(last == 1.0f);
    }
}

static void calm_rivers_have_no_foam(void **state)
{
    (void)state;
    Valley v = make_valley(calm);
    lay(&v);
    for (int64_t i = 0; i < v.terrain.water->count; i++) {
        assert_true(v.terrain.flow[i].foam == 0.0f);
        bool inside = fabsf(v.terrain.water->position[i].z) < 0.4f * SIZE; // level at the outlet
        assert_true(!inside || fabsf(v.terrain.flow[i].slope - 0.002f) < 2e-4f);
        // A million square metres of drainage area, in proportion to the width's square.
        assert_float_equal(v.terrain.flow[i].discharge, v.params.rivers.runoff, 1e-4f);
    }
    drop_valley(&v);
}

// Foam is whole at the foot and fades down the pool by what the water takes to flow there: dense
// foam loses half within little more than a second, what is left of it lasts many times as long.
static void foam_drifts_on_below_a_fall(void **state)
{
    (void)state;
    Valley v = make_valley(stepped);
    lay(&v);
    const OutTree *water = v.terrain.water;
    int64_t lip = -1;
    assert_int_equal(count_falls(&v, &lip), 1);
    int64_t foot = water->parent[lip], i = foot;
    assert_true(v.terrain.flow[foot].foam == 1.0f);
    while (water->position[water->parent[i]].z - water->position[foot].z <
           0.499f * v.terrain.drop[lip]) {
        i = water->parent[i]; // it boils for half the fall's height
        assert_true(v.terrain.flow[i].foam == 1.0f);
    }
    double expected = 1.0;
    int faded = 0;
    for (; water->parent[i] >= 0; i = water->parent[i]) {
        int32_t below = water->parent[i];
        double run = (double)(water->position[below].z - water->position[i].z);
        double seconds = run / (double)v.terrain.flow[below].speed;
        expected *= exp(-seconds / 20.0) / (1.0 + expected * seconds / 1.2);
        double found = (double)v.terrain.flow[below].foam;
        if (expected > 0.03) {
            assert_true(fabs(found - expected) < 1e-3);
            faded++;
        }
    }
    assert_true(faded > 2);
    for (i = lip; i < water->count; i++) { // nothing drifts up
        assert_true(v.terrain.flow[i].foam == 0.0f);
    }
    drop_valley(&v);
}

// Of a grown terrain with hard beds: levels fall, drops are what they say, and the main stem
// gathers water.
static void rivers_over_hard_beds_fall_and_gather(void **state)
{
    (void)state;
    TerrainParams params = terrain_params_default();
    params.size = 3000.0f;
    params.relief = 900.0f;
    params.resolution = 512;
    params.rivers.count = 60;
    params.rivers.water = 0.02f;
    params.terraces = (TerrainTerraceParams){.count = 6, .strength = 1.0f, .sheer = 1.0f};
    Grown grown;
    HeightField *field = make_heights(&params, 3, 1, NULL, &grown);
    const Terrain *terrain = grown.state;
    const OutTree *water = terrain->water;
    int falls = 0;
    for (int64_t i = 0; i < water->count; i++) {
        int32_t parent = water->parent[i];
        assert_true(terrain->drop[i] >= 0.0f && (parent >= 0 || terrain->drop[i] == 0.0f));
        if (parent < 0) {
            continue;
        }
        float fall = water->position[i].y - water->position[parent].y;
        assert_true(fall >= 0.0f);
        assert_true(terrain->drop[i] == 0.0f || terrain->drop[i] == fall);
        falls += terrain->drop[i] > 0.0f;
        assert_true(terrain->flow[parent].discharge >= 0.999f * terrain->flow[i].discharge);
    }
    assert_true(falls >= 3);
    grown_clear(&grown);
    height_field_free(field);
}

// ---- falling water

static void water_leaves_a_lip_at_the_speed_of_an_overfall(void **state)
{
    (void)state;
    static const float discharges[] = {0.1f, 3.0f, 500.0f};
    for (int k = 0; k < 3; k++) {
        double q = (double)discharges[k] / 8.0;
        double critical = 0.0; // depth at which the speed is that of long waves, by halving
        for (double low = 0.0, high = 100.0; high - low > 1e-9;) {
            critical = 0.5 * (low + high);
            *(q / critical > sqrt(9.81 * critical) ? &low : &high) = critical;
        }
        double speed = q / (0.715 * critical);
        assert_true(fabs((double)terrain_lip_speed(discharges[k], 4.0f) / speed - 1.0) < 1e-4);
    }
}

static void a_sheet_is_a_parabola(void **state)
{
    (void)state;
    enum { MOST = 400 };
    FallPath path = {.way = {0.6f, 0.0f, 0.8f}, .level = 3.0f, .step = 0.02f};
    Vec3 start = {5.0f, 33.0f, -2.0f}, velocity = vec3(1.2f, 0.5f, 1.6f), place[MOST];
    int count = terrain_fall_path(&path, start, velocity, place, MOST);
    assert_in_range(count, 50, MOST - 1);
    for (int i = 0; i < count; i++) {
        double x = (double)(place[i].x - start.x) / 0.6;
        double t = x / 2.0, y = 33.0 + 0.5 * t - 0.5 * 9.81 * t * t;
        bool last = i == count - 1; // cut at the level on a chord
        assert_true(fabs((double)place[i].y - y) < (last ? 2e-3 : 2e-4) * 30.0);
        assert_true(fabs((double)(place[i].z - start.z) / 0.8 - x) < 1e-3);
    }
    double time = (0.5 + sqrt(0.25 + 2.0 * 9.81 * 30.0)) / 9.81;
    assert_true(place[count - 1].y == 3.0f);
    assert_true(fabs((double)(place[count - 1].x - 5.0f) - 1.2 * time) < 2e-3);
}

// Over a ledge water slides and leaps on; it is never under the land and reaches the pool.
static void a_ledge_throws_water_out_again(void **state)
{
    (void)state;
    enum { MOST = 2000 };
    Valley v = make_valley(calm);
    for (int64_t i = 0; i < height_field_count(v.field); i++) {
        float z = v.field->origin.y + v.field->cell.y * (float)(i / (CELLS + 1));
        v.field->height[i] = z < 0.0f ? 30.0f : z < 6.0f ? 16.0f : 0.0f;
    }
    DrawnLand land = {.field = v.field};
    FallPath path = {
        .land = &land, .way = {0.0f, 0.0f, 1.0f}, .level = 1.0f, .film = 0.05f, .step = 0.02f};
    Vec3 place[MOST];
    int count =
        terrain_fall_path(&path, vec3(0.0f, 30.1f, -1.0f), vec3(0.0f, 0.0f, 1.5f), place, MOST);
    bool slid = false;
    for (int i = 0; i < count; i++) {
        float ground = height_mesh_finest_at(v.field, place[i].x, place[i].z);
        assert_true(place[i].y > ground - 0.05f || place[i].y == path.level);
        slid = slid || (fabsf(place[i].y - 16.05f) < 0.02f && place[i].z > 2.0f);
        assert_true(i == 0 || place[i].z >= place[i - 1].z);
    }
    assert_true(slid);
    assert_true(place[count - 1].y == 1.0f);
    assert_true(place[count - 1].z > 5.5f);
    drop_valley(&v);
}

typedef bool AddParts(const DrawnLand *land, const Placing *placing, Error *e);

// water: strands become white water below the lip.
static Geometry parts_by(AddParts *add, const Valley *v, bool water, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Recipe recipe = {.seed = 5, .label = "land", .run = &run};
    Geometry geometry = {0};
    static const int material[4] = {0, 1, 2, 3};
    Placing placing = {.recipe = &recipe,
                       .geometry = &geometry,
                       .material = material,
                       .keep_spray = true,
                       .keep_water = water};
    DrawnLand land = {.terrain = &v->terrain, .field = v->field};
    assert_true(add(&land, &placing, &e));
    return geometry;
}

static Geometry fall_parts(const Valley *v, bool water, int threads)
{
    return parts_by(terrain_add_falls, v, water, threads);
}

// Lays a river over a stepped valley: one wide fall. Returns the node at its lip.
static int64_t make_wide_fall(Valley *v, Geometry *geometry)
{
    *v = make_valley(stepped);
    v->params.rivers.runoff = 20.0f;
    lay(v);
    int64_t lip = -1;
    assert_int_equal(count_falls(v, &lip), 1);
    *geometry = fall_parts(v, false, 1);
    return lip;
}

// The river's surface is level up to the lip, and from the foot on: its normals are those of its
// slope of 0.002, not of the wall between them.
static void rivers_lie_level_beside_a_wall(void **state)
{
    (void)state;
    Valley v = make_valley(stepped);
    lay(&v);
    Geometry geometry = parts_by(terrain_add_water, &v, false, 1);
    const Mesh *mesh = geometry.part[0].mesh; // the falls come after it
    assert_true(mesh->vertex_count > 500);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        assert_true(mesh->normal[i].y > 0.999f);
    }
    geometry_clear(&geometry);
    drop_valley(&v);
}

// The coordinates of a river's foam are metres across, and along the flow metres that the root of
// its speed shortens: foam is drawn out by it.
static void foam_lies_along_the_flow(void **state)
{
    (void)state;
    Valley v = make_valley(calm);
    v.params.rivers.runoff = 20.0f;
    lay(&v);
    Geometry geometry = parts_by(terrain_add_water, &v, false, 1);
    const Mesh *mesh = geometry.part[0].mesh;
    int64_t upper = 0, lower = 0; // of those well within the square
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        float z = mesh->position[i].z, inside = 0.3f * SIZE;
        assert_true(fabsf(fabsf(mesh->uv[i].y) - fabsf(mesh->position[i].x)) < 0.1f);
        upper = fabsf(z + inside) < fabsf(mesh->position[upper].z + inside) ? i : upper;
        lower = fabsf(z - inside) < fabsf(mesh->position[lower].z - inside) ? i : lower;
    }
    double way = (double)(mesh->position[lower].z - mesh->position[upper].z);
    double along = (double)(mesh->uv[upper].x - mesh->uv[lower].x);
    double speed = (double)v.terrain.flow[v.terrain.water->count / 2].speed;
    assert_true(way > 0.5 * (double)SIZE && speed > 0.5);
    assert_true(fabs(along * sqrt(1.0 + speed) / way - 1.0) < 0.03);
    geometry_clear(&geometry);
    drop_valley(&v);
}

// The sill above a lip dams nothing: the bed behind it drains through a notch.
static void land_with_a_sill_drains(void **state)
{
    (void)state;
    Valley v = make_valley(stepped);
    lay(&v);
    int64_t lip;
    assert_int_equal(count_falls(&v, &lip), 1);
    assert_int_equal(height_field_pits(v.field), 0);
    drop_valley(&v);
}

// The strands of a fall lie between the parabolas of the slowest and the fastest, on both sides of
// that of the mean speed, and end on the pool.
static void strands_fall_into_the_pool(void **state)
{
    (void)state;
    Valley v;
    Geometry geometry;
    int64_t lip = make_wide_fall(&v, &geometry);
    assert_int_equal(geometry.count, 1);
    const Mesh *mesh = geometry.part[0].mesh;
    assert_true(mesh->vertex_count > 10000 && mesh->foam);
    const OutTree *water = v.terrain.water;
    Vec3 edge = water->position[lip];
    float pool = water->position[water->parent[lip]].y;
    double speed = (double)fmaxf(terrain_lip_speed(v.terrain.flow[lip].discharge, HALF),
                                 v.terrain.flow[lip].speed);
    double sum = 0.0;
    int64_t feet = 0;
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        assert_true(p.y > pool - 0.2f && p.y < edge.y + 0.5f);
        assert_true(fabsf(p.x) < HALF + 2.0f && mesh->foam[i] >= 0.0f && mesh->foam[i] <= 1.0f);
        if (p.y < pool + 1e-3f) {
            sum += (double)(p.z - edge.z) + 0.3 * (double)v.field->cell.x;
            feet++;
            assert_true(mesh->foam[i] == 1.0f);
        }
    }
    assert_true(feet > 200);
    // Free flight from the lip is the farthest; rock that juts out and the banks hold strands back.
    double mean = sum / (double)feet / (speed * sqrt(2.0 * 12.0 / 9.81));
    assert_true(mean > 0.4 && mean < 1.0);
    geometry_clear(&geometry);
    drop_valley(&v);
}

// Does a face cover the place (x, y), seen level along z?
static bool face_covers(const Mesh *mesh, int64_t face, float x, float y)
{
    bool inside = false;
    for (int k = 0; k < 4; k++) { // crossings of a ray along x with its outline
        Vec3 a = mesh->position[mesh->index[4 * face + k]];
        Vec3 b = mesh->position[mesh->index[4 * face + (k + 1) % 4]];
        if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
    }
    return inside;
}

// At a lip water is level from bank to bank, and bends over as one sheet: nothing of it stands
// higher, and below the edge it covers the whole width.
static void water_bends_over_a_lip_as_one_sheet(void **state)
{
    (void)state;
    enum { PLACES = 200 };
    Valley v;
    Geometry geometry;
    int64_t lip = make_wide_fall(&v, &geometry);
    const Mesh *mesh = geometry.part[0].mesh;
    float edge = v.terrain.water->position[lip].y;
    for (int i = 0; i < PLACES; i++) {
        float x = 0.93f * HALF * (2.0f * (float)i / (PLACES - 1) - 1.0f);
        for (int h = 1; h <= 4; h++) {
            bool covered = false;
            for (int64_t k = 0; !covered && k < mesh->face_count; k++) {
                covered = face_covers(mesh, k, x, edge - 0.05f * (float)h);
            }
            assert_true(covered);
        }
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        assert_true(mesh->position[i].y < edge + 0.1f);
    }
    geometry_clear(&geometry);
    drop_valley(&v);
}

// Spray holds what leaves the foot until it rains out, as the closed form tells, beside its veil,
// and hangs over the pool, no higher than the way of the fastest puff.
static void feet_throw_up_spray(void **state)
{
    (void)state;
    enum { STRANDS = 4000 };
    FallSpray fall = {.way = {0, 0, 1},
                      .across = {1, 0, 0},
                      .half = 4.0f,
                      .height = 20.0f,
                      .cover = 0.5f,
                      .strands = STRANDS,
                      .key = 9};
    Vec3 place[2] = {{0, 20, 0}, {0, 0, 3}};
    SprayParcels spray = {0};
    double foot = 0.0, veil = 0.0;
    for (int i = 0; i < STRANDS; i++) {
        int64_t first = spray.count;
        assert_true(terrain_spray_strand(&fall, i, place, 2, &spray, NULL));
        assert_int_equal(spray.count - first, 9);
        for (int64_t k = first; k < spray.count; k++) {
            const SprayParcel *parcel = &spray.parcel[k];
            *(k - first < 6 ? &foot : &veil) += (double)parcel->content;
            assert_true(parcel->center.y > 0.0f && parcel->center.y <= 20.0f);
            assert_true(fabsf(parcel->center.x) < 20.0f && parcel->radius < 8.0f);
        }
    }
    double wanted = (double)terrain_fall_content(&fall);
    assert_true(fabs(foot - wanted) < 0.03 * wanted);
    assert_true(veil > 0.0 && veil < foot);
    free(spray.parcel);
}

// In the scene, and so is the water that it comes from.
static void falls_carry_their_spray(void **state)
{
    (void)state;
    Valley v;
    Geometry geometry;
    int64_t lip = make_wide_fall(&v, &geometry);
    const SprayParcels *spray = geometry.part[0].spray;
    assert_true(spray && spray->count > 1000);
    float pool = v.terrain.water->position[v.terrain.water->parent[lip]].y;
    for (int64_t i = 0; i < spray->count; i++) {
        assert_true(spray->parcel[i].center.y >= pool);
        assert_true(spray->parcel[i].content >= 0.0f && spray->parcel[i].radius > 0.0f);
    }
    geometry_clear(&geometry);
    drop_valley(&v);
}

// White water is as much as the river brings while it falls: its discharge times the time from
// where it breaks up, at a tenth of the height, to the pool. Strands then end where it begins.
static void white_water_is_what_the_river_brings(void **state)
{
    (void)state;
    Valley v;
    Geometry plain;
    int64_t lip = make_wide_fall(&v, &plain);
    Geometry geometry = fall_parts(&v, true, 1);
    const SprayParcels *water = geometry.part[0].water;
    assert_null(plain.part[0].water);
    float pool = v.terrain.water->position[v.terrain.water->parent[lip]].y;
    double contents = 0.0, heights = 0.0;
    for (int64_t i = 0; i < water->count; i++) {
        const SprayParcel *parcel = &water->parcel[i];
        assert_true(parcel->content >= 0.0f && parcel->radius > 0.0f);
        assert_true(vec3_length(parcel->drawn) < 1.5f && fabsf(parcel->center.x) < HALF + 2.0f);
        contents += (double)parcel->content;
        heights += (double)(parcel->content * (parcel->center.y - pool));
    }
    double seconds = sqrt(2.0 * 12.0 / 9.81) * (1.0 - sqrt(0.1));
    double wanted = (double)v.terrain.flow[lip].discharge * seconds;
    double found = contents / (double)spray_of_water();
    assert_true(found > 0.9 * wanted && found < 1.2 * wanted); // rock slows some of it down
    assert_true(heights / contents > 3.0 && heights / contents < 8.0);
    const Mesh *mesh = geometry.part[0].mesh;
    assert_true(mesh->vertex_count < plain.part[0].mesh->vertex_count);
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        assert_true(mesh->position[i].y > pool + 0.5f * 12.0f);
    }
    geometry_clear(&geometry);
    geometry_clear(&plain);
    drop_valley(&v);
}

// A shutter of half a second shows as much water, drawn out by what it falls in this time, but not
// beyond the lip.
static void an_open_shutter_draws_water_out(void **state)
{
    (void)state;
    double contents[2] = {0.0, 0.0}, drawn[2] = {0.0, 0.0};
    for (int k = 0; k < 2; k++) {
        Valley v = make_valley(stepped);
        v.params.rivers.shutter = 0.5f * (float)k;
        lay(&v);
        int64_t lip = -1;
        assert_int_equal(count_falls(&v, &lip), 1);
        Geometry geometry = fall_parts(&v, true, 1);
        const SprayParcels *water = geometry.part[0].water;
        float edge = v.terrain.water->position[lip].y + 0.5f;
        for (int64_t i = 0; i < water->count; i++) {
            const SprayParcel *parcel = &water->parcel[i];
            contents[k] += (double)parcel->content;
            drawn[k] += (double)(parcel->content * vec3_length(parcel->drawn));
            assert_true(k == 0 || parcel->center.y + fabsf(parcel->drawn.y) < edge + 1.5f);
        }
        drawn[k] /= contents[k];
        geometry_clear(&geometry);
        drop_valley(&v);
    }
    assert_true(fabs(contents[1] / contents[0] - 1.0) < 1e-3);
    // Half of 0.5 s at 6 to 15 m/s, less what has just left the lip.
    assert_true(drawn[1] - drawn[0] > 1.5 && drawn[1] - drawn[0] < 3.5);
}

static void falls_have_the_same_bits_for_any_threads(void **state)
{
    (void)state;
    Valley v = make_valley(stepped);
    lay(&v);
    Geometry one = fall_parts(&v, true, 1), four = fall_parts(&v, true, 4);
    const Mesh *a = one.part[0].mesh, *b = four.part[0].mesh;
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_memory_equal(a->position, b->position, sizeof(Vec3) * (size_t)a->vertex_count);
    assert_memory_equal(a->foam, b->foam, sizeof(float) * (size_t)a->vertex_count);
    const SprayParcels *first = one.part[0].water, *second = four.part[0].water;
    assert_int_equal(first->count, second->count);
    assert_memory_equal(first->parcel, second->parcel, sizeof(SprayParcel) * (size_t)first->count);
    geometry_clear(&one);
    geometry_clear(&four);
    drop_valley(&v);
}

// ---- water over the land

// The map is the level of the lake, or of the river next to the place, less the ground.
static void water_depth_is_the_level_less_the_bed(void **state)
{
    (void)state;
    Valley v = make_valley(stepped);
    lay(&v);
    Error e = {0};
    Run run = run_default();
    assert_true(terrain_record_water(&v.terrain, v.field, &run, &e));
    HeightField *map = height_map(v.field, &(HeightMap){.kind = HEIGHT_MAP_WATER_DEPTH}, &run, &e);
    assert_non_null(map);
    int wet = 0, far = 0;
    float cell = v.field->cell.x;
    for (int64_t i = 0; i < height_field_count(map); i++) {
        float x = v.field->origin.x + cell * (float)(i % (CELLS + 1));
        float z = v.field->origin.y + cell * (float)(i / (CELLS + 1));
        if (fabsf(x) > 1.6f * HALF + 4.1f * cell) { // no water near
            assert_true(isnan(map->height[i]));
            far++;
        } else if (fabsf(x) < HALF && (z < -8.0f * cell || z > 8.0f * HALF) &&
                   fabsf(z) < 0.4f * SIZE) { // off the wall and the pool
            // The bed is a parabola below the level, which is the valley's floor.
            float share = fabsf(x) / HALF, bed = HALF * (0.03f + 0.25f * (1.0f - share * share));
            assert_float_equal(map->height[i], bed, 0.02f);
            float level = map->height[i] + v.field->height[i];
            assert_float_equal(level, stepped(z), 0.05f);
            wet++;
        }
    }
    assert_true(wet > 1000 && far > 1000);
    height_field_free(map);
    drop_valley(&v);
}

static void a_lake_has_one_level(void **state)
{
    (void)state;
    TerrainParams params = terrain_params_default();
    params.resolution = 128;
    params.rivers.count = 60;
    params.rivers.water = 0.0f;
    params.water_level = 0.1f;
    Error e = {0};
    Run run = run_default();
    HeightField *field = make_heights(&params, 3, 1, NULL, NULL);
    HeightField *map = height_map(field, &(HeightMap){.kind = HEIGHT_MAP_WATER_DEPTH}, &run, &e);
    assert_non_null(map);
    float low, high;
    height_field_range(field, &low, &high);
    int wet = 0;
    for (int64_t i = 0; i < height_field_count(map); i++) {
        float level = lerpf(low, high, 0.1f);
        assert_float_equal(map->height[i], level - field->height[i], 1e-3f);
        wet += map->height[i] > 0.0f;
    }
    assert_true(wet > 50);
    height_field_free(map);
    height_field_free(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stepped_bed_keeps_its_step),
        cmocka_unit_test(without_falls_a_step_is_a_ramp),
        cmocka_unit_test(an_even_slope_has_no_falls),
        cmocka_unit_test(a_step_must_be_high_and_steep),
        cmocka_unit_test(walls_beside_rivers_have_no_ribs),
        cmocka_unit_test(the_flow_is_continuous_and_jarretts),
        cmocka_unit_test(foam_grows_with_the_slope),
        cmocka_unit_test(calm_rivers_have_no_foam),
        cmocka_unit_test(foam_drifts_on_below_a_fall),
        cmocka_unit_test(rivers_over_hard_beds_fall_and_gather),
        cmocka_unit_test(water_leaves_a_lip_at_the_speed_of_an_overfall),
        cmocka_unit_test(a_sheet_is_a_parabola),
        cmocka_unit_test(a_ledge_throws_water_out_again),
        cmocka_unit_test(rivers_lie_level_beside_a_wall),
        cmocka_unit_test(foam_lies_along_the_flow),
        cmocka_unit_test(land_with_a_sill_drains),
        cmocka_unit_test(strands_fall_into_the_pool),
        cmocka_unit_test(water_bends_over_a_lip_as_one_sheet),
        cmocka_unit_test(feet_throw_up_spray),
        cmocka_unit_test(falls_carry_their_spray),
        cmocka_unit_test(white_water_is_what_the_river_brings),
        cmocka_unit_test(an_open_shutter_draws_water_out),
        cmocka_unit_test(falls_have_the_same_bits_for_any_threads),
        cmocka_unit_test(water_depth_is_the_level_less_the_bed),
        cmocka_unit_test(a_lake_has_one_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
