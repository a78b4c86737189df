// The form of storms: a thin anvil that is drawn out downwind in fibres, and towers with billows of
// all sizes.
#include "tiny_world.h"

#include "base/random.h"
#include "render/cloud/anvil.h"
#include "render/cloud/clouds.h"

#include <stdlib.h>

#define assert_in_bounds(value, low, high)                                      \
    do {                                                                        \
        double v_ = (double)(value), a_ = (double)(low), b_ = (double)(high);   \
        if (!(v_ >= a_ && v_ <= b_)) {                                          \
            fail_msg("%s = %.6g, not within %.6g .. %.6g", #value, v_, a_, b_); \
        }                                                                       \
    } while (0)

static Cloud storm(int seed)
{
    Cloud cloud = cloud_default(CLOUD_STORM);
    cloud.softness = 0.2f;
    cloud.wind = 90.0f; // toward +X
    cloud.seed = seed;
    return cloud;
}

static CloudSet *grow(const Cloud *cloud)
{
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    CloudSet *clouds = clouds_new(cloud, 1, 3, &run, &e);
    assert_non_null(clouds);
    return clouds;
}

// The storms of seeds 0 and 1, which all tests look at: growing one takes seconds.
enum { STORMS = 2 };

static int grow_storms(void **state)
{
    static CloudSet *storms[STORMS];
    for (int seed = 0; seed < STORMS; seed++) {
        Cloud cloud = storm(seed);
        storms[seed] = grow(&cloud);
    }
    *state = storms;
    return 0;
}

static int free_storms(void **state)
{
    CloudSet **storms = *state;
    for (int seed = 0; seed < STORMS; seed++) {
        clouds_free(storms[seed]);
    }
    return 0;
}

static const CloudSet *grown(void **state, int seed)
{
    CloudSet **storms = *state;
    return storms[seed];
}

static bool holds(const CloudSet *clouds, Vec3 p)
{
    return clouds_extinction(clouds, p) > 1e-4f;
}

// m of cloud above a place, in the upper half of the storm.
static float depth_above(const CloudSet *clouds, const Cloud *cloud, float x, float z)
{
    const float step = 25.0f;
    float sum = 0.0f;
    for (float y = 0.5f; y < 1.05f; y += step / cloud->thickness) {
        sum += step * holds(clouds, vec3(x, cloud->base + y * cloud->thickness, z));
    }
    return sum;
}

// Nature's anvils are 0.3 to 1.5 km thick and 15 km wide or more (Houze 2014, "Cloud Dynamics", ch.
// 8).
static void the_anvil_is_a_thin_sheet(void **state)
{
    enum { SIDE = 96 };
    for (int seed = 0; seed < STORMS; seed++) {
        Cloud cloud = storm(seed);
        const CloudSet *clouds = grown(state, seed);
        double thick = 0.0, west = 0.0, east = 0.0;
        int count = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            float x = 7.0f * cloud.size * ((float)(i % SIDE) / SIDE - 0.32f);
            float z = 7.0f * cloud.size * ((float)(i / SIDE) / SIDE - 0.5f);
            float deep = depth_above(clouds, &cloud, x, z);
            if (deep > 0.0f && x * x + z * z > cloud.size * cloud.size) { // beside the tower
                thick += (double)deep;
                count++;
            }
            if (deep > 0.0f) {
                west = fmin(west, (double)x);
                east = fmax(east, (double)x);
            }
        }
        assert_true(count > 0);
        assert_in_bounds(thick / count, 250, 1200);
        assert_in_bounds(east - west, 15000, 26000);
        assert_true(east > -2.0 * west); // downwind
    }
}

