// Pictures at falling resolutions: what lookups give, whatever the picture's size, type and window.
#include "testing.h"

#include "render/material/mip_map.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 37, HEIGHT = 23 }; // neither is halved evenly

static float value_of(int x, int y)
{
    return (float)((x * 7 + y * 13 + x * y) % 32) / 31.0f;
}

static double mean_value(void)
{
    double sum = 0.0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        sum += (double)value_of(i % WIDTH, i / WIDTH);
    }
    return sum / (WIDTH * HEIGHT);
}

// One channel of value_of, as whole numbers if the type has them.
static Texels texels_of(TexelType type, void *data)
{
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        float value = value_of(i % WIDTH, i / WIDTH);
        if (type == TEXEL_BYTE) {
            ((uint8_t *)data)[i] = (uint8_t)(value * 255.0f + 0.5f);
        } else if (type == TEXEL_SHORT) {
            ((uint16_t *)data)[i] = (uint16_t)(value * 65535.0f + 0.5f);
        } else {
            ((float *)data)[i] = value;
        }
    }
    return (Texels){WIDTH, HEIGHT, 1, type, {0, 0, 0, 0, WIDTH, HEIGHT}, data};
}

static MipMap *map_of(const Texels *texels)
{
    Error e = {0};
    MipMap *map = mip_map_new(texels, &e);
    assert_non_null(map);
    return map;
}

// A patch as large as the picture gives its mean, wherever it lies.
static void patch_of_all_is_the_mean(void **state)
{
    (void)state;
    static const TexelType types[] = {TEXEL_BYTE, TEXEL_SHORT, TEXEL_FLOAT};
    float data[WIDTH * HEIGHT];
    for (size_t t = 0; t < sizeof types / sizeof types[0]; t++) {
        Texels texels = texels_of(types[t], data);
        MipMap *map = map_of(&texels);
        float step = types[t] == TEXEL_BYTE ? 1.0f / 255.0f : 1e-4f; // rounded in each level
        for (int i = 0; i < 8; i++) {
            float value;
            mip_map_lookup(map, (Vec2){(float)i * 0.37f, (float)i * -0.73f}, 1.0f + (float)i, 2.0f,
                           1, &value);
            assert_float_equal(value, (float)mean_value(), step);
        }
        mip_map_free(map);
    }
}

// A point gives the cubic B-spline of its neighbours: 2/3 of its own texel and 1/6 of the next.
static void point_is_a_spline(void **state)
{
    (void)state;
    float data[4 * 4] = {0};
    data[4 * 1 + 2] = 9.0f; // column 2, row 1 from the top
    Texels texels = {4, 4, 1, TEXEL_FLOAT, {0, 0, 0, 0, 4, 4}, data};
    MipMap *map = map_of(&texels);
    static const struct {
        Vec2 uv;
        float value;
    } expected[] = {{{2.5f / 4, 2.5f / 4}, 4.0f},
                    {{3.5f / 4, 2.5f / 4}, 1.0f},
                    {{1.5f / 4, 1.5f / 4}, 0.25f},
                    {{0.5f / 4, 2.5f / 4}, 0.0f},
                    {{2.5f / 4 - 3, 2.5f / 4 + 5}, 4.0f}}; // repeats
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        float value;
        mip_map_lookup(map, expected[i].uv, 0.0f, 0.0f, 1, &value);
        assert_float_equal(value, expected[i].value, 1e-4f);
    }
    mip_map_free(map);
}

// Stripes along u: a patch that is long across them is grey, one that is long along them is not.
static void long_patches_blur_along_themselves(void **state)
{
    (void)state;
    enum { SIZE = 64 };
    static float data[SIZE * SIZE];
    for (int i = 0; i < SIZE * SIZE; i++) {
        data[i] = (i / SIZE) % 8 < 4 ? 1.0f : 0.0f; // rows
    }
    Texels texels = {SIZE, SIZE, 1, TEXEL_FLOAT, {0, 0, 0, 0, SIZE, SIZE}, data};
    MipMap *map = map_of(&texels);
    float across, along;
    Vec2 middle = {0.5f, 1.0f - 2.0f / SIZE}; // of the first white stripe
    mip_map_lookup(map, middle, 1.0f / SIZE, 16.0f / SIZE, 1, &across);
    mip_map_lookup(map, middle, 16.0f / SIZE, 1.0f / SIZE, 1, &along);
    assert_float_equal(across, 0.5f, 0.05f);
    assert_true(along > 0.95f);
    mip_map_free(map);
}

// Texels in a part of the picture: the rest is 0, and the mean is over the whole.
static void what_has_no_texels_is_black(void **state)
{
    (void)state;
    float data[2 * 2 * 2] = {1, 4, 1, 4, 1, 4, 1, 4};
    Texels texels = {2, 2, 2, TEXEL_FLOAT, {14, 25, 10, 20, 8, 10}, data}; // 4, 5 in 8 x 10
    MipMap *map = map_of(&texels);
    float value[2];
    mip_map_lookup(map, (Vec2){0.5f, 0.5f}, 1.0f, 1.0f, 2, value);
    assert_float_equal(value[0], 4.0f / 80.0f, 1e-3f);
    assert_float_equal(value[1], 16.0f / 80.0f, 4e-3f);
    mip_map_lookup(map, (Vec2){5.0f / 8, 1.0f - 6.0f / 10}, 0.0f, 0.0f, 2, value);
    assert_true(value[0] > 0.4f && value[1] > 4.0f * 0.4f);
    mip_map_lookup(map, (Vec2){0.1f, 0.1f}, 0.0f, 0.0f, 2, value);
    assert_float_equal(value[0], 0.0f, 1e-6f);
    mip_map_free(map);
}

// Windows of a file that lies, coordinates and footprints that are not finite: any finite value.
static void wild_numbers_do_no_harm(void **state)
{
    (void)state;
    static const int windows[][6] = {{INT32_MAX, INT32_MIN, INT32_MIN, INT32_MAX, 1, 1},
                                     {-5, -5, 0, 0, INT32_MAX, INT32_MAX},
                                     {INT32_MIN, 0, INT32_MAX, 0, INT32_MAX, 1},
                                     {0, 0, 0, 0, 1, INT32_MAX}};
    static const float wild[] = {INFINITY, -INFINITY, NAN, 1e30f, -1e-30f, 0.0f, 0.999999999f};
    float data[3 * 3] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    for (size_t w = 0; w < sizeof windows / sizeof windows[0]; w++) {
        Texels texels = {.width = 3, .height = 3, .channels = 1, .type = TEXEL_FLOAT, .data = data};
        memcpy(texels.window, windows[w], sizeof texels.window);
        MipMap *map = map_of(&texels);
        for (int i = 0; i < 7 * 7; i++) {
            float a = wild[i % 7], b = wild[i / 7], value;
            mip_map_lookup(map, (Vec2){a, b}, b, a, 1, &value);
            assert_true(value >= 0.0f && value <= 1.001f);
        }
        mip_map_free(map);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patch_of_all_is_the_mean), cmocka_unit_test(point_is_a_spline),
        cmocka_unit_test(long_patches_blur_along_themselves),
        cmocka_unit_test(what_has_no_texels_is_black), cmocka_unit_test(wild_numbers_do_no_harm)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
