// Rock that breaks along joints (land/jointing.h): on a plane blocks have the form that their
// definition tells; gentle land keeps its bits; samples depend on what is near alone.
#include "base/memory.h"
#include "base/noise.h"
#include "land/jointing.h"
#include "making_terrain.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <string.h>

enum { CELLS = 128, KEY = 7 };
static const float CELL = 8.0f, STEEP = 1.7320508f; // 60 degrees

static HeightField *field_of(int cells, float cell, float corner)
{
    Error e = {0};
    HeightField *field =
        height_field_new(cells + 1, cells + 1, (Vec2){cell, cell}, (Vec2){corner, corner}, &e);
    assert_non_null(field);
    return field;
}

// A plane that rises by so much per metre along x and z.
static HeightField *plane(int cells, float cell, float corner, float x, float z)
{
    HeightField *field = field_of(cells, cell, corner);
    for (int64_t i = 0; i < height_field_count(field); i++) {
        float column = (float)(i % field->columns), row = (float)(i / field->columns);
        field->height[i] = x * (corner + column * cell) + z * (corner + row * cell);
    }
    return field;
}

// Straight joints to the north and to the east, and nothing but blocks of one size.
static JointingParams plain(void)
{
    return (JointingParams){.spacing = 96.0f,
                            .angle = 90.0f,
                            .scales = 1,
                            .bedding = 10.0f,
                            .slope = 42.0f,
                            .seed = KEY};
}

static void broken(HeightField *field, const JointingParams *params, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    if (!jointing_break(field, params, NULL, &run, &e)) {
        fail_msg("%s", e.message);
    }
}

static float rise(const HeightField *field, int64_t i, int64_t step)
{
    return (field->height[i + step] - field->height[i]) / field->cell.x;
}

static bool inside(const HeightField *field, int64_t i, int margin)
{
    int column = (int)(i % field->columns), row = (int)(i / field->columns);
    return column >= margin && row >= margin && column < field->columns - margin &&
           row < field->rows - margin;
}

static void gentle_land_keeps_its_bits(void **state)
{
    (void)state;
    JointingParams params = plain();
    params.scales = 3;
    params.facets = params.relief = params.gullies = 1.0f;
    params.throws = 20.0f;
    HeightField *field = plane(CELLS, CELL, -512.0f, 0.4f, 0.5f);
    HeightField *before = plane(CELLS, CELL, -512.0f, 0.4f, 0.5f);
    broken(field, &params, 2);
    assert_memory_equal(field->height, before->height,
                        sizeof(float) * (size_t)height_field_count(field));
    height_field_free(field);
    height_field_free(before);
}

// Each face follows one set, so that the land is level along it, and is as steep across it as the
// plane is there.
static void faces_of_a_plane_follow_one_set_or_the_other(void **state)
{
    (void)state;
    JointingParams params = plain();
    params.facets = 1.0f;
    const float x = 0.75f * STEEP, z = 0.661438f * STEEP;
    HeightField *field = plane(CELLS, CELL, -512.0f, x, z);
    broken(field, &params, 2);
    int64_t all = 0, of[2] = {0}, flat = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        if (!inside(field, i, 32)) { // blocks of the rim read clamped heights
            continue;
        }
        float dx = rise(field, i, 1), dz = rise(field, i, field->columns);
        all++;
        of[0] += fabsf(dx - x) < 0.01f && fabsf(dz) < 0.01f;
        of[1] += fabsf(dz - z) < 0.01f && fabsf(dx) < 0.01f;
        flat += fabsf(dx) < 0.01f && fabsf(dz) < 0.01f;
    }
    assert_true(of[0] + of[1] > 0.55 * (double)all); // the rest is at the blocks' borders
    assert_true(of[0] > 0.15 * (double)all && of[1] > 0.1 * (double)all);
    assert_int_equal(flat, 0);
    height_field_free(field);
}

