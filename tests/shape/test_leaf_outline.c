// Outlines of leaves: the margin with its teeth about the smooth curve.
#include "testing.h"

#include "shape/leaf_outline.h"

#include <math.h>

static LeafOutline plain(void)
{
    return (LeafOutline){.length = 0.1f, .width = 0.05f, .widest = 0.45f, .tip = 1.6f, .key = 9};
}

static LeafOutline toothed(void)
{
    LeafOutline outline = plain();
    outline.teeth = 40;
    outline.tooth_depth = 0.0012f;
    return outline;
}

static void an_entire_margin_is_the_smooth_curve(void **state)
{
    (void)state;
    LeafOutline outline = plain();
    assert_false(leaf_has_margin(&outline));
    for (int i = 0; i <= 1000; i++) {
        float y = 1e-4f * (float)i;
        assert_true(leaf_margin(&outline, 1.0f, y) == leaf_half_width(&outline, y));
        assert_true(leaf_margin(&outline, -1.0f, y) == leaf_half_width(&outline, y));
    }
}

enum { STEPS = 4000 };

// Points of teeth between shares of the length, and the share of the way on which the margin goes
// out from the midrib more than the smooth curve does.
static int count_points(const LeafOutline *outline, float side, float *rising)
{
    int points = 0, up = 0;
    float step = outline->length / STEPS;
    for (int i = 1; i < STEPS * 97 / 100; i++) { // the last one has faded away
        float y = step * (float)i, offset[3];
        for (int k = 0; k < 3; k++) {
            float at = y + step * (float)(k - 1);
            offset[k] = leaf_margin(outline, side, at) - leaf_half_width(outline, at);
        }
        points += offset[1] > offset[0] && offset[1] >= offset[2];
        up += offset[1] > offset[0];
    }
    *rising = (float)up / STEPS;
    return points;
}

// Saw teeth rise on three quarters of their length, scallops on half; those at the base and the tip
// fade away.
static void teeth_are_as_many_and_as_deep_as_asked_for(void **state)
{
    (void)state;
    LeafOutline outline = toothed();
    float rising;
    int points = count_points(&outline, 1.0f, &rising);
    assert_in_range(points, outline.teeth - 2, outline.teeth);
    assert_true(rising > 0.62f && rising < 0.78f);
    outline.tooth_round = 1.0f;
    points = count_points(&outline, -1.0f, &rising);
    assert_in_range(points, outline.teeth - 2, outline.teeth);
    assert_true(rising > 0.38f && rising < 0.54f);
    float low = INFINITY, high = -INFINITY;
    for (float y = 0.3f * outline.length; y < 0.6f * outline.length; y += 1e-5f) {
        float offset = leaf_margin(&outline, 1.0f, y) - leaf_half_width(&outline, y);
        low = fminf(low, offset), high = fmaxf(high, offset);
    }
    assert_float_equal(high - low, outline.tooth_depth, 0.03f * outline.tooth_depth);
    assert_float_equal(high + low, 0.0f, 0.03f * outline.tooth_depth);
    outline.tooth_round = 0.0f;
    outline.double_teeth = true;
    assert_true(count_points(&outline, 1.0f, &rising) > 2 * outline.teeth);
}

static void points_of_teeth_lie_on_the_margin_and_stand_out(void **state)
{
    (void)state;
    LeafOutline outline = toothed();
    outline.uneven = 0.8f;
    float before = 0.0f;
    for (int i = 4; i < outline.teeth - 2; i++) {
        for (float side = -1.0f; side <= 1.0f; side += 2.0f) {
            Vec3 p = leaf_tooth(&outline, side, i);
            float smooth = leaf_half_width(&outline, p.y);
            assert_float_equal(side * p.x, leaf_margin(&outline, side, p.y), 1e-7f);
            float notch = fminf(leaf_margin(&outline, side, p.y + 0.0008f) -
                                    leaf_half_width(&outline, p.y + 0.0008f),
                                leaf_margin(&outline, side, p.y - 0.0015f) -
                                    leaf_half_width(&outline, p.y - 0.0015f));
            assert_true(side * p.x - smooth > notch + 0.0002f);
            assert_true(side < 0.0f || p.y > before);
            before = side > 0.0f ? p.y : before;
        }
    }
}

// The two sides differ, by their key alone, and the margin stays near the smooth curve whatever the
// depth is.
static void uneven_margins_stay_within_bounds(void **state)
{
    (void)state;
    LeafOutline outline = toothed(), other = toothed();
    outline.uneven = other.uneven = 1.0f;
    outline.tooth_depth = other.tooth_depth = 1.0f;
    other.key = 10;
    float sides = 0.0f, keys = 0.0f;
    for (int i = 1; i < 1000; i++) {
        float y = 1e-4f * (float)i, half = leaf_half_width(&outline, y);
        float right = leaf_margin(&outline, 1.0f, y), left = leaf_margin(&outline, -1.0f, y);
        assert_true(right > 0.666f * half && right < 1.334f * half);
        assert_true(left > 0.666f * half && left < 1.334f * half);
        sides += fabsf(right - left), keys += fabsf(right - leaf_margin(&other, 1.0f, y));
        assert_true(leaf_contains(&outline, 1.0f, vec3(0.999f * right, y, 0)));
        assert_false(leaf_contains(&outline, 1.0f, vec3(1.001f * right, y, 0)));
        assert_true(leaf_contains(&outline, 0.5f, vec3(-0.499f * left, 0.5f * y, 0)));
    }
    assert_true(sides > 0.01f && keys > 0.01f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_entire_margin_is_the_smooth_curve),
        cmocka_unit_test(teeth_are_as_many_and_as_deep_as_asked_for),
        cmocka_unit_test(points_of_teeth_lie_on_the_margin_and_stand_out),
        cmocka_unit_test(uneven_margins_stay_within_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
