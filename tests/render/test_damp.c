// Damp rock faces: dry ones stay as they are; moss lies on ledges and in cracks more than on smooth
// rock; what water leaves runs down, not across.
#include "base/random.h"
#include "render/material/pattern_damp.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { PLACES = 4000 };

static const Ground ROCK = {{0.1f, 0.1f, 0.1f}, {0.2f, 0.0f, 0.1f}};

static Ground damp_at(float amount, Vec3 p, Crags crags, float upright)
{
    SurfacePoint point = {.object_position = p, .footprint = 0.002f};
    return pattern_damp(amount, &point, &crags, upright, ROCK);
}

static Vec3 random_point(uint64_t i)
{
    return vec3(random_range(random_key(17, 3 * i), -50.0f, 50.0f),
                random_range(random_key(17, 3 * i + 1), -50.0f, 50.0f),
                random_range(random_key(17, 3 * i + 2), -50.0f, 50.0f));
}

static void dry_faces_stay_as_they_are(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < PLACES; i++) {
        Ground g = damp_at(0.0f, random_point(i), (Crags){.ledge = 1.0f, .crevice = 1.0f}, 0.1f);
        assert_memory_equal(&g, &ROCK, sizeof g);
    }
}

// The share of places that are green: green over both others.
static double green(float amount, Crags crags, float upright)
{
    int count = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 c = damp_at(amount, random_point(i), crags, upright).color;
        assert_true(c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f && vec3_largest(c) < 0.4f);
        count += c.y > 1.15f * c.x && c.y > 1.6f * c.z;
    }
    return (double)count / PLACES;
}

static void moss_lies_where_soil_and_water_are_held(void **state)
{
    (void)state;
    double smooth = green(0.7f, (Crags){0}, 0.1f);
    double crack = green(0.7f, (Crags){.crevice = 1.0f}, 0.1f);
    double ledge = green(0.7f, (Crags){.ledge = 1.0f}, 0.1f);
    double less = green(0.3f, (Crags){.ledge = 1.0f}, 0.1f);
    printf("    green: %.3f of smooth rock, %.3f of cracks, %.3f of ledges, %.3f of drier ones\n",
           smooth, crack, ledge, less);
    assert_true(smooth < 0.25 && crack > 2.0 * smooth && ledge > 2.0 * smooth && ledge > less);
}

// A step down changes colours less than a step across.
static void streaks_run_down(void **state)
{
    (void)state;
    double down = 0.0, across = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = random_point(i);
        Vec3 here = damp_at(0.2f, p, (Crags){0}, 0.05f).color;
        down += (double)vec3_distance(
            here, damp_at(0.2f, vec3_add(p, vec3(0, 0.2f, 0)), (Crags){0}, 0.05f).color);
        across += (double)vec3_distance(
            here, damp_at(0.2f, vec3_add(p, vec3(0.2f, 0, 0)), (Crags){0}, 0.05f).color);
    }
    printf("    0.2 m down %.5f, across %.5f\n", down / PLACES, across / PLACES);
    assert_true(across > 1.5 * down);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dry_faces_stay_as_they_are),
        cmocka_unit_test(moss_lies_where_soil_and_water_are_held),
        cmocka_unit_test(streaks_run_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
