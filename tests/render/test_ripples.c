// Ripples of sand and the tongues on slip faces: distances, gradients, forks, sides, volumes.
#include "render/material/pattern_ripples.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

#define LENGTH 0.12f // m

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

// Moves x up to the crest of the ripples that run across the x axis.
static float crest_near(float x, float z)
{
    const float step = LENGTH / 64.0f;
    float here = pattern_ripples(vec3(x, 0, z), 1, 0, LENGTH, 7).height;
    for (int i = 0; i < 200; i++) {
        float ahead = pattern_ripples(vec3(x + step, 0, z), 1, 0, LENGTH, 7).height;
        float back = pattern_ripples(vec3(x - step, 0, z), 1, 0, LENGTH, 7).height;
        if (fmaxf(ahead, back) <= here) {
            break;
        }
        x += ahead >= back ? step : -step;
        here = fmaxf(ahead, back);
    }
    return x;
}

// Followed along, a crest ends after less than a hundred wavelengths or so (an end is half of the
// forks that it meets: the others are ends of its neighbours), and winds by several degrees.
static void crests_wind_and_end(void **state)
{
    (void)state;
    enum { CRESTS = 150, STEPS = 600, A_LENGTH = 16 };
    double jump = 0.12 * (double)LENGTH, stride = (double)LENGTH / A_LENGTH, square = 0.0;
    int ends = 0, followed = 0;
    for (int n = 0; n < CRESTS; n++) {
        Vec3 p = place(n, 9000);
        float x = crest_near(p.x, p.z);
        for (int i = 1; i < STEPS; i++) {
            float next = crest_near(x, p.z + (float)(i * stride));
            double aside = (double)(next - x);
            ends += fabs(aside) > jump;
            square += fabs(aside) > jump ? 0.0 : aside * aside;
            followed++;
            x = next;
        }
    }
    double lengths = (double)followed / A_LENGTH / ends;
    double turn = atan(sqrt(square / followed) / stride) * 57.2958;
    if (!(lengths > 15.0 && lengths < 110.0 && turn > 5.0 && turn < 18.0)) {
        fail_msg("a crest ends after %g wavelengths and turns by %g degrees", lengths, turn);
    }
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Sharp (1963): windward sides of 8 to 10 degrees, lee sides of 20 to 30; here those of the
// steepest twentieth and of a high share of the windward sides, of ripples 14 times as long as
// high.
static void lee_sides_are_steep(void **state)
{
    (void)state;
    enum { COUNT = 20000 };
    static double slope[COUNT];
    const double height = 0.5 * (double)LENGTH / 14.0; // of the relief's unit
    for (int i = 0; i < COUNT; i++) {
        SandRelief r = pattern_ripples(place(i, 300), 0.8f, 0.6f, LENGTH, 7);
        double along = 0.8 * (double)r.slope.x + 0.6 * (double)r.slope.z;
        slope[i] = atan(height * along) * 57.2958;
    }
    qsort(slope, COUNT, sizeof slope[0], by_value);
    double lee = -slope[COUNT / 50], windward = slope[COUNT * 9 / 10];
    if (!(lee > 17.0 && lee < 30.0 && windward > 6.0 && windward < 10.0)) {
        fail_msg("lee %g, windward %g degrees", lee, windward);
    }
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

// Flows in groups cover a part of a face; what has left alcoves lies in toes, but for looser sand.
static void tongues_hold_what_left_their_alcoves(void **state)
{
    (void)state;
    enum { COUNT = 40000 };
    double taken = 0.0, laid = 0.0;
    int covered = 0;
    for (int i = 0; i < COUNT; i++) {
        SandRelief r = some_tongues(place(i, 5000));
        assert_true(fabsf(r.height) <= 1.2f && fabsf(r.tone) <= 1.0f);
        covered += r.height != 0.0f;
        taken += r.height < 0.0f ? -(double)r.height : 0.0;
        laid += r.height > 0.0f ? (double)r.height : 0.0;
    }
    if (!(covered > COUNT / 6 && covered < COUNT / 2 && laid > taken && laid < 2.0 * taken)) {
        fail_msg("%d of %d places, %g laid for %g taken", covered, COUNT, laid, taken);
    }
}

// Below an alcove, never above it, lies its toe, of coarser grains.
static void toes_lie_below_alcoves(void **state)
{
    (void)state;
    const float far = 3.0f; // m
    double below = 0.0, above = 0.0, tone = 0.0;
    int alcoves = 0;
    for (int i = 0; i < 40000; i++) {
        Vec3 p = place(i, 5000), down = vec3_madd(p, far, vec3(0.6f, 0.0f, -0.8f));
        if (some_tongues(p).height > -0.6f) {
            continue;
        }
        SandRelief low = some_tongues(down);
        SandRelief high = some_tongues(vec3_madd(p, far, vec3(-0.6f, 0.0f, 0.8f)));
        below += (double)low.height;
        above += (double)high.height;
        tone += low.height > 0.2f ? (double)low.tone : 0.0;
        alcoves++;
    }
    assert_true(alcoves > 300);
    if (!(below > above + 0.1 * alcoves && tone > 0.0)) {
        fail_msg("%g below, %g above, tone %g of %d alcoves", below, above, tone, alcoves);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ripples_are_as_far_apart_as_told),
        cmocka_unit_test(crests_fork),
        cmocka_unit_test(slopes_are_gradients),
        cmocka_unit_test(crests_wind_and_end),
        cmocka_unit_test(lee_sides_are_steep),
        cmocka_unit_test(tongues_hold_what_left_their_alcoves),
        cmocka_unit_test(toes_lie_below_alcoves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
