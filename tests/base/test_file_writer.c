// base/file_writer: files appear whole or not at all.
#include "base/file_writer.h"
#include "testing.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { LARGE = 3 << 20 };

typedef struct Folder {
    char path[64], file[96];
} Folder;

static Folder make_folder(void)
{
    Folder folder = {.path = "/tmp/ramify_writer_XXXXXX"};
    assert_non_null(mkdtemp(folder.path));
    snprintf(folder.file, sizeof folder.file, "%s/file", folder.path);
    return folder;
}

static void remove_folder(const Folder *folder)
{
    unlink(folder->file);
    assert_int_equal(rmdir(folder->path), 0); // nothing else was left in it
}

static size_t read_back(const char *file, char *bytes, size_t size)
{
    FILE *f = fopen(file, "rb");
    size_t count = f ? fread(bytes, 1, size, f) : 0;
    if (f) {
        fclose(f);
    }
    return count;
}

static void pieces_of_every_size_arrive_in_order(void **state)
{
    (void)state;
    Folder folder = make_folder();
    char *expected = malloc(LARGE), *found = malloc(LARGE + 1);
    for (size_t i = 0; i < LARGE; i++) {
        expected[i] = (char)('a' + (i * i / 7) % 26);
    }
    FileWriter *writer = file_writer_open(folder.file, NULL);
    size_t at = 0;
    for (int turn = 0; at < LARGE; turn++) {
        size_t want = turn == 9 ? (size_t)1500000 : (size_t)(1 + turn * 37 % 4096);
        size_t size = want < LARGE - at ? want : LARGE - at;
        if (turn % 3 == 0 && size <= FILE_WRITER_ROOM) {
            memcpy(file_writer_room(writer, size), expected + at, size);
        } else if (turn % 3 == 1 && size <= FILE_WRITER_ROOM) {
            file_writer_print(writer, "%.*s", (int)size, expected + at);
        } else {
            file_writer_bytes(writer, expected + at, size);
        }
        at += size;
    }
    assert_int_equal(access(folder.file, F_OK), -1);
    assert_true(file_writer_close(writer, true, NULL));
    assert_int_equal(read_back(folder.file, found, LARGE + 1), LARGE);
    assert_memory_equal(found, expected, LARGE);
    free(expected);
    free(found);
    remove_folder(&folder);
}

static void what_is_not_kept_leaves_the_old_file(void **state)
{
    (void)state;
    Folder folder = make_folder();
    FileWriter *writer = file_writer_open(folder.file, NULL);
    file_writer_text(writer, "old");
    assert_true(file_writer_close(writer, true, NULL));
    writer = file_writer_open(folder.file, NULL);
    file_writer_text(writer, "new");
    assert_false(file_writer_close(writer, false, NULL));
    char found[8] = "";
    read_back(folder.file, found, sizeof found - 1);
    assert_string_equal(found, "old");
    remove_folder(&folder);
}

static void a_full_disk_is_told(void **state)
{
    (void)state;
    Error e = {0};
    if (access("/dev/full", W_OK) == 0) { // no regular file: refused before anything is written
        assert_null(file_writer_open("/dev/full", &e));
        assert_int_equal(e.code, ERROR_IO);
    }
    assert_null(file_writer_open("/nowhere/at/all", &e));
    assert_int_equal(e.code, ERROR_IO);
    assert_non_null(strstr(e.message, "No such file"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_of_every_size_arrive_in_order),
        cmocka_unit_test(what_is_not_kept_leaves_the_old_file),
        cmocka_unit_test(a_full_disk_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
