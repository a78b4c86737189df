// Plumes of ash: they begin at the vent, widen and bend with the wind; and what absorbs, does so as
// much however few scatterings are traced.
#include "base/random.h"
#include "render/cloud/ash_plume.h"
#include "render/cloud/clouds.h"
#include "testing.h"

#include <math.h>

static Cloud plume(void)
{
    Cloud cloud = cloud_default(CLOUD_PLUME);
    cloud.base = 500.0f;
    cloud.center_x = -300.0f;
    cloud.center_z = 700.0f;
    cloud.wind = 90.0f; // toward +X
    cloud.resolution = 128;
    return cloud;
}

static CloudSet *grow(const Cloud *cloud, int count)
{
    Run run = run_default();
    CloudSet *clouds = clouds_new(cloud, count, 3, &run, NULL);
    assert_non_null(clouds);
    return clouds;
}

// Middle and standard deviation of the ash at an altitude, m along the wind and across.
typedef struct Slice {
    double sum, x, z, wide;
} Slice;

static Slice slice_at(const CloudSet *clouds, float y)
{
    Slice s = {0};
    double square = 0.0;
    for (float x = -2000.0f; x < 8000.0f; x += 40.0f) {
        for (float z = -3000.0f; z < 4000.0f; z += 40.0f) {
            double e = (double)clouds_extinction(clouds, vec3(x, y, z));
            s.sum += e;
            s.x += e * (double)x;
            s.z += e * (double)z;
            square += e * (double)z * (double)z;
        }
    }
    s.x /= s.sum;
    s.z /= s.sum;
    s.wide = sqrt(square / s.sum - s.z * s.z);
    return s;
}

static void it_widens_and_bends_with_the_wind(void **state)
{
    (void)state;
    Cloud cloud = plume();
    CloudSet *clouds = grow(&cloud, 1);
    assert_true(clouds_extinction(clouds, vec3(-300.0f, 499.0f, 700.0f)) == 0.0f);
    assert_true(clouds_extinction(clouds, vec3(-300.0f, 540.0f, 700.0f)) > 0.5f * cloud.extinction);
    Slice low = slice_at(clouds, 700.0f), middle = slice_at(clouds, 1500.0f);
    Slice high = slice_at(clouds, 2700.0f);
    assert_true(low.wide < middle.wide && middle.wide < high.wide);
    assert_true(low.x < middle.x && middle.x < high.x);
    double rise = 2200.0 / 3000.0, away = 1.2 * 0.4 * 3000.0 * rise * sqrt(rise);
    assert_true(fabs(high.x + 300.0 - away) < 0.35 * away);
    assert_true(fabs(high.z - 700.0) < 0.5 * high.wide);
    clouds_free(clouds);
}

// Of a ray's extinction, as it is.
static double depth_along(const CloudSet *clouds, const CloudRay *ray)
{
    const float step = 0.05f; // m
    double depth = 0.0;
    for (float t = 0.5f * step; t < ray->far; t += step) {
        Vec3 p = vec3_madd(ray->origin, t, ray->direction);
        depth += (double)(step * clouds_extinction(clouds, p));
    }
    return depth;
}

// Loss by absorption a metre stays, and so does its share of what is met.
static void absorption_is_the_same_however_wide_the_phase(void **state)
{
    (void)state;
    Cloud cloud = plume();
    cloud.albedo = vec3(0.6f, 0.6f, 0.6f);
    CloudSet *clouds = grow(&cloud, 1);
    CloudRay ray = {vec3(-300.0f, 560.0f, 700.0f), vec3(0, 0, 1), 20.0f, false};
    double depth = depth_along(clouds, &ray);
    assert_true(clouds_absorb(clouds, 0) && depth > 0.8);
    for (float scale = 1.0f; scale > 0.1f; scale *= 0.7f) {
        float lost = 1.0f - clouds_albedo(clouds, 0, scale).x;
        float counted = 0.6f * scale + 0.4f; // of the extinction, by the similarity of both
        assert_true(fabsf(lost * counted - 0.4f) < 1e-4f);
        enum { TRIALS = 20000 };
        double passed = 0.0, wanted = exp(-(double)counted * depth);
        uint64_t key = 9;
        int lives = 0;
        for (uint64_t i = 0; i < TRIALS; i++) {
            passed += (double)clouds_pass(clouds, &ray, scale, &key) / TRIALS;
            Vec3 weight = vec3_splat(1.0f);
            lives += clouds_scatter(clouds, 0, scale, random_unit(random_key(i, 5)), &weight);
            assert_true(fabsf(weight.x - 1.0f) < 1e-5f);
        }
        assert_true(fabs(passed - wanted) < 0.015);
        assert_true(fabs((double)lives / TRIALS - (1.0 - (double)lost)) < 0.015);
    }
    clouds_free(clouds);
}

static void the_nearest_cloud_is_told(void **state)
{
    (void)state;
    Cloud cloud[2] = {plume(), plume()};
    cloud[1].center_z += 3000.0f;
    CloudSet *clouds = grow(cloud, 2);
    CloudRay ray = {vec3(-300.0f, 600.0f, 9000.0f), vec3(0, 0, -1), INFINITY, false};
    uint64_t key = 4;
    int met[2] = {0}, which;
    for (int i = 0; i < 200; i++) {
        float t = clouds_collide_with(clouds, &ray, 1.0f, &key, &which);
        assert_true(isfinite(t));
        assert_int_equal(which, t < 6800.0f ? 1 : 0);
        met[which]++;
    }
    assert_true(met[1] > 150);
    clouds_free(clouds);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_widens_and_bends_with_the_wind),
        cmocka_unit_test(absorption_is_the_same_however_wide_the_phase),
        cmocka_unit_test(the_nearest_cloud_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
