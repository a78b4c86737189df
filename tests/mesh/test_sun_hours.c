// Hours of sun against closed forms of spherical astronomy, and against rays.
#include "testing.h"

#include "base/random.h"
#include "land/sun_hours.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 61, ROWS = 47, COUNT = COLUMNS * ROWS, EQUINOX = 80 };
static const double PI = 3.14159265358979323846;

typedef float Surface(float x, float z);

static HeightField *make(Surface *surface)
{
    HeightField *field =
        height_field_new(COLUMNS, ROWS, (Vec2){10.0f, 8.0f}, (Vec2){-300.0f, -184.0f}, NULL);
    assert_non_null(field);
    for (int i = 0; i < COUNT; i++) {
        int column = i % COLUMNS, row = i / COLUMNS;
        field->height[i] = surface(field->origin.x + field->cell.x * (float)column,
                                   field->origin.y + field->cell.y * (float)row);
    }
    return field;
}

static void find(const HeightField *field, float latitude, int day, int threads, float hours[COUNT])
{
    Run run = run_default();
    run.threads = threads;
    assert_true(sun_hours(field, latitude, day, hours, &run, NULL));
}

static float level(float x, float z)
{
    (void)x;
    (void)z;
    return 30.0f;
}

static double declination(int day)
{
    return asin(0.39779 * sin(2.0 * PI * (day - EQUINOX) / 365.0));
}

static void days_are_as_long_as_astronomy_tells(void **state)
{
    (void)state;
    const struct {
        float latitude;
        int day;
    } cases[] = {{0.0f, EQUINOX}, {0.0f, 172},  {45.0f, 172}, {-33.0f, 15},
                 {60.0f, 340},    {80.0f, 172}, {80.0f, 355}};
    HeightField *field = make(level);
    static float hours[COUNT];
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double latitude = (double)cases[k].latitude * PI / 180.0;
        double cosine = -tan(latitude) * tan(declination(cases[k].day));
        double wanted = 24.0 / PI * acos(fmin(fmax(cosine, -1.0), 1.0));
        find(field, cases[k].latitude, cases[k].day, 2, hours);
        for (int i = 0; i < COUNT; i++) {
            assert_true(fabs((double)hours[i] - wanted) < 0.01);
        }
    }
    const float latitudes[] = {0.0f, 45.0f, -70.0f, 90.0f};
    for (int k = 0; k < 4; k++) { // half of each year is day, anywhere
        find(field, latitudes[k], 0, 2, hours);
        assert_true(fabsf(hours[COUNT / 2] - 12.0f) < 0.03f);
    }
    height_field_free(field);
}

static float falls_east(float x, float z)
{
    (void)z;
    return 300.0f - 0.5f * x;
}

// At the equator at equinox the sun passes through the zenith, 15 degrees an hour.
static void a_slope_hides_the_sun_behind_itself(void **state)
{
    (void)state;
    HeightField *field = make(falls_east);
    static float hours[COUNT];
    find(field, 0.0f, EQUINOX, 2, hours);
    float wanted = 12.0f - atanf(0.5f) * 180.0f / (float)PI / 15.0f;
    for (int i = 0; i < COUNT; i++) {
        bool rim = i % COLUMNS == 0; // nothing rises beyond it
        assert_true(fabsf(hours[i] - (rim ? 12.0f : wanted)) < 0.02f);
    }
    height_field_free(field);
}

// From north to south, 200 m wide and 80 m deep, its walls on samples.
static float trench(float x, float z)
{
    (void)z;
    return fabsf(x) >= 100.0f ? 80.0f : 0.0f;
}

static void walls_of_a_trench_cut_the_day(void **state)
{
    (void)state;
    HeightField *field = make(trench);
    static float hours[COUNT];
    find(field, 0.0f, EQUINOX, 2, hours);
    for (int column = 0; column < COLUMNS; column++) {
        float x = field->origin.x + field->cell.x * (float)column, lost = 0.0f;
        if (fabsf(x) < 95.0f) {
            lost = (atanf(80.0f / (100.0f - x)) + atanf(80.0f / (100.0f + x))) * 180.0f / (float)PI;
        }
        assert_true(fabsf(hours[ROWS / 2 * COLUMNS + column] - (12.0f - lost / 15.0f)) < 0.03f);
    }
    height_field_free(field);
}

static float hills(float x, float z)
{
    return 60.0f * sinf(0.021f * x + 1.0f) * cosf(0.027f * z) + 8.0f * sinf(0.06f * (x + 0.7f * z));
}

static bool is_lit(const HeightField *field, Vec3 p, Vec3 to_sun)
{
    for (float t = 2.0f; t < 900.0f; t += 2.0f) {
        float x = p.x + t * to_sun.x, z = p.z + t * to_sun.z, y = p.y + t * to_sun.y;
        float u = (x - field->origin.x) / field->cell.x, v = (z - field->origin.y) / field->cell.y;
        if (u < 0.0f || v < 0.0f || u > COLUMNS - 1.0f || v > ROWS - 1.0f) {
            return true;
        }
        if (height_field_at(field, x, z) > y + 1e-3f) {
            return false;
        }
    }
    return true;
}

// The sun in steps of three minutes, each looked for along a ray.
static double hours_by_rays(const HeightField *field, int sample, double latitude, int day)
{
    enum { STEPS = 480 };
    double d = declination(day), sum = 0.0;
    Vec3 p =
        vec3(field->origin.x + field->cell.x * (float)(sample % COLUMNS), field->height[sample],
             field->origin.y + field->cell.y * (float)(sample / COLUMNS));
    for (int i = 0; i < STEPS; i++) {
        double h = 2.0 * PI * ((i + 0.5) / STEPS - 0.5);
        double up = sin(latitude) * sin(d) + cos(latitude) * cos(d) * cos(h);
        double north = cos(latitude) * sin(d) - sin(latitude) * cos(d) * cos(h);
        Vec3 to_sun = vec3((float)(-cos(d) * sin(h)), (float)up, (float)-north);
        sum += up > 0.0 && is_lit(field, p, to_sun) ? 24.0 / STEPS : 0.0;
    }
    return sum;
}

static void hills_shade_each_other_as_rays_find(void **state)
{
    (void)state;
    HeightField *field = make(hills);
    static float hours[COUNT];
    find(field, 47.0f, 60, 2, hours);
    double squares = 0.0, least = 24.0, most = 0.0;
    int count = 0;
    for (int i = COLUMNS * 3 + 5; i < COUNT - COLUMNS * 3; i += 29, count++) {
        double wanted = hours_by_rays(field, i, 47.0 * PI / 180.0, 60);
        double off = (double)hours[i] - wanted;
        squares += off * off;
        least = fmin(least, wanted);
        most = fmax(most, wanted);
    }
    assert_true(most - least > 3.0); // else nothing is tested
    double deviation = sqrt(squares / count);
    if (!(deviation < 0.25)) {
        fail_msg("%g h from rays", deviation);
    }
    height_field_free(field);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    HeightField *field = make(hills);
    static float one[COUNT], many[COUNT];
    find(field, 30.0f, 0, 1, one);
    find(field, 30.0f, 0, 5, many);
    assert_memory_equal(one, many, sizeof one);
    height_field_free(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(days_are_as_long_as_astronomy_tells),
        cmocka_unit_test(a_slope_hides_the_sun_behind_itself),
        cmocka_unit_test(walls_of_a_trench_cut_the_day),
        cmocka_unit_test(hills_shade_each_other_as_rays_find),
        cmocka_unit_test(threads_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
