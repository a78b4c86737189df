// Swarms: copies in their region, apart, in clumps, and heading like their neighbours.
#include "base/exact_math.h"
#include "objects/swarm/swarm.h"
#include "testing.h"

// A box of 8 x 4 x 8 m about (1, 2, 3).
static Shape region(void)
{
    return (Shape){.kind = SHAPE_BOX,
                   .size = {4, 2, 4},
                   .transform = transform_from_axes(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1),
                                                    vec3(1, 2, 3))};
}

static SwarmParams swarm_in(Shape *shape, Thing *thing)
{
    SwarmParams swarm = swarm_params_default();
    swarm.shapes = shape;
    swarm.shape_count = 1;
    swarm.scale[0] = swarm.scale[1] = 1.0f;
    swarm.things = (Things){thing, 1, 1};
    return swarm;
}

static ThingPlaces places_of(const SwarmParams *swarm)
{
    Run run = run_default();
    Recipe recipe = {.seed = 5, .run = &run};
    ThingPlaces places;
    Error e = {0};
    assert_true(swarm_places_init(&places, swarm, &recipe, &e));
    return places;
}

static Vec3 axis(const Transform *t, int column)
{
    return vec3(t->m[0][column], t->m[1][column], t->m[2][column]);
}

static float degrees_between(Vec3 a, Vec3 b)
{
    return exact_acos(clampf(vec3_dot(a, b), -1.0f, 1.0f)) / RADIANS_PER_DEGREE;
}

static void assert_in(float value, float low, float high)
{
    assert_true(value >= low && value <= high);
}

static void copies_fill_the_region_and_keep_their_distance(void **state)
{
    (void)state;
    Shape shape = region();
    Thing thing = {.share = 1.0f};
    SwarmParams swarm = swarm_in(&shape, &thing);
    swarm.count = 600;
    swarm.spacing = 0.4f;
    ThingPlaces places = places_of(&swarm);
    assert_int_equal(places.count, 600);
    int octant[8] = {0};
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 p = vec3_sub(axis(&places.place[i], 3), vec3(1, 2, 3));
        assert_true(fabsf(p.x) <= 4.0f && fabsf(p.y) <= 2.0f && fabsf(p.z) <= 4.0f);
        octant[(p.x > 0.0f) + 2 * (p.y > 0.0f) + 4 * (p.z > 0.0f)]++;
        for (int64_t j = 0; j < i; j++) {
            assert_true(vec3_distance(axis(&places.place[i], 3), axis(&places.place[j], 3)) >=
                        0.4f);
        }
    }
    for (int i = 0; i < 8; i++) { // 75 each, give or take 4 standard deviations
        assert_in_range(octant[i], 41, 109);
    }
    thing_places_free(&places);
}

// Balls of a radius of 1.6 m about places of the region lie in 11.2 x 7.2 x 11.2 m, of which they
// fill at most 74 %: 38 of them.
static void copies_without_room_are_left_out(void **state)
{
    (void)state;
    Shape shape = region();
    Thing thing = {.share = 1.0f};
    SwarmParams swarm = swarm_in(&shape, &thing);
    swarm.count = 300;
    swarm.spacing = 3.2f;
    ThingPlaces places = places_of(&swarm);
    assert_in_range(places.count, 8, 38);
    thing_places_free(&places);
}

