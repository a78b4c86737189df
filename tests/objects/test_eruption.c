// Eruptions: bombs rise as high as drag lets them, and lava runs down, parts on ridges, and glows
// by its temperature.
#include "objects/eruption/eruption.h"

#include "base/memory.h"
#include "testing.h"

#include <math.h>

enum { SIDE = 129 };
static const float CELL = 20.0f; // m

static HeightField *land_of(float (*height)(float x, float z))
{
    Vec2 corner = {-0.5f * CELL * (SIDE - 1), -0.5f * CELL * (SIDE - 1)};
    HeightField *land = height_field_new(SIDE, SIDE, (Vec2){CELL, CELL}, corner, NULL);
    for (int i = 0; i < SIDE * SIDE; i++) {
        float x = corner.x + CELL * (float)(i % SIDE), z = corner.y + CELL * (float)(i / SIDE);
        land->height[i] = height(x, z);
    }
    return land;
}

static float level(float x, float z)
{
    (void)x;
    (void)z;
    return 100.0f;
}

// Falls toward +z; a ridge along it parts what comes, and a hollow lies in the way on one side.
static float ridge(float x, float z)
{
    float hollow = x > 0.0f ? 40.0f * expf(-0.5f * (z - 300.0f) * (z - 300.0f) / 2500.0f) : 0.0f;
    return 600.0f - 0.3f * z - 0.25f * fabsf(x) - hollow;
}

// With drag k v^2, what leaves at v comes ln(1 + k v^2 / g) / 2k high.
static void bombs_rise_as_high_as_drag_lets_them(void **state)
{
    (void)state;
    HeightField *land = land_of(level);
    EruptionParams p = eruption_params_default();
    p.spread = 0.0f;
    p.shutter = 1000.0f;
    p.bombs = 3000;
    p.speed = 100.0f;
    Trails trails = {0};
    assert_true(eruption_fly(&trails, &p, land, 5, NULL));
    double k = 0.0012, most = log(1.0 + k * 1e4 / 9.81) / (2.0 * k), highest = 0.0;
    for (int64_t i = 0; i < trails.count; i++) {
        double high = (double)trails.point[i].position.y - 102.0;
        highest = high > highest ? high : highest;
        assert_true(high > -3.0);
    }
    assert_true(highest > 0.93 * most && highest < 1.01 * most);
    trails_clear(&trails);
    height_field_free(land);
}

static void the_shutter_cuts_streaks(void **state)
{
    (void)state;
    HeightField *land = land_of(level);
    EruptionParams p = eruption_params_default();
    p.shutter = 2.0f;
    Trails trails = {0};
    assert_true(eruption_fly(&trails, &p, land, 5, NULL));
    int64_t longest = 0;
    for (int64_t k = 0; k < trails.trail_count; k++) {
        int64_t points = trails.first[k + 1] - trails.first[k];
        longest = points > longest ? points : longest;
    }
    assert_in_range(longest, 8, 10); // steps of 0.25 s
    trails_clear(&trails);
    height_field_free(land);
}

static void lava_runs_down_and_parts_on_a_ridge(void **state)
{
    (void)state;
    HeightField *land = land_of(ridge);
    LavaStream stream = {.at = {0.0f, -600.0f}, .width = 20.0f, .length = 1500.0f, .branches = 12};
    EruptionParams p = eruption_params_default();
    p.stream = &stream;
    p.stream_count = 1;
    Trails strands = {0}, crust = {0};
    assert_true(eruption_flow(&strands, &crust, &p, land, 3, NULL));
    int left = 0, right = 0;
    for (int64_t k = 0; k < crust.trail_count; k++) { // along whole branches
        const TrailPoint *a = &crust.point[crust.first[k]],
                         *b = &crust.point[crust.first[k + 1] - 1];
        assert_true(b->position.y < a->position.y - 80.0f);
        assert_true(b->position.z > (k < 7 ? 450.0f : -350.0f)); // the first runs past the hollow
        left += b->position.x < -100.0f;
        right += b->position.x > 100.0f;
        for (const TrailPoint *q = a; q < b; q++) {
            assert_true(q[1].position.y < q->position.y + 15.0f);
        }
    }
    assert_true(left > 0 && right > 0);
    assert_true(strands.count > 1000);
    trails_clear(&strands);
    trails_clear(&crust);
    height_field_free(land);
}

// Planck's law at 600 nm, in which exp(hc / (k T 600 nm)) is much greater than 1.
static void glow_follows_planck(void **state)
{
    (void)state;
    for (float kelvin = 900.0f; kelvin < 1450.0f; kelvin += 50.0f) {
        double c2 = 0.01438777 / 600e-9;
        double planck = (exp(c2 / 1400.0) - 1.0) / (exp(c2 / (double)kelvin) - 1.0);
        assert_true(fabs((double)eruption_glow(kelvin, 1400.0f) / planck - 1.0) < 1e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bombs_rise_as_high_as_drag_lets_them),
        cmocka_unit_test(the_shutter_cuts_streaks),
        cmocka_unit_test(lava_runs_down_and_parts_on_a_ridge),
        cmocka_unit_test(glow_follows_planck),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
