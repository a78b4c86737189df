// Image files: round trips with metadata, and failures that harm nothing.
#include "image/image.h"
#include "image/quantise.h"

#include "base/file_replace.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[64];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/ramify-image-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[96];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

static const char *path_of(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static int files_in_folder(void)
{
    DIR *handle = opendir(folder);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(handle));) {
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    }
    closedir(handle);
    return count;
}

static Image *gradient(int width, int height, int channels)
{
    Image *image = image_new(width, height, channels, NULL);
    assert_non_null(image);
    for (int i = 0; i < width * height * channels; i++) {
        image->pixel[i] = (float)((i * 37) % 256) / 255.0f;
    }
    return image;
}

// Everything a file holds; the caller frees.
static char *contents(const char *path, long *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *size = ftell(file);
    rewind(file);
    char *bytes = malloc((size_t)*size + 1);
    assert_int_equal(fread(bytes, 1, (size_t)*size, file), *size);
    bytes[*size] = '\0';
    fclose(file);
    return bytes;
}

static bool holds(const char *bytes, long size, const char *text)
{
    return memmem(bytes, (size_t)size, text, strlen(text)) != NULL;
}

static const char METADATA[] = "ramify:scene\0tree:\n  seed: 7\n\0ramify:samples\0"
                               "256\0";

// Values that are multiples of 1/255 pass the dither unchanged.
static void test_png_round_trip(void **state)
{
    (void)state;
    for (int channels = 3; channels <= 4; channels++) {
        Image *image = gradient(61, 33, channels);
        Error e = {0};
        assert_true(image_write_display(path_of("a.png"), image, METADATA, &e));
        Image *back = image_read(path_of("a.png"), NULL, &e);
        assert_non_null(back);
        assert_int_equal(back->channels, channels);
        for (int i = 0; i < 61 * 33 * channels; i++) {
            assert_float_equal(back->pixel[i], image->pixel[i], 1e-6f);
        }
        image_free(image);
        image_free(back);
    }
    long size;
    char *bytes = contents(path_of("a.png"), &size);
    assert_true(holds(bytes, size, "ramify:scene") && holds(bytes, size, "seed: 7"));
    free(bytes);
}

// A level between two steps comes out as both, in the right proportion.
static void test_dither(void **state)
{
    (void)state;
    Image *image = image_new(64, 64, 3, NULL);
    for (int i = 0; i < 64 * 64 * 3; i++) {
        image->pixel[i] = 100.25f / 255.0f;
    }
    assert_true(image_write_display(path_of("d.png"), image, NULL, NULL));
    Image *back = image_read(path_of("d.png"), NULL, NULL);
    double sum = 0.0;
    for (int i = 0; i < 64 * 64 * 3; i++) {
        sum += (double)(back->pixel[i] * 255.0f);
    }
    assert_true(fabs(sum / (64 * 64 * 3) - 100.25) < 0.02);
    image_free(image);
    image_free(back);
}

// The means over squares of a slow gradient, as of a sky, follow it more closely than with white
// noise.
static void test_no_bands(void **state)
{
    (void)state;
    enum { SIZE = 512 };
    for (int square = 4; square <= 16; square *= 4) {
        double worst = 0.0, squares = 0.0;
        for (int i = 0; i < SIZE / square * (SIZE / square); i++) {
            int left = i % (SIZE / square) * square, top = i / (SIZE / square) * square;
            double error = 0.0;
            for (int k = 0; k < square * square; k++) {
                int x = left + k % square, y = top + k / square;
                float value = (150.0f + 3.0f * ((float)x + 0.3f * (float)y) / SIZE) / 255.0f;
                error += quantise_dithered(value, x, y, 2) - (double)(value * 255.0f);
            }
            error /= square * square;
            worst = fmax(worst, fabs(error));
            squares += error * error * square * square / (SIZE * SIZE);
        }
        double white = sqrt(1.0 / 6.0) / square; // f (1 - f) of a step, over all f
        assert_true(sqrt(squares) < 0.55 * white && worst < 1.5 * white);
    }
}

