#include "base/number_text.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static float from_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t to_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

// Every 509th of all bit patterns: every exponent, both signs, ends of the ranges.
static void any_float_reads_back_to_the_same_bits(void **state)
{
    (void)state;
    int64_t wrong = 0, longest = 0;
#pragma omp parallel for schedule(static) reduction(+ : wrong) reduction(max : longest)
    for (int64_t bits = 0; bits < INT64_C(1) << 32; bits += 509) {
        float value = from_bits((uint32_t)bits);
        if (!isfinite(value)) {
            continue;
        }
        char text[FLOAT_TEXT_MOST + 1];
        char *end = float_text(text, value), *read;
        *end = 0;
        wrong += to_bits(strtof(text, &read)) != (uint32_t)bits || read != end;
        longest = end - text > longest ? end - text : longest;
    }
    assert_int_equal(wrong, 0);
    assert_true(longest <= FLOAT_TEXT_MOST);
}

// Against printf: no fewer digits would do, and fixed or scientific is whichever is shorter.
static void the_text_is_the_shortest(void **state)
{
    (void)state;
    for (int64_t bits = 1; bits < INT64_C(0x7f800000); bits += 20011) {
        float value = from_bits((uint32_t)bits);
        char text[FLOAT_TEXT_MOST + 1], printed[64];
        *float_text(text, value) = 0;
        int digits = 0;
        do {
            snprintf(printed, sizeof printed, "%.*e", digits++, (double)value);
        } while (strtof(printed, NULL) != value);
        assert_true(strlen(text) <= strlen(printed));
    }
}

static void plain_numbers_look_plain(void **state)
{
    (void)state;
    const struct {
        float value;
        const char *text;
    } cases[] = {{0.0f, "0"},
                 {-0.0f, "-0"},
                 {1.0f, "1"},
                 {0.1f, "0.1"},
                 {-2.5f, "-2.5"},
                 {1e-20f, "1e-20"},
                 {16777216.0f, "16777216"},
                 {INFINITY, "inf"},
                 {-INFINITY, "-inf"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[FLOAT_TEXT_MOST + 1];
        *float_text(text, cases[i].value) = 0;
        assert_string_equal(text, cases[i].text);
    }
    char text[64];
    *floats_text(text, (float[]){1.5f, -2.0f, 0.25f}, 3, ' ') = 0;
    assert_string_equal(text, "1.5 -2 0.25");
    *integer_text(text, INT64_MIN) = 0;
    assert_string_equal(text, "-9223372036854775808");
    *integer_text(text, 0) = 0;
    assert_string_equal(text, "0");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_float_reads_back_to_the_same_bits),
        cmocka_unit_test(the_text_is_the_shortest),
        cmocka_unit_test(plain_numbers_look_plain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
