// Ponds: the basin has the area and volume of its formula, the banks hold the water, which is
// level, the coarse mesh of the land lies below the basin, and nothing stands in it.
#include "mesh/cover.h"
#include "objects/ground/ground.h"
#include "objects/kinds.h"
#include "objects/making.h"
#include "render/world.h"
#include "scene/builder.h"
#include "scene/geometry_hash.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SEED = 7 };

// Hilly land without plants.
static GroundParams land_with(Pond *pond)
{
    GroundParams land = ground_params_default();
    land.grass_tufts = 0;
    land.flat_radius = 0.0f;
    land.relief = 12.0f;
    land.wavelength = 80.0f;
    land.ponds = pond;
    land.pond_count = 1;
    return land;
}

static Pond pond_at(float x, float z, float irregularity)
{
    Pond pond = pond_default();
    pond.position[0] = x;
    pond.position[1] = z;
    pond.radius = 3.0f;
    pond.depth = 0.8f;
    pond.irregularity = irregularity;
    return pond;
}

// Sums over a raster of the ground: m^2 and m^3 below the level within the basin.
static void sum_water(const GroundParams *land, double *area, double *volume)
{
    const double cell = 0.03;
    PondSite site = ground_pond(land, SEED, 0);
    double reach = (double)pond_reach(site.pond);
    int half = (int)(reach / cell);
    *area = *volume = 0.0;
    for (int i = -half; i <= half; i++) {
        for (int k = -half; k <= half; k++) {
            float x = site.pond->position[0] + (float)(cell * i);
            float z = site.pond->position[1] + (float)(cell * k);
            double depth = (double)site.level - (double)ground_height(land, SEED, x, z);
            if (depth > 0.0 && hypot(cell * i, cell * k) < 0.62 * reach + 0.5) {
                *area += cell * cell;
                *volume += depth * cell * cell;
            }
        }
    }
}

// Of a circle: pi r^2, and the integral of the profile, pi r^2 d (0.35 / 2 + 0.65 / 3).
static void a_round_basin_has_the_volume_of_its_formula(void **state)
{
    (void)state;
    Pond pond = pond_at(14.0f, -6.0f, 0.0f);
    GroundParams land = land_with(&pond);
    double area, volume;
    sum_water(&land, &area, &volume);
    double circle = 3.14159265358979 * 9.0;
    assert_true(fabs(area / circle - 1.0) < 0.004);
    assert_true(fabs(volume / (circle * 0.8 * (0.175 + 0.65 / 3.0)) - 1.0) < 0.004);
}

// Of any star-shaped outline: half the integral of the squared distance over the angle; the volume
// is to the area as in a circle.
static void a_ragged_basin_has_the_area_of_its_outline(void **state)
{
    (void)state;
    enum { ANGLES = 4000 };
    Pond pond = pond_at(14.0f, -6.0f, 1.0f);
    GroundParams land = land_with(&pond);
    pond.bank = 0.4f;
    land.relief = 0.0f; // no land beyond the banks is lower than the water
    PondSite site = ground_pond(&land, SEED, 0);
    double outline = 0.0, least = 1e9, most = 0.0;
    for (int i = 0; i < ANGLES; i++) {
        double angle = 6.283185307179586 * i / ANGLES;
        double r = (double)pond_shore(&pond, site.seed, (float)sin(angle), (float)cos(angle));
        outline += 0.5 * r * r * 6.283185307179586 / ANGLES;
        least = fmin(least, r);
        most = fmax(most, r);
    }
    assert_true(most > 1.25 * least && least >= 0.4 * 3.0 && most <= 1.6 * 3.0);
    double area, volume;
    sum_water(&land, &area, &volume);
    assert_true(fabs(area / outline - 1.0) < 0.01);
    assert_true(fabs(volume / (outline * 0.8 * (0.175 + 0.65 / 3.0)) - 1.0) < 0.01);
}