// As test_png_round_trip, with 257 times as many steps.
static void test_png_of_16_bits(void **state)
{
    (void)state;
    for (int channels = 3; channels <= 4; channels++) {
        Image *image = image_new(61, 33, channels, NULL);
        for (int i = 0; i < 61 * 33 * channels; i++) {
            image->pixel[i] = (float)(i * 7 % 65536) / 65535.0f;
        }
        image->pixel[0] = -1.0f;
        image->pixel[1] = 2.0f;
        image->pixel[2] = NAN;
        Error e = {0};
        assert_true(image_write_display16(path_of("deep.png"), image, METADATA, &e));
        Image *back = image_read(path_of("deep.png"), NULL, &e);
        assert_non_null(back);
        assert_int_equal(back->channels, channels);
        for (int i = 3; i < 61 * 33 * channels; i++) {
            assert_float_equal(back->pixel[i], image->pixel[i], 1e-6f);
        }
        assert_true(back->pixel[0] == 0.0f && back->pixel[1] == 1.0f && back->pixel[2] == 0.0f);
        image_free(image);
        image_free(back);
    }
}

// Pictures and films: within a step of the value, black stays black, and all of a dark gradient's
// levels are there on the mean.
static void test_quantise(void **state)
{
    (void)state;
    for (int level = 0; level <= 80; level++) {
        double value = 0.05 * level, sum = 0.0;
        for (int i = 0; i < 64 * 64; i++) {
            int x = i % 64, y = i / 64, step = quantise_dithered((float)(value / 255.0), x, y, 1);
            assert_true(fabs(step - value) < 1.0);
            sum += step;
        }
        assert_true(fabs(sum / (64 * 64) - value) < 0.03);
    }
    assert_int_equal(quantise_dithered(NAN, 3, 4, 0), 0);
    assert_int_equal(quantise_dithered(-1.0f, 3, 4, 0), 0);
    assert_int_equal(quantise_dithered(2.0f, 3, 4, 0), 255);
    assert_int_equal(quantise_nearest(0.5f), 128);
}

static void test_jpeg(void **state)
{
    (void)state;
    Image *image = image_new(64, 48, 4, NULL);
    for (int i = 0; i < 64 * 48; i++) {
        float x = (float)(i % 64) / 63.0f;
        float p[4] = {x, 0.5f, 1.0f - x, 1.0f};
        memcpy(image->pixel + 4 * i, p, sizeof p);
    }
    size_t long_size = 200000; // more than a marker holds: cut, not refused
    char *metadata = calloc(long_size + 64, 1);
    strcpy(metadata, "scene");
    memset(metadata + 6, 'x', long_size);
    Error e = {0};
    assert_true(image_write_display(path_of("a.jpg"), image, metadata, &e));
    Image *back = image_read(path_of("a.jpg"), NULL, &e);
    assert_non_null(back);
    assert_int_equal(back->channels, 3);
    for (int i = 0; i < 64 * 48; i++) {
        for (int c = 0; c < 3; c++) {
            assert_float_equal(back->pixel[3 * i + c], image->pixel[4 * i + c], 0.03f);
        }
    }
    free(metadata);
    image_free(image);
    image_free(back);
}

static void test_exr_round_trip(void **state)
{
    (void)state;
    Image *beauty = gradient(40, 30, 4), *normal = gradient(40, 30, 3),
          *depth = gradient(40, 30, 1);
    beauty->pixel[0] = 1e30f;
    depth->pixel[5] = INFINITY;
    normal->pixel[7] = -2.5f;
    ImageLayer layers[3] = {{"", "RGBA", beauty}, {"normal", "XYZ", normal}, {"depth", "Z", depth}};
    Error e = {0};
    assert_true(image_write_exr(path_of("a.exr"), layers, 3, METADATA, &e));
    Image *back = image_read(path_of("a.exr"), NULL, &e);
    assert_non_null(back);
    assert_int_equal(back->channels, 8);
    long size;
    char *bytes = contents(path_of("a.exr"), &size);
    assert_true(holds(bytes, size, "normal.X") && holds(bytes, size, "depth.Z"));
    assert_true(holds(bytes, size, "ramify:scene") && holds(bytes, size, "seed: 7"));
    // the file's channels come back in some order: find each plane by its first row
    for (int i = 0; i < 40 * 30; i++) {
        const float *p = back->pixel + 8 * i;
        assert_memory_equal(p, beauty->pixel + 4 * i, 4 * sizeof(float));
        int found = 0;
        for (int c = 4; c < 8; c++) {
            for (int k = 0; k < 3; k++) {
                found |= p[c] == normal->pixel[3 * i + k] ? 1 << k : 0;
            }
            found |= p[c] == depth->pixel[i] ? 8 : 0;
        }
        assert_int_equal(found, 15);
    }
    free(bytes);
    image_free(beauty);
    image_free(normal);
    image_free(depth);
    image_free(back);
}

