// A leaf's colours by its season: those of the material when it is grown, the autumn colour when it
// has turned, from the edge inward; light is never made of nothing.
#include "render/material/pattern.h"
#include "testing.h"

static Material leaf(void)
{
    Material m = material_default(MATERIAL_LEAF);
    m.pattern = PATTERN_NONE;
    m.variation = 0.0f;
    m.autumn_color = vec3(0.4f, 0.2f, 0.03f);
    return m;
}

static PatternShade shade_at(const Material *m, float season, float u, float variation)
{
    SurfacePoint point = {.uv = {u, 0.5f},
                          .season = season,
                          .variation = variation,
                          .normal = {0, 0, 1},
                          .tangent_u = {1, 0, 0},
                          .tangent_v = {0, 1, 0}};
    PatternShade shade = {m->color, m->transmittance, point.normal, 0.0f, m->roughness};
    pattern_apply(m, &point, &shade);
    return shade;
}

static void a_grown_leaf_has_its_own_colour_and_a_turned_one_the_autumns(void **state)
{
    (void)state;
    Material m = leaf();
    for (float u = 0.05f; u < 1.0f; u += 0.1f) {
        PatternShade grown = shade_at(&m, 0.0f, u, 0.1f), turned = shade_at(&m, 1.0f, u, 0.1f);
        assert_memory_equal(&grown.color, &m.color, sizeof m.color);
        assert_memory_equal(&grown.transmittance, &m.transmittance, sizeof m.color);
        assert_float_equal(turned.color.x, m.autumn_color.x, 1e-6f);
        assert_float_equal(turned.color.y, m.autumn_color.y, 1e-6f);
        assert_true(turned.transmittance.x > turned.transmittance.z);
    }
}

// Redness grows with the season everywhere, and at the edge before the midrib.
static void leaves_turn_from_the_edge(void **state)
{
    (void)state;
    Material m = leaf();
    float edge = 0.0f, middle = 0.0f;
    for (int v = 0; v < 20; v++) {
        float variation = 0.0142f * (float)v; // not dry yet
        for (float u = 0.0f; u <= 1.0f; u += 0.25f) {
            float before = -1.0f;
            for (float season = 0.0f; season <= 1.0f; season += 0.05f) {
                float red = shade_at(&m, season, u, variation).color.x;
                assert_true(red >= before - 1e-6f);
                before = red;
            }
        }
        edge += shade_at(&m, 0.35f, 0.02f, variation).color.x;
        middle += shade_at(&m, 0.35f, 0.5f, variation).color.x;
    }
    assert_true(edge > middle * 1.2f);
}

static void young_leaves_are_paler_and_let_more_light_through(void **state)
{
    (void)state;
    Material m = leaf();
    PatternShade young = shade_at(&m, -1.0f, 0.3f, 0.5f), grown = shade_at(&m, 0.0f, 0.3f, 0.5f);
    assert_true(young.color.x > grown.color.x && young.color.y > grown.color.y);
    assert_true(young.transmittance.y > grown.transmittance.y);
    // No more leaves than falls in.
    assert_true(young.color.y + young.transmittance.y < 1.0f);
    PatternShade turned = shade_at(&m, 1.0f, 0.3f, 0.1f);
    assert_true(turned.color.x + turned.transmittance.x < 1.0f);
}

// A species whose young leaves are reddish: they have its colour, and the grown ones theirs.
static void young_leaves_may_have_a_colour_of_their_own(void **state)
{
    (void)state;
    Material m = leaf();
    m.young_color = vec3(0.3f, 0.12f, 0.06f);
    PatternShade young = shade_at(&m, -1.0f, 0.3f, 0.5f), grown = shade_at(&m, 0.0f, 0.3f, 0.5f);
    assert_float_equal(young.color.x, 0.3f, 1e-6f);
    assert_float_equal(young.color.y, 0.12f, 1e-6f);
    assert_true(young.transmittance.x > 2.0f * young.transmittance.y);
    assert_true(young.color.x + young.transmittance.x < 1.0f);
    assert_memory_equal(&grown.color, &m.color, sizeof m.color);
    PatternShade half = shade_at(&m, -0.5f, 0.3f, 0.5f);
    assert_true(half.color.x > grown.color.x && half.color.x < young.color.x);
}

