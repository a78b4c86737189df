// Landforms: what each promises, on several seeds.
#include "land/height_drainage.h"
#include "making.h"
#include "objects/terrain/terrain.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static TerrainParams landform(TerrainForm form)
{
    TerrainParams params = terrain_params_default();
    params.form = form;
    params.size = form == TERRAIN_CANYON ? 10000.0f : 8000.0f;
    params.resolution = 256;
    return params;
}

static HeightField *heights(const TerrainParams *params, uint64_t seed, int threads,
                            MeasureList *list)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Recipe recipe = {.seed = seed, .label = "land", .run = &run};
    Grown grown;
    HeightField *field = NULL;
    if (kind_grow(&kind_terrain, params, &recipe, 1.0f, NULL, &grown, &e)) {
        field = terrain_heights(params, &grown, &run, &e);
    }
    if (!field || (list && !terrain_measure(params, &grown, &recipe, list, &e))) {
        fail_msg("%s", e.message);
    }
    grown_clear(&grown);
    return field;
}

static void within(const MeasureList *list, const char *name, double low, double high)
{
    const Measure *measure = measures_find(list, name);
    assert_non_null(measure);
    if (!(measure->value >= low && measure->value <= high)) {
        fail_msg("%s is %g; %g to %g were promised", name, measure->value, low, high);
    }
}

static void a_canyon_is_as_deep_and_wide_as_asked(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        TerrainParams params = landform(TERRAIN_CANYON);
        params.canyon.width = seed == 3 ? 3500.0f : 5400.0f;
        params.relief = seed == 2 ? 600.0f : 900.0f;
        MeasureList list = {0};
        height_field_free(heights(&params, seed, 1, &list));
        double depth = (double)params.relief, width = (double)params.canyon.width;
        within(&list, "incision", 0.9 * depth, 1.15 * depth);
        within(&list, "canyon_width", 0.6 * width, 1.35 * width);
        within(&list, "sinuosity", 1.15, 1.7);
        within(&list, "cliff_share", 0.12, 0.5);
        within(&list, "talus_slope", 25.0, 43.0);
        measures_clear(&list);
    }
}

static void mesas_remain(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        TerrainParams params = landform(TERRAIN_MESAS);
        MeasureList list = {0};
        HeightField *field = heights(&params, seed, 1, &list);
        float low, high;
        height_field_range(field, &low, &high);
        assert_true(high - low > 0.85f * 320.0f && high - low < 1.3f * 320.0f);
        // Most of the land is plain, some is mesa, and little is between.
        int64_t plain = 0, mesa = 0, count = height_field_count(field);
        for (int64_t i = 0; i < count; i++) {
            plain += field->height[i] < low + 0.3f * (high - low);
            mesa += field->height[i] > low + 0.7f * (high - low);
        }
        assert_true(plain > 6 * count / 10 && mesa > count / 100 && mesa < 3 * count / 10);
        assert_true(count - plain - mesa < count / 5);
        height_field_free(field);
        measures_clear(&list);
    }
}

static void the_same_bits_for_any_threads(void **state)
{
    (void)state;
    const TerrainForm forms[] = {TERRAIN_CANYON, TERRAIN_MESAS};
    for (int i = 0; i < 2; i++) {
        TerrainParams params = landform(forms[i]);
        params.resolution = 64;
        HeightField *one = heights(&params, 5, 1, NULL), *three = heights(&params, 5, 3, NULL);
        assert_true(height_field_hash(one) == height_field_hash(three));
        height_field_free(one);
        height_field_free(three);
    }
}

// Beyond the processes' own grid, more samples only interpolate: the same land.
static void more_resolution_shows_the_same_land(void **state)
{
    (void)state;
    TerrainParams coarse = landform(TERRAIN_CANYON), fine = coarse;
    coarse.canyon.river = fine.canyon.river = 0.0f; // its bed is as exact as the grid
    coarse.resolution = coarse.evolution.cells = fine.evolution.cells = 128;
    fine.resolution = 256;
    HeightField *a = heights(&coarse, 1, 1, NULL), *b = heights(&fine, 1, 1, NULL);
    for (int row = 0; row < a->rows; row++) {
        for (int column = 0; column < a->columns; column++) {
            float twice = b->height[2 * (int64_t)row * b->columns + 2 * column];
            assert_float_equal(a->height[(int64_t)row * a->columns + column], twice, 0.5f);
        }
    }
    height_field_free(a);
    height_field_free(b);
}