static void banks_hold_the_water(void **state)
{
    (void)state;
    for (int n = 0; n < 12; n++) {
        Pond pond = pond_at(-30.0f + 7.0f * (float)n, 5.0f * (float)n, 0.7f);
        GroundParams land = land_with(&pond);
        land.relief = 40.0f; // steep: the lower side needs a dam
        PondSite site = ground_pond(&land, SEED, 0);
        for (int i = 0; i < 360; i++) {
            float angle = 0.0174532925f * (float)i, sine = sinf(angle), cosine = cosf(angle);
            float shore = pond_shore(&pond, site.seed, sine, cosine);
            for (int k = 0; k < 7; k++) {
                float r = shore * (1.02f + 0.04f * (float)k);
                float h = ground_height(&land, SEED, pond.position[0] + r * sine,
                                        pond.position[1] + r * cosine);
                assert_true(h > site.level);
            }
        }
    }
}

static const Part *part_of(const Geometry *geometry, int role, int number)
{
    for (int64_t i = 0; i < geometry->count; i++) {
        if (geometry->part[i].material == role && number-- == 0) {
            return &geometry->part[i];
        }
    }
    fail_msg("no part of role %d", role);
    return NULL;
}

static void the_coarse_land_is_below(const GroundParams *land, const Mesh *mesh)
{
    PondSite site = ground_pond(land, SEED, 0);
    Cover *cover = cover_new(NULL);
    assert_true(cover && cover_add(cover, mesh, NULL) && cover_finish(cover, NULL));
    float reach = pond_reach(site.pond);
    for (int i = 0; i < 100; i++) {
        for (int k = 0; k < 100; k++) {
            float dx = reach * (0.02f * (float)i - 1.0f), dz = reach * (0.02f * (float)k - 1.0f);
            if (hypotf(dx, dz) < reach) {
                float x = site.pond->position[0] + dx, z = site.pond->position[1] + dz;
                float h = ground_height(land, SEED, x, z);
                assert_false(cover_hides(cover, vec3(x, h - 0.05f, z)));
            }
        }
    }
    cover_free(cover);
}

// Near, where the land's cells are small, and far away, where they are larger than the pond.
static void water_is_level_and_the_bed_is_the_ground(void **state)
{
    (void)state;
    static const float places[] = {0.0f, 14.0f, 300.0f};
    for (int n = 0; n < 3; n++) {
        Pond pond = pond_at(places[n], -places[n], 0.7f);
        GroundParams land = land_with(&pond);
        PondSite site = ground_pond(&land, SEED, 0);
        Run run = run_default();
        Recipe recipe = {.seed = SEED, .run = &run};
        Geometry geometry = {0};
        Placing placing = placing_in(&geometry, &recipe);
        assert_true(ground_geometry(&land, NULL, &placing, NULL));
        const Mesh *water = part_of(&geometry, GROUND_WATER, 0)->mesh;
        for (int64_t i = 0; i < water->vertex_count; i++) {
            Vec3 p = water->position[i];
            assert_true(p.y == site.level && water->normal[i].y == 1.0f);
            bool middle = i + 1 == water->vertex_count; // the others are under the bank
            assert_true((ground_height(&land, SEED, p.x, p.z) < p.y) == middle);
        }
        const Mesh *bed = part_of(&geometry, GROUND_BED, 0)->mesh;
        Aabb box = mesh_bounds(bed);
        for (int64_t i = 0; i < bed->vertex_count; i++) {
            Vec3 p = bed->position[i];
            assert_true(p.y == ground_height(&land, SEED, p.x, p.z) && bed->normal[i].y > 0.2f);
        }
        assert_true(fabsf(site.level - box.low.y - 0.8f) < 1e-4f && box.high.y > site.level);
        the_coarse_land_is_below(&land, part_of(&geometry, GROUND_LAND, 0)->mesh);
        geometry_clear(&geometry);
    }
}

// ---- scenes

#define POND "ponds: [{position: [3, -2], radius: 7, irregularity: 0.6}], "
#define LAND(PONDS)                                                                             \
    "seed: 3\nobjects:\n  - name: land\n    seed: 7\n    ground: {" PONDS                       \
    "grass_tufts: 4000, grass_radius: 20, fallen_leaves: 400, fallen_radius: 15, snow: 0.1, "   \
    "trees: {count: 40, inner: 0, outer: 25, clumping: 0, variants: 1, bare: true, species: "   \
    "[{tree: {species: hazel, height: 4, light: {seasons: 8}}}]}}\n"                            \
    "  - name: wood\n    forest: {height: 5, stand_trees: 2, stands: 1, radius: 20, glade: 0, " \
    "ferns: 200, fern_radius: 20, leaves: {max_count: 50}}\n"                                   \
    "  - name: stones\n    scatter: {count: 200, radius: 15, clumping: 0, things: [{stone: "    \
    "{resolution: 4}}]}\n"
