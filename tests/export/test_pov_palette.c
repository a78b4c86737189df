// Palettes of the POV-Ray export: few colours, whose mean is that of the many.
#include "testing.h"

#include "base/random.h"
#include "export/pov/palette.h"

#include <stdlib.h>

enum { PLACES = 20000 };

// Two families of colours: greens, and bright greys. Among the greens, the second colour is twice
// the first.
static void fill(Vec3 *color, Vec3 *second)
{
    for (int i = 0; i < PLACES; i++) {
        float a = random_unit(random_key(1, (uint64_t)i)),
              b = random_unit(random_key(2, (uint64_t)i));
        color[i] = i % 3 ? vec3(0.1f * a, 0.2f + 0.2f * b, 0.05f) : vec3_splat(0.7f + 0.2f * a);
        second[i] = i % 3 ? vec3_scale(color[i], 2.0f) : vec3_splat(0.0f);
    }
}

static float largest_off(Vec3 a, Vec3 b)
{
    Vec3 d = vec3_sub(a, b);
    return fmaxf(fabsf(d.x), fmaxf(fabsf(d.y), fabsf(d.z)));
}

// Mean of what the palette gives minus the mean of what it was given.
static float mean_off(const Vec3 *given, const Vec3 *entry, const uint8_t *index)
{
    double sum[3] = {0};
    for (int i = 0; i < PLACES; i++) {
        Vec3 d = vec3_sub(entry[index[i]], given[i]);
        sum[0] += (double)d.x;
        sum[1] += (double)d.y;
        sum[2] += (double)d.z;
    }
    return (float)(fmax(fabs(sum[0]), fmax(fabs(sum[1]), fabs(sum[2]))) / PLACES);
}

static void test_keeps_the_mean(void **state)
{
    (void)state;
    static Vec3 color[PLACES], second[PLACES];
    static uint8_t index[PLACES];
    Palette palette;
    fill(color, second);
    for (int most = 1; most <= 256; most *= 4) {
        assert_true(palette_make(color, second, PLACES, most, &palette, index, NULL));
        assert_in_range(palette.count, 1, most);
        assert_true(mean_off(color, palette.color, index) < 1e-6f);
        assert_true(mean_off(second, palette.second, index) < 1e-6f);
        for (int i = 0; i < PLACES; i++) {
            assert_true(index[i] < palette.count);
        }
    }
}

static void test_more_entries_are_nearer(void **state)
{
    (void)state;
    static Vec3 color[PLACES], second[PLACES];
    static uint8_t index[PLACES];
    Palette palette;
    fill(color, second);
    double before = INFINITY;
    for (int most = 1; most <= 256; most *= 4) {
        assert_true(palette_make(color, second, PLACES, most, &palette, index, NULL));
        double sum = 0.0;
        for (int i = 0; i < PLACES; i++) {
            sum += (double)largest_off(palette.color[index[i]], color[i]);
        }
        assert_true(sum < 0.6 * before);
        before = sum;
    }
    assert_true(before / PLACES < 0.01);
}

static void test_few_colors_stay_as_they_are(void **state)
{
    (void)state;
    const Vec3 color[5] = {{0, 0, 0}, {1, 1, 1}, {0.5f, 0.1f, 0.2f}, {1, 1, 1}, {0.5f, 0.1f, 0.2f}};
    uint8_t index[5];
    Palette palette;
    assert_true(palette_make(color, NULL, 5, 256, &palette, index, NULL));
    assert_int_equal(palette.count, 3);
    for (int i = 0; i < 5; i++) {
        assert_true(largest_off(palette.color[index[i]], color[i]) < 1e-6f);
    }
    assert_true(palette_make(color, NULL, 1, 256, &palette, index, NULL));
    assert_int_equal(palette.count, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_keeps_the_mean),
        cmocka_unit_test(test_more_entries_are_nearer),
        cmocka_unit_test(test_few_colors_stay_as_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
