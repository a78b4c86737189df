// Spray: its voxels hold what its parcels hold, and a ray through a parcel loses what the closed
// form tells.
#include "render/cloud/cloud_spray.h"
#include "render/cloud/clouds.h"

#include "base/random.h"

#include <math.h>

#include "testing.h"

static SprayParcels *many(int count)
{
    SprayParcels *spray = calloc(1, sizeof *spray);
    for (int i = 0; i < count; i++) {
        uint64_t key = random_key(7, (uint64_t)i);
        Vec3 center = vec3_scale(random_direction(key), 12.0f * random_unit(random_key(key, 1)));
        float radius = random_range(random_key(key, 2), 0.02f, 3.0f);
        float content = random_range(random_key(key, 3), 0.1f, 2.0f);
        SprayParcel parcel = {.center = center, .radius = radius, .content = content};
        if (i % 2 == 1) {
            parcel.drawn = vec3_scale(random_direction(random_key(key, 4)), 2.0f * radius);
        }
        assert_true(spray_add(spray, parcel, NULL));
    }
    return spray;
}

static double sum_of(const SparseVolume *v, double voxel)
{
    double sum = 0.0;
    for (int64_t i = 0; i < (int64_t)v->kept * SPARSE_SAMPLES; i++) {
        sum += (double)v->value[i] * voxel * voxel * voxel;
    }
    return sum;
}

// Also of parcels that are much smaller than a voxel.
static void voxels_hold_what_parcels_hold(void **state)
{
    (void)state;
    SprayParcels *spray = many(300);
    double wanted = 0.0;
    for (int64_t i = 0; i < spray->count; i++) {
        wanted += (double)spray->parcel[i].content;
    }
    SparseVolume *volume = cloud_spray_volume(spray, NULL);
    assert_non_null(volume);
    assert_true(fabs(sum_of(volume, (double)cloud_spray_voxel(spray)) - wanted) <= 1e-4 * wanted);
    assert_true(volume->highest > 0.0f);
    sparse_volume_free(volume);
    spray_free(spray);
}

static CloudSet *cloud_of(SprayParcels *spray, float extinction)
{
    Cloud cloud = cloud_default(CLOUD_SPRAY);
    Run run = run_default();
    cloud.spray = spray;
    cloud.extinction = extinction;
    CloudSet *clouds = clouds_new(&cloud, 1, 3, &run, NULL);
    assert_non_null(clouds);
    return clouds;
}

// What passes along a ray through (3, 40, -7), in the mean.
static double passed_along(const CloudSet *clouds, Vec3 direction)
{
    CloudRay ray = {vec3_madd(vec3(3, 40, -7), -26.0f, direction), direction, 100.0f, false};
    enum { TRIALS = 20000 };
    double passed = 0.0;
    uint64_t key = 5;
    for (int i = 0; i < TRIALS; i++) {
        passed += (double)clouds_pass(clouds, &ray, 1.0f, &key) / TRIALS;
    }
    return passed;
}

// Through the middle of a ball of density k (1 - r^2 / R^2)^3, which holds 64 pi k R^3 / 315: the
// depth is k R 32 / 35. Drawn out by L, it holds (R + L) / R times as much, and is as much deeper
// along its axis alone.
static void a_ray_through_a_parcel_loses_its_share(void **state)
{
    (void)state;
    const float radius = 2.0f, content = 5.0f, extinction = 0.2f;
    const Vec3 axis = {0.6f, 0.0f, 0.8f}, beside = {0.0f, 1.0f, 0.0f};
    for (int k = 0; k < 2; k++) {
        float drawn = 3.0f * (float)k;
        SprayParcels one = {0};
        SprayParcel parcel = {vec3(3, 40, -7), radius, content, vec3_scale(axis, drawn)};
        assert_true(spray_add(&one, parcel, NULL));
        CloudSet *clouds = cloud_of(&one, extinction);
        double size = (double)(radius * radius * (radius + drawn));
        double middle = 315.0 * (double)content / (64.0 * 3.14159265358979 * size);
        double across = (double)extinction * middle * (double)radius * 32.0 / 35.0;
        double along = across * (double)((radius + drawn) / radius);
        assert_true(fabs(passed_along(clouds, beside) - exp(-across)) <= 0.02);
        assert_true(fabs(passed_along(clouds, axis) - exp(-along)) <= 0.02);
        double found = (double)clouds_extinction(clouds, vec3(3, 40, -7));
        assert_true(fabs(found / ((double)extinction * middle) - 1.0) <= 0.05);
        assert_true(clouds_extinction(clouds, vec3(3, 43, -7)) == 0.0f);
        Vec3 end = vec3_madd(vec3(3, 40, -7), 1.4f * radius + 0.5f * drawn, axis);
        assert_true((clouds_extinction(clouds, end) > 0.0f) == (k == 1));
        clouds_free(clouds);
        free(one.parcel);
    }
}

static void without_parcels_light_passes(void **state)
{
    (void)state;
    CloudSet *clouds = cloud_of(NULL, 0.2f);
    CloudRay ray = {vec3(-20, 0.5f, 0.5f), vec3(1, 0, 0), 100.0f, false};
    uint64_t key = 5;
    assert_true(clouds_pass(clouds, &ray, 1.0f, &key) == 1.0f);
    clouds_free(clouds);
}

// A puff starts at its speed, and keeps its momentum: speed x radius^3 is constant.
static void puffs_keep_their_momentum(void **state)
{
    (void)state;
    const float radius = 0.4f, speed = 9.0f, step = 0.01f;
    for (float t = 0.0f; t < 8.0f; t += 0.5f) {
        float from = spray_puff_way(radius, speed, t), to = spray_puff_way(radius, speed, t + step);
        double wide = (double)spray_puff_radius(radius, 0.5f * (from + to));
        double momentum = (double)(to - from) / (double)step * pow(wide / (double)radius, 3.0);
        assert_true(fabs(momentum - (double)speed) <= 0.03 * (double)speed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(voxels_hold_what_parcels_hold),
        cmocka_unit_test(a_ray_through_a_parcel_loses_its_share),
        cmocka_unit_test(without_parcels_light_passes),
        cmocka_unit_test(puffs_keep_their_momentum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