// What things stand on beyond the square is what is drawn there, the nearest first.
static void lists_where_it_is_copied(const TerrainParams *params, const Part *around)
{
    SurfaceCopy copy[24];
    assert_int_equal(kind_terrain.surface_copies(params, NULL), 8);
    assert_int_equal(kind_terrain.surface_copies(params, copy), 8);
    for (int i = 0; i < 8; i++) {
        int same = 0;
        for (int k = 0; k < 8; k++) {
            same += memcmp(&copy[i].place, &around->instance[k], sizeof(Transform)) == 0;
        }
        assert_int_equal(same, 1);
        assert_int_equal(copy[i].ring, 1);
    }
    TerrainParams more = *params;
    more.beyond = 2;
    assert_int_equal(kind_terrain.surface_copies(&more, copy), 24);
    for (int i = 0; i < 24; i++) {
        assert_int_equal(copy[i].ring, i < 8 ? 1 : 2);
        assert_false(copy[i].in_mesh);
    }
    // Tiles go on over the copies, but not beyond a coast's square.
    more.tiles = (TerrainTileParams){.count = 4, .cells = 64, .drawn = true};
    assert_int_equal(kind_terrain.surface_copies(&more, copy), 24);
    assert_true(copy[0].in_mesh && copy[23].in_mesh);
    more.form = TERRAIN_COAST;
    assert_int_equal(kind_terrain.surface_copies(&more, copy), 2 * 5 - 1);
    assert_false(copy[0].in_mesh);
    more.tiles.drawn = false;
    more.form = TERRAIN_COAST; // along the shore and inland alone
    assert_int_equal(kind_terrain.surface_copies(&more, NULL), 2 * 5 - 1);
    more.form = TERRAIN_DELTA;
    assert_int_equal(kind_terrain.surface_copies(&more, NULL), 0);
}

// Copies around the square meet at its borders: a mirrored copy has its border's points.
static void copies_continue_the_land(void **state)
{
    (void)state;
    TerrainParams params = landform(TERRAIN_MESAS);
    params.resolution = 64;
    params.beyond = 1;
    params.position = vec3(700, 50, -300);
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 2, .label = "land", .run = &run};
    Grown grown;
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    assert_true(kind_grow(&kind_terrain, &params, &recipe, 1.0f, NULL, &grown, &e));
    assert_true(terrain_geometry(&params, &grown, &placing, &e));
    const Part *around = NULL;
    for (int64_t i = 0; i < geometry.count; i++) {
        around = geometry.part[i].instance_count == 8 ? &geometry.part[i] : around;
    }
    assert_non_null(around);
    assert_non_null(around->mesh->strata);
    float east = 700.0f + 4000.0f;
    int met = 0;
    for (int64_t i = 0; i < around->instance_count; i++) {
        for (int64_t v = 0; v < around->mesh->vertex_count; v++) {
            Vec3 p = around->mesh->position[v], q = transform_point(&around->instance[i], p);
            bool beside = fabsf(around->instance[i].m[0][3] - 2.0f * east) < 1.0f &&
                          fabsf(around->instance[i].m[2][3]) < 1.0f;
            if (beside && p.x == east) {
                assert_true(vec3_distance(p, q) < 0.01f);
                met++;
            }
            // Nothing lies over the square itself.
            assert_true(fabsf(q.x - 700.0f) > 3999.9f || fabsf(q.z + 300.0f) > 3999.9f);
        }
    }
    assert_true(met > 2);
    lists_where_it_is_copied(&params, around);
    geometry_clear(&geometry);
    grown_clear(&grown);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_canyon_is_as_deep_and_wide_as_asked),
        cmocka_unit_test(mesas_remain),
        cmocka_unit_test(the_same_bits_for_any_threads),
        cmocka_unit_test(more_resolution_shows_the_same_land),
        cmocka_unit_test(copies_continue_the_land),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