// Optical depth seen from below: twice as far along the wind it changes less than across it.
static void its_fibres_lie_along_the_wind(void **state)
{
    (void)state;
    enum { PLACES = 4000 };
    Cloud cloud = storm(0);
    Run run = run_default();
    Error e = {.code = ERROR_NONE};
    DetailNoise *detail = detail_new(5, &run, &e);
    assert_non_null(detail);
    Anvil anvil = anvil_of(&cloud, detail, 7);
    double along = 0.0, across = 0.0, mean = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        float x = cloud.size * random_range(random_key(i, 0), 1.2f, 2.2f);
        float z = cloud.size * random_range(random_key(i, 1), -0.6f, 0.6f);
        float at[3];
        for (int k = 0; k < 3; k++) {
            AnvilColumn c =
                anvil_column(&anvil, x + (k == 1 ? 300.0f : 0.0f), z + (k == 2 ? 150.0f : 0.0f));
            at[k] = anvil_share(&anvil, &c, anvil.frame.top - 300.0f);
        }
        along += (double)fabsf(at[1] - at[0]);
        across += (double)fabsf(at[2] - at[0]);
        mean += (double)at[0];
    }
    assert_true(across > 0.3 * mean); // they show
    assert_true(along < 0.6 * across);
    detail_free(detail);
}

// Ice is thin: an optical depth of 1 to 15 in the sheet, far more in the tower.
static void the_anvil_lets_light_through(void **state)
{
    Cloud cloud = storm(0);
    const CloudSet *clouds = grown(state, 0);
    double sheet = 0.0, tower = 0.0;
    const float step = 20.0f;
    for (float y = step; y < 1.05f * cloud.thickness; y += step) {
        float altitude = cloud.base + y;
        tower += (double)(step * clouds_extinction(clouds, vec3(0, altitude, 0)));
        for (int i = 0; i < 16; i++) {
            float z = 0.05f * cloud.size * (float)(i - 8);
            sheet +=
                (double)(step * clouds_extinction(clouds, vec3(2.2f * cloud.size, altitude, z)));
        }
    }
    assert_in_bounds(sheet / 16.0, 1.0, 15.0);
    assert_true(tower > 300.0);
}

// Length of the outline of a level section of the towers, by places of a side: 1 / side times a
// power of it that is the outline's dimension.
static double outline(const CloudSet *clouds, const Cloud *cloud, float side, float altitude)
{
    int half = (int)(0.9f * cloud->size / side), borders = 0;
    for (int z = -half; z < half; z++) {
        bool last = false;
        for (int x = -half; x <= half; x++) {
            bool here = holds(clouds, vec3(side * (float)x, altitude, side * (float)z));
            borders += x > -half && here != last;
            last = here;
        }
    }
    return borders * (double)side;
}

// Edges of cumulus are fractal over two decades: sections have a dimension of 1.35 (Lovejoy 1982).
// Each octave of smaller billows adds its own, so the outline grows at every halving of the ruler.
static void towers_have_billows_of_all_sizes(void **state)
{
    enum { RULERS = 4 };
    Cloud cloud = storm(1);
    const CloudSet *clouds = grown(state, 1);
    double length[RULERS] = {0};
    for (int i = 0; i < 8; i++) {
        float altitude = cloud.base + (0.2f + 0.04f * (float)i) * cloud.thickness;
        for (int k = 0; k < RULERS; k++) {
            length[k] += outline(clouds, &cloud, 160.0f / (float)(1 << k), altitude);
        }
    }
    for (int k = 1; k < RULERS; k++) {
        assert_true(length[k] > 1.05 * length[k - 1]);
    }
    double dimension = 1.0 + log2(length[RULERS - 1] / length[0]) / (RULERS - 1);
    assert_in_bounds(dimension, 1.15, 1.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_anvil_is_a_thin_sheet),
        cmocka_unit_test(its_fibres_lie_along_the_wind),
        cmocka_unit_test(the_anvil_lets_light_through),
        cmocka_unit_test(towers_have_billows_of_all_sizes),
    };
    return cmocka_run_group_tests(tests, grow_storms, free_storms);
}