// Blocks that are not turned are the plane, moved by a height of their own.
static void blocks_stand_out_by_no_more_than_they_may(void **state)
{
    (void)state;
    JointingParams params = plain();
    params.relief = 0.3f;
    HeightField *field = plane(CELLS, CELL, -512.0f, STEEP, 0.0f);
    HeightField *before = plane(CELLS, CELL, -512.0f, STEEP, 0.0f);
    broken(field, &params, 2);
    // Faces across x; a block and its one bed move by up to the relief in all.
    float most = params.relief * params.spacing * STEEP, least = 0.0f, largest = 0.0f;
    int64_t same = 0, all = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        if (!inside(field, i, 32)) {
            continue;
        }
        float out = field->height[i] - before->height[i];
        float next = field->height[i + 1] - before->height[i + 1];
        assert_true(fabsf(out) < most + 0.01f);
        least = fminf(least, out);
        largest = fmaxf(largest, out);
        same += fabsf(out - next) < 0.01f;
        all++;
    }
    assert_true(least < -0.4f * most && largest > 0.4f * most);
    assert_true(same > 0.65 * (double)all);
    height_field_free(field);
    height_field_free(before);
}

// Beds of one block that stand out differently leave level ledges between walls.
static void beds_leave_ledges(void **state)
{
    (void)state;
    JointingParams params = plain();
    params.relief = 0.4f;
    params.bedding = 0.3f;
    HeightField *field = plane(CELLS, CELL, -512.0f, STEEP, 0.0f);
    broken(field, &params, 2);
    int64_t level = 0, wall = 0, all = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        if (inside(field, i, 32)) {
            float dx = rise(field, i, 1);
            level += fabsf(dx) < 0.05f;
            wall += dx > 1.6f * STEEP;
            all++;
        }
    }
    assert_true(level > 0.05 * (double)all && wall > 0.05 * (double)all);
    height_field_free(field);
}

// A wall with bumps between a plain and a plateau.
static HeightField *wall(int cells, float corner)
{
    HeightField *field = field_of(cells, CELL, corner);
    for (int64_t i = 0; i < height_field_count(field); i++) {
        float x = corner + CELL * (float)(i % field->columns);
        float z = corner + CELL * (float)(i / field->columns);
        float bump = 9.0f * noise_plane(x / 200.0f, z / 200.0f, 3);
        field->height[i] = clampf(1.6f * (x + 0.4f * z) + 4.0f * bump, -250.0f, 300.0f) + bump;
    }
    return field;
}

static JointingParams rich(void)
{
    JointingParams params = plain();
    params.azimuth = 33.0f;
    params.angle = 78.0f;
    params.scales = 2;
    params.bends = 0.1f;
    params.facets = 0.8f;
    params.relief = params.gullies = 0.2f;
    params.bedding = 0.5f;
    params.throws = 8.0f;
    return params;
}

static void any_number_of_threads_makes_the_same_bits(void **state)
{
    (void)state;
    JointingParams params = rich();
    HeightField *one = wall(CELLS, -512.0f), *before = wall(CELLS, -512.0f);
    broken(one, &params, 1);
    size_t bytes = sizeof(float) * (size_t)height_field_count(one);
    assert_memory_not_equal(one->height, before->height, bytes);
    for (int threads = 2; threads <= 5; threads += 3) {
        HeightField *field = wall(CELLS, -512.0f);
        broken(field, &params, threads);
        assert_memory_equal(one->height, field->height, bytes);
        height_field_free(field);
    }
    height_field_free(one);
    height_field_free(before);
}