static PatternShade withered_at(const Material *m, float withered)
{
    SurfacePoint point = {.uv = {0.3f, 0.5f},
                          .variation = 0.5f,
                          .withered = withered,
                          .normal = {0, 0, 1},
                          .tangent_u = {1, 0, 0},
                          .tangent_v = {0, 1, 0}};
    PatternShade shade = {m->color, m->transmittance, point.normal, 0.0f, m->roughness};
    pattern_apply(m, &point, &shade);
    return shade;
}

// Green, then yellow, then brown and dark, then dry and paler again; never more light than came.
static void a_leaf_withers_from_green_over_yellow_and_brown_to_straw(void **state)
{
    (void)state;
    Material m = leaf();
    PatternShade green = withered_at(&m, 0.0f), yellow = withered_at(&m, 0.45f);
    PatternShade brown = withered_at(&m, 0.7f), straw = withered_at(&m, 1.0f);
    assert_memory_equal(&green.color, &m.color, sizeof m.color);
    assert_true(green.transmittance.x < green.transmittance.y);
    assert_true(yellow.transmittance.x >= yellow.transmittance.y);
    assert_true(yellow.color.x > 0.9f * yellow.color.y && yellow.color.z < 0.4f * yellow.color.y);
    assert_true(brown.transmittance.y < 0.3f * yellow.transmittance.y);
    assert_true(brown.color.x > brown.color.y && brown.color.y > brown.color.z);
    assert_true(straw.color.y > 2.0f * brown.color.y);
    assert_true(straw.transmittance.x > straw.transmittance.y);
    for (float w = 0.0f; w <= 1.0f; w += 0.05f) {
        PatternShade shade = withered_at(&m, w);
        assert_true(shade.color.x + shade.transmittance.x < 1.0f);
        assert_true(shade.color.y + shade.transmittance.y < 1.0f);
    }
}

// A material may say what is left without green; tissue that dies turns brown all the same.
static void a_leaf_may_fade_to_a_colour_of_its_own(void **state)
{
    (void)state;
    Material m = leaf();
    PatternShade plain = withered_at(&m, 1.0f);
    m.faded_color = vec3(0.5f, 0.3f, 0.04f);
    PatternShade green = withered_at(&m, 0.0f), yellow = withered_at(&m, 0.45f);
    assert_memory_equal(&green.color, &m.color, sizeof m.color);
    assert_float_equal(yellow.color.x, 0.5f, 1e-6f);
    assert_float_equal(yellow.color.y, 0.3f, 1e-6f);
    assert_float_equal(yellow.transmittance.x, 0.425f, 1e-6f);
    assert_float_equal(yellow.transmittance.z, 0.034f, 1e-6f);
    PatternShade half = withered_at(&m, 0.2f), straw = withered_at(&m, 1.0f);
    assert_true(half.color.x > green.color.x && half.color.x < yellow.color.x);
    assert_float_equal(straw.color.x, plain.color.x, 1e-6f);
}

// Bark and others have no season.
static void only_leaves_have_a_season(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_DIFFUSE);
    PatternShade shade = shade_at(&m, 1.0f, 0.1f, 0.9f);
    assert_memory_equal(&shade.color, &m.color, sizeof m.color);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_grown_leaf_has_its_own_colour_and_a_turned_one_the_autumns),
        cmocka_unit_test(leaves_turn_from_the_edge),
        cmocka_unit_test(young_leaves_are_paler_and_let_more_light_through),
        cmocka_unit_test(young_leaves_may_have_a_colour_of_their_own),
        cmocka_unit_test(a_leaf_withers_from_green_over_yellow_and_brown_to_straw),
        cmocka_unit_test(a_leaf_may_fade_to_a_colour_of_its_own),
        cmocka_unit_test(only_leaves_have_a_season),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