// The same image twice is the same file twice: no dates inside.
static void test_same_bytes(void **state)
{
    (void)state;
    Image *image = gradient(40, 30, 3);
    ImageLayer layer = {"", "RGB", image};
    long size[2];
    char *bytes[2];
    for (int i = 0; i < 2; i++) {
        assert_true(image_write_exr(path_of(i ? "two.exr" : "one.exr"), &layer, 1, METADATA, NULL));
        bytes[i] = contents(path_of(i ? "two.exr" : "one.exr"), &size[i]);
        if (!i) {
            sleep(1);
        }
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], (size_t)size[0]);
    free(bytes[0]);
    free(bytes[1]);
    image_free(image);
}

// Heights go out as 16-bit grey and as float: as near as 16 bits allow, and to the bit.
static void test_height_round_trips(void **state)
{
    (void)state;
    enum { WIDTH = 257, HEIGHT = 31 };
    Image *image = image_new(WIDTH, HEIGHT, 1, NULL);
    assert_non_null(image);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        image->pixel[i] = (float)i / (WIDTH * HEIGHT - 1);
    }
    image->pixel[7] = -0.5f; // beyond the range: its ends
    image->pixel[8] = 1.5f;
    Error e = {0};
    ImageLayer layer = {"", "Y", image};
    assert_true(image_write_grey16(path_of("land.png"), image, METADATA, &e));
    assert_true(image_write_exr(path_of("land.exr"), &layer, 1, METADATA, &e));
    Image *grey = image_read(path_of("land.png"), NULL, &e),
          *exact = image_read(path_of("land.exr"), NULL, &e);
    assert_non_null(grey);
    assert_non_null(exact);
    assert_true(grey->width == WIDTH && grey->height == HEIGHT && grey->channels == 1);
    assert_true(exact->width == WIDTH && exact->height == HEIGHT && exact->channels == 1);
    assert_memory_equal(exact->pixel, image->pixel, sizeof(float) * WIDTH * HEIGHT);
    image->pixel[7] = 0.0f;
    image->pixel[8] = 1.0f;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_float_equal(grey->pixel[i], image->pixel[i], 0.501f / 65535.0f);
    }
    long size;
    char *bytes = contents(path_of("land.png"), &size);
    assert_true(holds(bytes, size, "ramify:samples"));
    free(bytes);
    Image *colour = gradient(8, 8, 3);
    assert_false(image_write_grey16(path_of("b.png"), colour, NULL, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    image_free(colour);
    image_free(image);
    image_free(grey);
    image_free(exact);
}

static void expect_error(bool done, const Error *e, ErrorCode code, const char *part)
{
    assert_false(done);
    assert_int_equal(e->code, code);
    if (!strstr(e->message, part)) {
        fail_msg("'%s' is not in '%s'", part, e->message);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    Image *image = gradient(8, 8, 3), *two = gradient(8, 8, 2);
    Error e = {0};
    expect_error(image_write_display16(path_of("a.jpg"), image, NULL, &e), &e, ERROR_INPUT,
                 "must be named .png");
    expect_error(image_write_display("/nowhere/at/all.png", image, NULL, &e), &e, ERROR_IO,
                 "'/nowhere/at/all.png' cannot be written: No such file or directory");
    expect_error(image_write_display(path_of("a.tiff"), image, NULL, &e), &e, ERROR_INPUT,
                 "must end in .png, .jpg or .jpeg");
    expect_error(image_write_display(path_of("a.png"), two, NULL, &e), &e, ERROR_INPUT,
                 "2 channels; 3 or 4 would do");
    expect_error(file_replace("/dev/full", "x", 1, &e), &e, ERROR_IO, "not a regular file");
    expect_error(file_replace(folder, "x", 1, &e), &e, ERROR_IO, "not a regular file");
    ImageLayer layers[2] = {{"", "RGB", image}, {"two", "X", two}};
    expect_error(image_write_exr(path_of("a.exr"), layers, 2, NULL, &e), &e, ERROR_INPUT,
                 "layer 'two' has 2 channels but the names 'X'");
    expect_error(image_write_exr(path_of("a.exr"), layers, 0, NULL, &e), &e, ERROR_INPUT,
                 "no layers");
    expect_error(image_read(path_of("missing.png"), NULL, &e) != NULL, &e, ERROR_INPUT,
                 "missing.png");
    expect_error(image_new(0, 5, 3, &e) != NULL, &e, ERROR_INPUT, "0 x 5");
    expect_error(image_new(2000000000, 2000000000, 2000000000, &e) != NULL, &e, ERROR_MEMORY, "");
    image_free(image);
    image_free(two);
}

static void test_broken_file(void **state)
{
    (void)state;
    Image *image = gradient(100, 100, 3);
    ImageLayer layer = {"", "RGB", image};
    assert_true(image_write_exr(path_of("cut.exr"), &layer, 1, NULL, NULL));
    assert_int_equal(truncate(path_of("cut.exr"), 2000), 0);
    Error e = {0};
    expect_error(image_read(path_of("cut.exr"), NULL, &e) != NULL, &e, ERROR_INPUT, "cut.exr");
    FILE *file = fopen(path_of("text.png"), "w");
    fputs("this is no picture", file);
    fclose(file);
    expect_error(image_read(path_of("text.png"), NULL, &e) != NULL, &e, ERROR_INPUT, "text.png");
    image_free(image);
}

// A disk that fills up while writing: the limit on file sizes plays the disk.
static void test_full_disk(void **state)
{
    (void)state;
    Image *old = gradient(8, 8, 3), *image = gradient(300, 300, 3);
    for (int i = 0; i < 300 * 300 * 3; i++) { // not compressible
        image->pixel[i] = (float)((uint32_t)i * 2654435761u >> 8) / 16777216.0f;
    }
    assert_true(image_write_display(path_of("full.png"), old, NULL, NULL));
    long size, after_size;
    char *before = contents(path_of("full.png"), &size);
    int files = files_in_folder();

    struct rlimit limit, tight;
    getrlimit(RLIMIT_FSIZE, &limit);
    tight = limit;
    tight.rlim_cur = 4096;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &tight);
    Error e = {0};
    bool png = image_write_display(path_of("full.png"), image, NULL, &e);
    ImageLayer layer = {"", "RGB", image};
    bool exr = image_write_exr(path_of("new.exr"), &layer, 1, NULL, NULL);
    setrlimit(RLIMIT_FSIZE, &limit);
    signal(SIGXFSZ, SIG_DFL);

    expect_error(png, &e, ERROR_IO, "full.png' cannot be written: File too large");
    assert_false(exr);
    char *after = contents(path_of("full.png"), &after_size);
    assert_int_equal(size, after_size);
    assert_memory_equal(before, after, (size_t)size);
    assert_int_equal(files_in_folder(), files);
    free(before);
    free(after);
    image_free(old);
    image_free(image);
}

// A link stays a link, and the file keeps its permissions.
static void test_link_and_mode(void **state)
{
    (void)state;
    char target[128];
    strcpy(target, path_of("target.png"));
    Image *image = gradient(8, 8, 3);
    assert_true(image_write_display(target, image, NULL, NULL));
    assert_int_equal(chmod(target, 0640), 0);
    assert_int_equal(symlink(target, path_of("link.png")), 0);
    assert_true(image_write_display(path_of("link.png"), image, NULL, NULL));
    struct stat status;
    assert_int_equal(lstat(path_of("link.png"), &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(stat(target, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0640);
    image_free(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_png_round_trip),     cmocka_unit_test(test_dither),
        cmocka_unit_test(test_no_bands),           cmocka_unit_test(test_png_of_16_bits),
        cmocka_unit_test(test_quantise),           cmocka_unit_test(test_jpeg),
        cmocka_unit_test(test_exr_round_trip),     cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_refusals),           cmocka_unit_test(test_broken_file),
        cmocka_unit_test(test_full_disk),          cmocka_unit_test(test_link_and_mode),
        cmocka_unit_test(test_height_round_trips),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