// A window with a margin of its reach knows all that it depends on.
static void a_window_matches_the_whole(void **state)
{
    (void)state;
    JointingParams params = rich();
    params.spacing = 40.0f;
    int margin = (int)(jointing_reach(&params) / CELL) + 1, cells = 2 * margin + 16;
    HeightField *part = wall(cells, -(float)(cells / 2) * CELL);
    HeightField *whole = wall(2 * cells, -(float)cells * CELL);
    broken(part, &params, 2);
    broken(whole, &params, 2);
    for (int row = margin; row <= cells - margin; row++) {
        int64_t from = (int64_t)row * part->columns + margin;
        int64_t to = (int64_t)(row + cells / 2) * whole->columns + margin + cells / 2;
        assert_memory_equal(part->height + from, whole->height + to,
                            sizeof(float) * (size_t)(cells - 2 * margin + 1));
    }
    height_field_free(part);
    height_field_free(whole);
}

// Scree that fills the foot of a wall stays, but where rock comes to stand out of it.
static void scree_stays(void **state)
{
    (void)state;
    Error e = {0};
    JointingParams params = rich();
    HeightField *field = wall(CELLS, -512.0f), *before = wall(CELLS, -512.0f);
    field->loose = memory_alloc_zero(height_field_count(field), sizeof(float), &e);
    for (int64_t i = 0; i < height_field_count(field); i++) {
        float scree = -150.0f + 0.02f * (float)(i % field->columns) - field->height[i];
        field->loose[i] = fmaxf(scree, 0.0f);
        field->height[i] += field->loose[i];
        before->height[i] = field->height[i];
    }
    broken(field, &params, 2);
    int64_t kept = 0, all = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        if (before->height[i] < -149.0f && inside(field, i, 1)) {
            all++;
            kept += field->height[i] == before->height[i];
            assert_true(field->loose[i] >= 0.0f && field->height[i] > before->height[i] - 60.0f);
        }
    }
    assert_true(all > 1000 && kept > 0.9 * (double)all);
    height_field_free(field);
    height_field_free(before);
}

// The key reaches the land, before its lakes are filled: all stand level at their outlets.
static void lakes_lie_on_broken_land(void **state)
{
    (void)state;
    TerrainParams params = terrain_params_default();
    params.resolution = 128;
    params.size = 3000.0f;
    params.relief = 1500.0f;
    params.lakes =
        (TerrainLakeParams){.count = 20, .basins = 4, .deepness = 1.0f, .altitude = {0.0f, 1.0f}};
    HeightField *whole = make_heights(&params, KEY, 1, NULL, NULL);
    params.joints.spacing = 250.0f;
    Grown kept;
    HeightField *one = make_heights(&params, KEY, 1, NULL, &kept);
    HeightField *three = make_heights(&params, KEY, 3, NULL, NULL);
    size_t bytes = sizeof(float) * (size_t)height_field_count(one);
    assert_memory_equal(one->height, three->height, bytes);
    assert_memory_not_equal(one->height, whole->height, bytes);
    const Lakes *lakes = ((const Terrain *)kept.state)->lakes;
    assert_true(lakes->count > 0);
    LakeLimits all = {0};
    Error e = {0};
    Lakes *found = lakes_find(one, &all, &e);
    assert_non_null(found);
    for (int i = 0; i < lakes->count; i++) {
        int32_t label = found->label[lakes->lake[i].outlet], level = 0;
        for (int k = 0; k < found->count; k++) {
            level += fabsf(found->lake[k].level - lakes->lake[i].level) < 1e-3f;
        }
        assert_true(label < 0 && level > 0);
    }
    lakes_free(found);
    grown_clear(&kept);
    height_field_free(whole);
    height_field_free(one);
    height_field_free(three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gentle_land_keeps_its_bits),
        cmocka_unit_test(faces_of_a_plane_follow_one_set_or_the_other),
        cmocka_unit_test(blocks_stand_out_by_no_more_than_they_may),
        cmocka_unit_test(beds_leave_ledges),
        cmocka_unit_test(any_number_of_threads_makes_the_same_bits),
        cmocka_unit_test(a_window_matches_the_whole),
        cmocka_unit_test(scree_stays),
        cmocka_unit_test(lakes_lie_on_broken_land),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
