// The colours and bumps of weathered wood.
#include "render/material/pattern.h"

#include "base/random.h"
#include "mesh/wood.h"
#include "testing.h"

#include <math.h>

enum { PLACES = 3000 };

static Material wood(void)
{
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_WOOD;
    m.color = vec3_splat(0.4f);
    m.color2 = vec3_splat(0.1f);
    m.pattern_depth = 0.003f;
    return m;
}

static SurfacePoint on_stem(uint64_t i, float footprint)
{
    float angle = random_range(random_key(31, i), -PI_F, PI_F);
    Vec3 side = vec3(sinf(angle), 0.0f, cosf(angle));
    Vec3 p = vec3(0.05f * side.x, random_range(random_key(32, i), 0.0f, 1.5f), 0.05f * side.z);
    return (SurfacePoint){.position = p,
                          .object_position = p,
                          .normal = side,
                          .geometric_normal = side,
                          .footprint = footprint};
}

static PatternShade shade_at(const Material *m, const SurfacePoint *point)
{
    PatternShade shade = {.color = m->color, .normal = point->normal};
    pattern_apply(m, point, &shade);
    return shade;
}

static void checks_are_dark_and_the_rest_between_both_colours(void **state)
{
    (void)state;
    Material m = wood();
    double sum = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint point = on_stem(i, 0.0003f);
        float c = shade_at(&m, &point).color.x, check = wood_place(point.object_position).check;
        assert_true(check < 0.6f || c < 0.1f);
        assert_true(check > 0.0f || (c >= 0.0999f && c <= 0.4001f));
        sum += (double)c / PLACES;
    }
    assert_true(sum > 0.18 && sum < 0.35);
}

// Fibres turn the normal around the stem, hardly along it, and fade where a pixel is wider.
static void bumps_run_along_the_fibres(void **state)
{
    (void)state;
    Material m = wood();
    double around = 0.0, along = 0.0, far = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint near_point = on_stem(i, 0.0003f), far_point = on_stem(i, 0.02f);
        Vec3 n = shade_at(&m, &near_point).normal, side = near_point.normal;
        assert_true(vec3_dot(n, side) > 0.0f);
        around += fabs((double)vec3_dot(n, vec3(side.z, 0.0f, -side.x)));
        along += fabs((double)n.y);
        far += (double)vec3_distance(shade_at(&m, &far_point).normal, side);
    }
    assert_true(around > 4.0 * along && around > 0.1 * PLACES);
    assert_true(far < 0.02 * around);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checks_are_dark_and_the_rest_between_both_colours),
        cmocka_unit_test(bumps_run_along_the_fibres),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
