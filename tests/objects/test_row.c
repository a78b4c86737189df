// Rows: even steps along the line, on the land, displaced and turned no more than they may.
#include "base/random.h"
#include "objects/kinds.h"
#include "objects/row/row.h"
#include "objects/stone/stone.h"
#include "testing.h"

enum { MOST = 1000 };

static float slope_height(const void *user, float x, float z)
{
    (void)z;
    return *(const float *)user * x;
}

static RowParams row_of(RowPoint *points, int count, Thing *things, int thing_count)
{
    RowParams row = row_params_default();
    row.points = points;
    row.point_count = count;
    row.things = (Things){things, thing_count, 1};
    return row;
}

static ThingPlaces places_of(const RowParams *row, const Surroundings *around)
{
    Run run = run_default();
    Recipe recipe = {.seed = 5, .run = &run};
    ThingPlaces places;
    Error e = {0};
    assert_true(row_places_init(&places, row, &recipe, around, &e));
    return places;
}

static Vec3 axis(const Transform *t, int column)
{
    return vec3(t->m[0][column], t->m[1][column], t->m[2][column]);
}

// Steps go round the corner by the length of the line, not across it.
static void steps_are_even_and_reach_both_ends(void **state)
{
    (void)state;
    RowPoint points[] = {{{0, 2, 0}}, {{0, 2, 3}}, {{4, 2, 3}}};
    Thing thing = {.share = 1.0f};
    RowParams row = row_of(points, 3, &thing, 1);
    row.on_land = false;
    row.spacing = 0.52f; // of 7 m: 14 places of 7 / 13 m
    ThingPlaces places = places_of(&row, &(Surroundings){0});
    assert_int_equal(row_count(&row), 14);
    assert_int_equal(places.count, 14);
    for (int64_t i = 0; i < places.count; i++) {
        float along = 7.0f / 13.0f * (float)i;
        Vec3 wanted = along <= 3.0f ? vec3(0, 2, along) : vec3(along - 3.0f, 2, 3);
        Vec3 forward = along <= 3.0f ? vec3(0, 0, 1) : vec3(1, 0, 0);
        assert_true(vec3_distance(axis(&places.place[i], 3), wanted) < 1e-5f);
        assert_true(vec3_distance(axis(&places.place[i], 2), forward) < 1e-6f);
        assert_true(vec3_distance(axis(&places.place[i], 1), vec3(0, 1, 0)) < 1e-6f);
    }
    thing_places_free(&places);
}

static void posts_stand_upright_on_the_land_and_rails_follow_it(void **state)
{
    (void)state;
    float slope = 0.5f;
    RowPoint points[] = {{{-5, 0, 1}}, {{5, 90, 1}}}; // heights of the line do not matter
    Thing thing = {.share = 1.0f};
    RowParams row = row_of(points, 2, &thing, 1);
    row.sink = 0.25f;
    Surroundings around = {.land = {slope_height, &slope}};
    for (int rails = 0; rails < 2; rails++) {
        row.align = (float)rails;
        Vec3 up = vec3_normalize(rails ? vec3(-slope, 1, 0) : vec3(0, 1, 0));
        ThingPlaces places = places_of(&row, &around);
        for (int64_t i = 0; i < places.count; i++) {
            Vec3 foot = vec3_madd(axis(&places.place[i], 3), 0.25f, up);
            assert_true(fabsf(foot.y - slope * foot.x) < 1e-4f);
            assert_true(vec3_distance(axis(&places.place[i], 1), up) < 1e-4f);
        }
        thing_places_free(&places);
    }
}

static void disorder_keeps_to_its_bounds(void **state)
{
    (void)state;
    RowPoint points[] = {{{0, 0, 0}}, {{0, 0, MOST - 1}}};
    Thing thing = {.share = 1.0f};
    RowParams row = row_of(points, 2, &thing, 1);
    row.jitter[0] = 0.3f;
    row.jitter[1] = 0.1f;
    row.jitter[2] = 0.2f;
    row.tilt = 10.0f;
    row.scale[0] = 0.5f;
    row.scale[1] = 2.0f;
    ThingPlaces places = places_of(&row, &(Surroundings){0});
    float most[3] = {0}, lean = 0.0f, least = 9.0f, largest = 0.0f;
    for (int64_t i = 0; i < places.count; i++) {
        Vec3 off = vec3_sub(axis(&places.place[i], 3), vec3(0, 0, (float)i));
        const float d[3] = {fabsf(off.x), fabsf(off.y), fabsf(off.z)};
        for (int k = 0; k < 3; k++) {
            most[k] = fmaxf(most[k], d[k]);
        }
        float size = vec3_length(axis(&places.place[i], 1));
        lean = fmaxf(lean, acosf(fminf(axis(&places.place[i], 1).y / size, 1.0f)));
        least = fminf(least, size);
        largest = fmaxf(largest, size);
    }
    for (int k = 0; k < 3; k++) { // none beyond, and of a thousand some near the bound
        assert_true(most[k] <= row.jitter[k] + 1e-4f && most[k] > 0.97f * row.jitter[k]);
    }
    assert_true(lean <= 10.1f * RADIANS_PER_DEGREE && lean > 9.5f * RADIANS_PER_DEGREE);
    assert_true(least >= 0.499f && least < 0.51f && largest <= 2.001f && largest > 1.98f);
    thing_places_free(&places);
}

// Standard deviation of a share of 0.3 among 1000: 0.0145.
static void gaps_and_shares_are_kept(void **state)
{
    (void)state;
    RowPoint points[] = {{{0, 0, 0}}, {{MOST - 1, 0, 0}}};
    Thing things[] = {{.share = 1.0f}, {.share = 3.0f}};
    RowParams row = row_of(points, 2, things, 2);
    row.gaps = 0.3f;
    row.things.variants = 2;
    ThingPlaces places = places_of(&row, &(Surroundings){0});
    assert_true(fabsf((float)places.count / MOST - 0.7f) < 0.06f);
    float of_first = 0.0f;
    for (int64_t i = 0; i < places.count; i++) {
        assert_true(places.thing[i] >= 0 && places.thing[i] < 4);
        of_first += places.thing[i] < 2 ? 1.0f : 0.0f;
    }
    assert_true(fabsf(of_first / (float)places.count - 0.25f) < 0.07f);
    thing_places_free(&places);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_are_even_and_reach_both_ends),
        cmocka_unit_test(posts_stand_upright_on_the_land_and_rails_follow_it),
        cmocka_unit_test(disorder_keeps_to_its_bounds),
        cmocka_unit_test(gaps_and_shares_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
