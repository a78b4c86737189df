// Broken Esri ASCII grids: heights or an error that names the file.
#include "mutate.h"
#include "testing.h"

#include "base/memory.h"
#include "land/height_measure.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
enum { COPIES = 3000 };
#else
enum { COPIES = 12000 };
#endif

static const char FILE_NAME[] = "/tmp/ramify_test_asc_hostile.asc";
static const char SOUND[] = "ncols 4\nnrows 3\nxllcorner 10.5\nyllcorner -20\ncellsize 30\n"
                            "NODATA_value -9999\n1 2 3 4\r\n5 -9999 7.5 8e2\n9 10 11 12\n";

static void write_file(const void *data, size_t size)
{
    unlink(FILE_NAME); // cut to nothing instead, some file systems wait for the disk
    FILE *stream = fopen(FILE_NAME, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

static void heights_or_error(void)
{
    Error e = {0};
    HeightField *field = height_field_read_asc(FILE_NAME, &e);
    if (!field) {
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, FILE_NAME);
        return;
    }
    for (int64_t i = 0; i < height_field_count(field); i++) {
        assert_true(!isinf(field->height[i]));
    }
    height_field_free(field);
}

static void survives_broken_copies(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < COPIES; k++) {
        unsigned char copy[1024];
        memcpy(copy, SOUND, sizeof SOUND - 1);
        size_t size = mutate(copy, sizeof SOUND - 1, sizeof copy, random_key(5, k));
        write_file(copy, size);
        heights_or_error();
    }
    unlink(FILE_NAME);
}

// A gigabyte of heights that are not there.
static void takes_no_memory_for_promises(void **state)
{
    (void)state;
    static const char text[] =
        "ncols 16384\nnrows 16384\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n";
    Error e = {0};
    int64_t before = memory_peak();
    write_file(text, sizeof text - 1);
    assert_null(height_field_read_asc(FILE_NAME, &e));
    unlink(FILE_NAME);
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.file, FILE_NAME);
    assert_non_null(strstr(e.message, "16384 x 16384 heights are promised"));
    assert_true(memory_peak() - before < 100000000);
}

static void reads_the_same_in_every_locale(void **state)
{
    (void)state;
    write_file(SOUND, sizeof SOUND - 1);
    setlocale(LC_ALL, "de_DE.UTF-8"); // where it is installed
    HeightField *field = height_field_read_asc(FILE_NAME, NULL);
    setlocale(LC_ALL, "C");
    unlink(FILE_NAME);
    assert_non_null(field);
    height_field_free(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(survives_broken_copies),
        cmocka_unit_test(takes_no_memory_for_promises),
        cmocka_unit_test(reads_the_same_in_every_locale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