// z heads east-south-east, x is to its left, y up; none strays, climbs or rolls farther than it
// may.
static void headings_keep_their_limits(void **state)
{
    (void)state;
    Shape shape = region();
    Thing thing = {.share = 1.0f};
    SwarmParams swarm = swarm_in(&shape, &thing);
    swarm.azimuth = 120.0f;
    ThingPlaces places = places_of(&swarm);
    Vec3 wanted = vec3(0.8660254f, 0.0f, 0.5f);
    for (int64_t i = 0; i < places.count; i++) {
        assert_true(vec3_distance(axis(&places.place[i], 2), wanted) < 1e-5f);
        assert_true(vec3_distance(axis(&places.place[i], 1), vec3(0, 1, 0)) < 1e-5f);
        assert_true(vec3_distance(axis(&places.place[i], 0), vec3(0.5f, 0, -0.8660254f)) < 1e-5f);
    }
    thing_places_free(&places);
    swarm.stray = 20.0f;
    swarm.climb = 10.0f;
    swarm.roll = 30.0f;
    places = places_of(&swarm);
    float most[3] = {0};
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 left = axis(&places.place[i], 0), forward = axis(&places.place[i], 2);
        Vec3 level = vec3_normalize(vec3(forward.x, 0.0f, forward.z));
        Vec3 level_left = vec3_normalize(vec3_cross(vec3(0, 1, 0), forward));
        most[0] = fmaxf(most[0], degrees_between(level, wanted));
        most[1] = fmaxf(most[1], degrees_between(level, forward));
        most[2] = fmaxf(most[2], degrees_between(left, level_left));
    }
    assert_in(most[0], 18.0f, 20.01f);
    assert_in(most[1], 9.0f, 10.01f);
    assert_in(most[2], 27.0f, 30.01f);
    thing_places_free(&places);
}

// Mean angle between the headings of pairs whose distance is in the range.
static float mean_turn(const ThingPlaces *places, float low, float high)
{
    double sum = 0.0;
    int64_t pairs = 0;
    for (int64_t i = 0; i < places->count; i++) {
        for (int64_t j = 0; j < i; j++) {
            float distance = vec3_distance(axis(&places->place[i], 3), axis(&places->place[j], 3));
            if (distance >= low && distance < high) {
                sum +=
                    (double)degrees_between(axis(&places->place[i], 2), axis(&places->place[j], 2));
                pairs++;
            }
        }
    }
    assert_true(pairs > 100);
    return (float)(sum / (double)pairs);
}

static void neighbours_head_alike(void **state)
{
    (void)state;
    Shape shape = region();
    Thing thing = {.share = 1.0f};
    SwarmParams swarm = swarm_in(&shape, &thing);
    swarm.count = 500;
    swarm.swirl = 120.0f;
    swarm.swirl_size = 3.0f;
    ThingPlaces places = places_of(&swarm);
    float near = mean_turn(&places, 0.0f, 0.5f), far = mean_turn(&places, 3.0f, 5.0f);
    assert_true(far > 25.0f);
    assert_true(near < 0.5f * far);
    thing_places_free(&places);
}

// Variance over mean of the numbers in cells of 1 m: 1 of independent points.
static float dispersion(const ThingPlaces *places)
{
    int cell[8 * 4 * 8] = {0};
    double square = 0.0, mean = (double)places->count / (8 * 4 * 8);
    for (int64_t i = 0; i < places->count; i++) {
        Vec3 p = vec3_sub(axis(&places->place[i], 3), vec3(-3, 0, -1));
        cell[((int)clampf(p.x, 0, 7.99f) * 4 + (int)clampf(p.y, 0, 3.99f)) * 8 +
             (int)clampf(p.z, 0, 7.99f)]++;
    }
    for (int i = 0; i < 8 * 4 * 8; i++) {
        square += ((double)cell[i] - mean) * ((double)cell[i] - mean);
    }
    return (float)(square / (8 * 4 * 8) / mean);
}

static void clumps_have_gaps_between_them(void **state)
{
    (void)state;
    Shape shape = region();
    Thing thing = {.share = 1.0f};
    SwarmParams swarm = swarm_in(&shape, &thing);
    swarm.count = 2000;
    swarm.clump_size = 3.0f;
    ThingPlaces even = places_of(&swarm);
    swarm.clumping = 1.0f;
    ThingPlaces clumped = places_of(&swarm);
    assert_int_equal(clumped.count, 2000);
    assert_in(dispersion(&even), 0.7f, 1.35f);
    assert_true(dispersion(&clumped) > 3.0f);
    thing_places_free(&even);
    thing_places_free(&clumped);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_fill_the_region_and_keep_their_distance),
        cmocka_unit_test(copies_without_room_are_left_out),
        cmocka_unit_test(headings_keep_their_limits),
        cmocka_unit_test(neighbours_head_alike),
        cmocka_unit_test(clumps_have_gaps_between_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
