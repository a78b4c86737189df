// Ripples of sand and the tongues on slip faces: distances, gradients, forks, cover.
#include "render/material/pattern_ripples.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

#define LENGTH 0.16f // m

static Vec3 place(int i, uint32_t seed)
{
    srand((unsigned)i + seed);
    return vec3(40.0f * (float)rand() / (float)RAND_MAX, 0.0f,
                40.0f * (float)rand() / (float)RAND_MAX);
}

// Crests that a line of so many wavelengths crosses.
static int crests(Vec3 from, float x, float z, float wind_x, float wind_z, int lengths)
{
    const int steps = 40; // a wavelength
    int found = 0;
    float last = 0.0f;
    for (int i = 0; i < lengths * steps; i++) {
        float t = LENGTH * (float)i / (float)steps;
        Vec3 p = vec3(from.x + t * x, 0.0f, from.z + t * z);
        float h = pattern_ripples(p, wind_x, wind_z, LENGTH, 7).height;
        found += i > 0 && last < 0.0f && h >= 0.0f;
        last = h;
    }
    return found;
}

static void ripples_are_as_far_apart_as_told(void **state)
{
    (void)state;
    enum { LENGTHS = 300 };
    for (int n = 0; n < 4; n++) {
        float angle = 0.9f * (float)n, x = cosf(angle), z = sinf(angle);
        int along = crests(vec3(3, 0, 5), x, z, x, z, LENGTHS);
        int across = crests(vec3(3, 0, 5), -z, x, x, z, LENGTHS);
        if (!(along > 0.88 * LENGTHS && along < 1.12 * LENGTHS && across < 0.25 * LENGTHS)) {
            fail_msg("%d crests along the wind, %d across it in %d lengths", along, across,
                     LENGTHS);
        }
    }
}

// Waves without forks would have as many crests on all lines, but for one.
static void crests_fork(void **state)
{
    (void)state;
    int least = 1000, most = 0;
    for (int n = 0; n < 12; n++) {
        int count = crests(vec3(0.0f, 0.0f, 2.0f * (float)n), 1, 0, 1, 0, 300);
        least = count < least ? count : least;
        most = count > most ? count : most;
    }
    assert_true(most - least >= 3);
}

typedef SandRelief (*Form)(Vec3 p);

static SandRelief some_ripples(Vec3 p)
{
    return pattern_ripples(p, 0.8f, 0.6f, LENGTH, 7);
}

static SandRelief some_tongues(Vec3 p)
{
    return pattern_tongues(p, 0.6f, -0.8f, 9.0f, 7);
}

// Mean square of the error of slopes over that of slopes, by differences.
static double slope_error(Form form, float step)
{
    double error = 0.0, square = 0.0;
    for (int i = 0; i < 4000; i++) {
        Vec3 p = place(i, 100), a = p, b = p, c = p, d = p;
        a.x += step, b.x -= step, c.z += step, d.z -= step;
        SandRelief here = form(p);
        double x = (double)(form(a).height - form(b).height) / (2.0 * (double)step);
        double z = (double)(form(c).height - form(d).height) / (2.0 * (double)step);
        error += pow(x - (double)here.slope.x, 2.0) + pow(z - (double)here.slope.z, 2.0);
        square += x * x + z * z;
    }
    return error / square;
}

static void slopes_are_gradients(void **state)
{
    (void)state;
    double ripples = slope_error(some_ripples, 0.0005f);
    if (!(ripples < 0.02)) { // but for how ripples fade toward forks
        fail_msg("ripples: %g of the square", ripples);
    }
    // Borders of later tongues on earlier ones are steps.
    double step = 0.002, tongues = slope_error(some_tongues, (float)step);
    if (!(tongues < 0.5)) {
        fail_msg("tongues: %g of the square", tongues);
    }
}

static void tongues_cover_about_half_of_a_face(void **state)
{
    (void)state;
    int covered = 0;
    for (int i = 0; i < 4000; i++) {
        SandRelief r = some_tongues(place(i, 5000));
        assert_true(r.height >= 0.0f && r.height <= 1.0f && fabsf(r.tone) <= 1.0f);
        covered += r.height > 0.0f;
    }
    if (!(covered > 1200 && covered < 3200)) {
        fail_msg("%d of 4000 places", covered);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ripples_are_as_far_apart_as_told),
        cmocka_unit_test(crests_fork),
        cmocka_unit_test(slopes_are_gradients),
        cmocka_unit_test(tongues_cover_about_half_of_a_face),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