#define IN_WATER                                                                             \
    "seed: 3\nobjects:\n  - name: land\n    seed: 7\n    ground: {" POND "grass_tufts: 0}\n" \
    "  - name: stones\n    scatter: {count: 100, radius: 15, clumping: 0, in_water: true, "  \
    "things: "                                                                               \
    "[{stone: {resolution: 4}}]}\n"

static World *build(const char *text, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Scene *scene = scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e);
    World *world = scene ? scene_build(scene, &run, NULL, &e) : NULL;
    if (!world) {
        fail_msg("%s", e.message);
    }
    scene_free(scene);
    return world;
}

// Counts the copies of each object and those that stand in the pond, by the outline alone.
static void count(const char *text, int all[3], int wet[3])
{
    Pond pond = pond_at(3.0f, -2.0f, 0.6f);
    pond.radius = 7.0f;
    GroundParams land = land_with(&pond);
    uint64_t seed = ground_pond(&land, SEED, 0).seed;
    World *world = build(text, 1);
    for (int i = 0; i < 3; i++) {
        all[i] = wet[i] = 0;
    }
    for (int64_t p = 0; p < world->geometry.count; p++) {
        const Part *part = &world->geometry.part[p];
        for (int64_t i = 0; i < part->instance_count; i++) {
            Vec3 foot = transform_point(&part->instance[i], vec3(0, 0, 0));
            all[part->object]++;
            wet[part->object] += pond_share(&pond, seed, foot.x, foot.z) < 0.999f;
        }
    }
    world_free(world);
}

static void nothing_stands_in_the_water(void **state)
{
    (void)state;
    int all[3], wet[3], all_dry[3], without[3];
    count(LAND(POND), all, wet);
    count(LAND(""), all_dry, without);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(wet[i], 0);
        assert_true(without[i] > 20); // it would, were there no pond
        assert_true(all[i] > all_dry[i] / 2);
    }
    count(IN_WATER, all, wet);
    assert_int_equal(all[1], 100);
    assert_int_equal(wet[1], 100);
}

static void the_bits_are_the_same_on_any_number_of_threads(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int i = 0; i < 2; i++) {
        World *world = build(LAND(POND), 1 + 2 * i);
        hash[i] = geometry_hash(&world->geometry);
        world_free(world);
    }
    assert_true(hash[0] == hash[1]);
}

static void errors_name_the_key(void **state)
{
    (void)state;
    static const struct {
        const char *ponds, *message;
    } wrong[] = {
        {"[{position: [0, 0], radius: -1}]", "radius"},
        {"[{position: [0, 0], depth: 0}]", "depth"},
        {"[{position: [0, 0], bank: 0}]", "bank"},
        {"[{position: [0, 0], irregularity: 1.5}]", "irregularity"},
        {"[{position: [0, 0, 0]}]", "position"},
        {"[{position: [0, 1990]}]", "pond 0 needs"},
        {"[{position: [0, 0]}, {position: [60, 0]}, {position: [8, 0]}]", "ponds 0 and 2 are 8 m"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char text[512];
        Error e = {0};
        snprintf(text, sizeof text, "objects:\n  - name: a\n    ground: {ponds: %s}\n",
                 wrong[i].ponds);
        assert_null(scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e));
        assert_non_null(strstr(e.message, wrong[i].message));
        assert_int_equal(e.line, 3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_round_basin_has_the_volume_of_its_formula),
        cmocka_unit_test(a_ragged_basin_has_the_area_of_its_outline),
        cmocka_unit_test(banks_hold_the_water),
        cmocka_unit_test(water_is_level_and_the_bed_is_the_ground),
        cmocka_unit_test(nothing_stands_in_the_water),
        cmocka_unit_test(the_bits_are_the_same_on_any_number_of_threads),
        cmocka_unit_test(errors_name_the_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
