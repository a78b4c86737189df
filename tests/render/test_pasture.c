// Pasture on hills: paths keep their share of ever larger pixels and run along the slope; the whole
// cover has one colour from near and from afar.
#include "base/color.h"
#include "base/random.h"
#include "render/material/pattern.h"
#include "render/material/pattern_paths.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { PLACES = 6000 };

// A random place of a plane through the origin with this normal.
static SurfacePoint place(uint64_t key, Vec3 normal, float footprint)
{
    Vec3 at = {random_range(random_key(key, 0), -2000.0f, 2000.0f), 0.0f,
               random_range(random_key(key, 1), -2000.0f, 2000.0f)};
    at.y = -(normal.x * at.x + normal.z * at.z) / normal.y;
    return (SurfacePoint){.object_position = at,
                          .position = at,
                          .normal = normal,
                          .geometric_normal = normal,
                          .site = {.x = 0.5f, .y = random_unit(random_key(key, 2))},
                          .footprint = footprint};
}

// sin of the slope
static Vec3 slope_of(float steep)
{
    return vec3(0.6f * steep, sqrtf(1.0f - steep * steep), 0.8f * steep);
}

// The integral over all distances is the width whatever the pixel, and nothing covers more than it.
static void lines_keep_their_area(void **state)
{
    (void)state;
    const float pixels[5] = {0.0f, 0.1f, 0.7f, 1.0f, 9.0f};
    for (int k = 0; k < 5; k++) {
        double sum = 0.0, step = 1e-3;
        for (int i = -10000; i <= 10000; i++) {
            float share = path_share((float)(step * i), 0.7f, pixels[k]);
            assert_true(share >= 0.0f && share <= 1.0f + 1e-6f);
            sum += step * (double)share;
        }
        assert_true(fabs(sum - 0.7) < 2e-3);
        assert_true(path_share(0.5f * (0.7f + pixels[k]) + 0.01f, 0.7f, pixels[k]) == 0.0f);
    }
}

typedef Paths (*PathsOf)(const SurfacePoint *point);

static Paths terracettes_of(const SurfacePoint *point)
{
    return pattern_terracettes(point, 0.8f, 5);
}

static Paths tracks_of(const SurfacePoint *point)
{
    return pattern_tracks(point, 0.5f, 9);
}

static double mean_share(PathsOf of, Vec3 normal, float footprint)
{
    double sum = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint p = place(i, normal, footprint);
        sum += (double)of(&p).share;
    }
    return sum / PLACES;
}

static void paths_keep_their_share_of_larger_pixels(void **state)
{
    (void)state;
    const PathsOf kinds[2] = {terracettes_of, tracks_of};
    const double least[2] = {0.10, 0.004};
    for (int k = 0; k < 2; k++) {
        double near = mean_share(kinds[k], slope_of(0.45f), 0.05f);
        double far = mean_share(kinds[k], slope_of(0.45f), 2.0f);
        print_message("share %.4f near, %.4f far\n", near, far);
        assert_true(near > least[k] && near < 0.4);
        assert_true(fabs(far / near - 1.0) < (k == 0 ? 0.08 : 0.25));
    }
    assert_true(mean_share(terracettes_of, slope_of(0.1f), 0.05f) == 0.0);
}

// A step along the contour leaves most treads, as long a step uphill hardly any.
static void terracettes_follow_contours(void **state)
{
    (void)state;
    Vec3 n = slope_of(0.45f), along = {0.8f, 0.0f, -0.6f};
    Vec3 up = vec3_cross(along, n);
    int treads = 0, level = 0, steep = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint p = place(i, n, 0.02f), q = p;
        if (terracettes_of(&p).share < 0.5f) {
            continue;
        }
        treads++;
        q.object_position = vec3_madd(p.object_position, 0.6f, along);
        level += terracettes_of(&q).share > 0.25f;
        q.object_position = vec3_madd(p.object_position, 0.6f, up);
        steep += terracettes_of(&q).share > 0.25f;
    }
    assert_true(treads > PLACES / 20);
    assert_true((double)level > 0.65 * treads && (double)steep < 0.25 * treads);
}

// The same mean colour at any distance; bumps only as far as pixels resolve them.
static void pasture_keeps_its_mean(void **state)
{
    (void)state;
    Material m = {.pattern = PATTERN_HILLS, .pattern_depth = 1.0f};
    m.color = vec3(0.2f, 0.165f, 0.075f);
    m.color2 = vec3(0.075f, 0.095f, 0.03f);
    const float pixels[4] = {0.02f, 0.4f, 2.0f, 1000.0f};
    double mean[4] = {0}, tilt[4] = {0};
    for (uint64_t i = 0; i < PLACES; i++) {
        for (int k = 0; k < 4; k++) {
            SurfacePoint p = place(i, slope_of(0.35f), pixels[k]);
            PatternShade s = {.color = m.color, .normal = p.normal};
            pattern_hills(&m, &p, &s);
            assert_true(fabs((double)vec3_length(s.normal) - 1.0) < 1e-5);
            mean[k] += (double)luminance(s.color) / PLACES;
            tilt[k] += 1.0 - (double)vec3_dot(s.normal, p.normal);
        }
    }
    for (int k = 1; k < 4; k++) {
        print_message("pixel %g m: luminance %.4f of %.4f, tilt %.4f\n", (double)pixels[k], mean[k],
                      mean[0], tilt[k] / PLACES);
    }
    for (int k = 1; k < 4; k++) {
        assert_true(fabs(mean[k] / mean[0] - 1.0) < 0.1);
        assert_true(tilt[k] < tilt[k - 1]);
    }
    assert_true(tilt[0] > 0.02 * PLACES && tilt[3] < 1e-4 * PLACES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_keep_their_area),
        cmocka_unit_test(paths_keep_their_share_of_larger_pixels),
        cmocka_unit_test(terracettes_follow_contours),
        cmocka_unit_test(pasture_keeps_its_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
