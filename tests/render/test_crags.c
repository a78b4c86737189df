// Blocks of rock faces: facets between steps, at every scale that a pixel shows.
#include "render/material/pattern_crags.h"

#include "base/random.h"
#include "render/material/pattern.h"
#include "render/material/relief.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { PLACES = 3000 };

static Vec3 random_point(uint64_t key)
{
    return vec3(random_range(random_key(key, 0), -300.0f, 300.0f),
                random_range(random_key(key, 1), -300.0f, 300.0f),
                random_range(random_key(key, 2), -300.0f, 300.0f));
}

static Crags crags_at(Vec3 p, float size, int scales, float footprint)
{
    SurfacePoint point = {.object_position = p, .footprint = footprint};
    CragsRock rock = {
        .size = size, .thick = 0.6f, .scales = scales, .up = vec3(0, 1, 0), .level = p.y};
    return pattern_crags(&point, &rock);
}

// The slope is the gradient of the height that displaces, but for a factor and for the bend of
// joints, which turns it a little.
static void slope_is_the_gradient_of_the_height(void **state)
{
    (void)state;
    const float size = 10.0f, h = 0.01f;
    double along = 0.0, found = 0.0, asked = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = random_point(i);
        Vec3 s = crags_at(p, size, 1, 1e-3f).slope, d;
        float *axis[3] = {&d.x, &d.y, &d.z};
        for (int k = 0; k < 3; k++) {
            Vec3 step = {k == 0 ? h : 0.0f, k == 1 ? h : 0.0f, k == 2 ? h : 0.0f};
            *axis[k] = (crags_at(vec3_add(p, step), size, 1, 1e-3f).height -
                        crags_at(vec3_sub(p, step), size, 1, 1e-3f).height) /
                       (2.0f * h);
        }
        along += (double)vec3_dot(s, d);
        found += (double)vec3_dot(d, d);
        asked += (double)vec3_dot(s, s);
    }
    assert_true(along / sqrt(found * asked) > 0.85);
}

// Within a block the slope stays the same: rock is flat between its edges, unlike noise.
static void blocks_are_flat(void **state)
{
    (void)state;
    const float size = 10.0f;
    int same = 0, dark = 0;
    float low = 0.0f, high = 0.0f;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = random_point(i);
        Crags a = crags_at(p, size, 1, 1e-3f);
        Crags b = crags_at(vec3_add(p, vec3(0.02f * size, 0.02f * size, 0.0f)), size, 1, 1e-3f);
        bool flat = a.tone == b.tone;
        same += flat && vec3_distance(a.slope, b.slope) < 0.02f;
        dark += a.crevice > 0.05f;
        low = fminf(low, a.height);
        high = fmaxf(high, a.height);
        assert_true(a.crevice >= 0.0f && a.crevice <= 1.0f);
        assert_true(a.ledge >= 0.0f && a.ledge <= 1.0f);
    }
    assert_true(same > 0.6 * PLACES);
    assert_true(dark > 0.05 * PLACES && dark < 0.5 * PLACES); // cracks and corners are narrow
    assert_true(high > 0.03f * size && high < 0.2f * size);
    assert_true(low < -0.03f * size && low > -0.2f * size);
}

// Footprints take scales away, the small ones first, and leave nothing when they are wider than
// the largest.
static void footprints_filter(void **state)
{
    (void)state;
    const float size = 10.0f;
    double fine = 0.0, coarse = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = random_point(i);
        Crags near = crags_at(p, size, CRAGS_MOST, 1e-3f),
              far = crags_at(p, size, CRAGS_MOST, 3.0f);
        Crags away = crags_at(p, size, CRAGS_MOST, size);
        fine += (double)vec3_dot(near.slope, near.slope);
        coarse += (double)vec3_dot(far.slope, far.slope);
        assert_true(vec3_length(away.slope) == 0.0f && away.height == 0.0f && away.tone == 0.0f);
        assert_true(away.crevice == 0.0f && away.ledge == 0.0f);
    }
    assert_true(coarse > 0.0 && coarse < 0.3 * fine);
}

// Soil lies on what stands out below, thus above a border between beds.
static void ledges_lie_on_beds(void **state)
{
    (void)state;
    int ledges = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = random_point(i);
        if (crags_at(p, 10.0f, 1, 1e-3f).ledge > 0.5f) {
            float here = crags_at(p, 10.0f, 1, 1e-3f).height, out = -1e9f;
            for (int k = 1; k <= 20; k++) {
                Vec3 below = vec3_sub(p, vec3(0, 0.1f * (float)k, 0));
                out = fmaxf(out, crags_at(below, 10.0f, 1, 1e-3f).height);
            }
            assert_true(out > here);
            ledges++;
        }
    }
    assert_true(ledges > 20);
}

static void rock_is_displaced_where_asked(void **state)
{
    (void)state;
    const PatternKind faces[] = {PATTERN_MOUNTAIN, PATTERN_ALPS, PATTERN_COAST, PATTERN_KARST};
    for (int i = 0; i < 4; i++) {
        Material m = material_default(MATERIAL_DIFFUSE);
        m.pattern = faces[i];
        m.pattern_depth = 1.0f;
        assert_true(relief_size(&m, 0.0f) == 0.0f);
        m.displacement = DISPLACEMENT_ON;
        float size = relief_size(&m, 0.0f), low = 0.0f, high = 0.0f;
        for (uint64_t k = 0; k < PLACES; k++) {
            SurfacePoint point = {.object_position = random_point(k),
                                  .smooth_normal = vec3(1, 0, 0),
                                  .footprint = 0.01f};
            float height = pattern_height(&m, &point);
            low = fminf(low, height);
            high = fmaxf(high, height);
            point.smooth_normal = vec3(0, 1, 0); // scree and soil keep the land's shape
            assert_true(pattern_height(&m, &point) == 0.0f);
            Vec3 n = vec3_normalize(vec3_sub(random_point(k), random_point(k + PLACES)));
            point.smooth_normal = n; // what is spared is not displaced
            assert_true(!relief_spares(&m, n, n) || pattern_height(&m, &point) == 0.0f);
        }
        assert_true(high - low > size && high - low < 3.0f * size);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slope_is_the_gradient_of_the_height),
        cmocka_unit_test(blocks_are_flat),
        cmocka_unit_test(footprints_filter),
        cmocka_unit_test(ledges_lie_on_beds),
        cmocka_unit_test(rock_is_displaced_where_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
