// Hostile pictures: whatever is in them, reading gives pixels or an error with the file's name, and
// sizes are looked at before pixels.
#include "mutate.h"
#include "testing.h"

#include "image/image.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/ramify_pictures_XXXXXX";

static const char *path_of(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *path, const void *data, size_t size)
{
    unlink(path);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[96];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

static void refused(const char *path, const char *words)
{
    Error e = {0};
    bool linear;
    char text[8];
    assert_null(image_read(path, NULL, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, path));
    assert_non_null(strstr(e.message, words));
    assert_string_equal(e.file, ""); // the scene's place may be told
    assert_null(image_read_color(path, &linear, NULL, &e));
    assert_null(image_read_layer(path, "", "RGB", NULL, &e));
    assert_false(image_read_text(path, "Software", text, sizeof text));
    assert_null(image_read_texels(path, NULL, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, words));
}

// Formats whose size stands in a line of text; 20000 x 20000 pixels would take gigabytes.
static void sizes_are_checked_before_pixels(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *words;
    } bombs[] = {
        {"bomb.ppm", "P6\n20000 20000\n255\n", "it has 20000 x 20000 pixels; at most 134217728"},
        {"bomb.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2000000000\n",
         "pixels; at most"},
        {"bomb.pfm", "PF\n100000 100000\n-1.0\n", "it has 100000 x 100000 pixels; at most"},
    };
    struct rusage after;
    for (size_t i = 0; i < sizeof bombs / sizeof bombs[0]; i++) {
        write_file(path_of(bombs[i].name), bombs[i].text, strlen(bombs[i].text));
        refused(path_of(bombs[i].name), bombs[i].words);
    }
    getrusage(RUSAGE_CHILDREN, &after);
    assert_true(after.ru_maxrss < (1 << 20)); // kB
}

// Neither waited for nor read without end.
static void what_is_no_regular_file_is_refused(void **state)
{
    (void)state;
    assert_int_equal(mkfifo(path_of("pipe.png"), 0600), 0);
    refused(path_of("pipe.png"), "it is not a regular file");
    refused("/dev/zero", "it is not a regular file");
    refused(folder, "it is not a regular file");
    refused("some.null", "No such file"); // OpenImageIO would make a picture of the name alone
    refused("", "no name is given");
}

static size_t read_file(const char *path, unsigned char *bytes, size_t capacity)
{
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    size_t size = fread(bytes, 1, capacity, stream);
    fclose(stream);
    return size;
}

static void pixels_or_an_error(const char *path)
{
    Error e = {0};
    Image *image = image_read(path, NULL, &e);
    if (!image) {
        assert_true(e.code == ERROR_INPUT || e.code == ERROR_IO);
        assert_non_null(strstr(e.message, path));
        return;
    }
    int64_t count = (int64_t)image->width * image->height * image->channels;
    assert_true(count > 0);
    volatile float last = image->pixel[count - 1]; // all of them are there
    (void)last;
    image_free(image);
}

static void mutated_pictures_harm_nothing(void **state)
{
    (void)state;
    enum { CAPACITY = 1 << 16, TURNS = 60 };
    static const char *const names[] = {"a.png", "a.jpg", "a.exr", "a.hdr"};
    static unsigned char sound[CAPACITY], broken[CAPACITY];
    Image *image = image_new(24, 16, 3, NULL);
    for (int i = 0; i < 24 * 16 * 3; i++) {
        image->pixel[i] = (float)(i * 37 % 256) / 255.0f;
    }
    ImageLayer layer = {"", "RGB", image};
    assert_true(image_write_display(path_of(names[0]), image, NULL, NULL));
    assert_true(image_write_display(path_of(names[1]), image, NULL, NULL));
    assert_true(image_write_exr(path_of(names[2]), &layer, 1, NULL, NULL));
    image_free(image);
    char hdr[48 + 4 * 24] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 6\n";
    size_t header = strlen(hdr);
    memset(hdr + header, 0x77, 96);
    write_file(path_of(names[3]), hdr, header + 96);
    for (size_t f = 0; f < sizeof names / sizeof names[0]; f++) {
        size_t size = read_file(path_of(names[f]), sound, CAPACITY);
        Error e = {0};
        Image *whole = image_read(path_of(names[f]), NULL, &e);
        assert_non_null(whole);
        image_free(whole);
        for (int turn = 0; turn < TURNS; turn++) {
            memcpy(broken, sound, size);
            size_t now = mutate(broken, size, CAPACITY, random_key(f, (uint64_t)turn));
            write_file(path_of(names[f]), broken, now);
            pixels_or_an_error(path_of(names[f]));
        }
    }
}

// What a file stores is what a texture gets.
// The child that decodes is killed, however far it is.
static void reading_stops_when_it_is_cancelled(void **state)
{
    (void)state;
    int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    Error e = {0};
    Image *image = image_new(64, 64, 3, &e);
    assert_non_null(image);
    memset(image->pixel, 0, sizeof(float) * 64 * 64 * 3);
    assert_true(image_write_display(path_of("c.png"), image, NULL, &e));
    image_free(image);
    assert_null(image_read(path_of("c.png"), &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    assert_null(image_read_texels(path_of("c.png"), &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
}

static void texels_are_as_stored(void **state)
{
    (void)state;
    Image *image = image_new(5, 3, 4, NULL);
    for (int i = 0; i < 5 * 3 * 4; i++) {
        image->pixel[i] = i % 4 == 3 ? 1.0f : (float)(i * 4) / 255.0f;
    }
    Error e = {0};
    assert_true(image_write_display(path_of("t.png"), image, NULL, &e));
    Texels *texels = image_read_texels(path_of("t.png"), NULL, &e);
    assert_non_null(texels);
    assert_true(texels->width == 5 && texels->height == 3 && texels->channels == 4);
    assert_int_equal(texels->type, TEXEL_BYTE);
    for (int i = 0; i < 5 * 3 * 4; i++) {
        assert_int_equal(((unsigned char *)texels->data)[i], i % 4 == 3 ? 255 : i * 4);
    }
    texels_free(texels);
    ImageLayer layer = {"", "RGBA", image};
    assert_true(image_write_exr(path_of("t.exr"), &layer, 1, NULL, &e));
    texels = image_read_texels(path_of("t.exr"), NULL, &e);
    assert_non_null(texels);
    assert_int_equal(texels->type, TEXEL_FLOAT);
    assert_memory_equal(texels->data, image->pixel, sizeof(float) * 5 * 3 * 4);
    texels_free(texels);
    image_free(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_are_checked_before_pixels),
        cmocka_unit_test(what_is_no_regular_file_is_refused),
        cmocka_unit_test(mutated_pictures_harm_nothing),
        cmocka_unit_test(texels_are_as_stored),
        cmocka_unit_test(reading_stops_when_it_is_cancelled),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
