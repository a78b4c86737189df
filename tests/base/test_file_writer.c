// base/file_writer: files appear whole or not at all.
#include "base/file_beside.h"
#include "base/file_writer.h"
#include "testing.h"

#include <glob.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
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

static void write_word(const char *file, const char *word)
{
    Error e = {0};
    FileWriter *writer = file_writer_open(file, &e);
    if (!writer) {
        fail_msg("%s", e.message);
    }
    file_writer_text(writer, word);
    assert_true(file_writer_close(writer, true, &e));
}

static int entries(const char *pattern, const char *folder)
{
    char name[160];
    glob_t found;
    snprintf(name, sizeof name, "%s/%s", folder, pattern);
    int count = glob(name, 0, NULL, &found) == 0 ? (int)found.gl_pathc : 0;
    globfree(&found);
    return count;
}

static void links_stay_and_what_they_lead_to_is_written(void **state)
{
    (void)state;
    Folder folder = make_folder();
    char inner[96], first[96], second[128], target[96], found[8] = "";
    struct stat status;
    snprintf(inner, sizeof inner, "%s/inner", folder.path);
    snprintf(first, sizeof first, "%s/first", folder.path);
    snprintf(second, sizeof second, "%s/second", inner);
    snprintf(target, sizeof target, "%s/target", folder.path);
    assert_int_equal(mkdir(inner, 0700), 0);
    assert_int_equal(symlink("inner/second", first), 0);
    assert_int_equal(symlink("../target", second), 0); // which is not there
    for (int turn = 0; turn < 2; turn++) {
        const char *word = turn == 0 ? "new" : "old";
        write_word(first, word);
        assert_true(lstat(first, &status) == 0 && S_ISLNK(status.st_mode));
        assert_true(lstat(second, &status) == 0 && S_ISLNK(status.st_mode));
        assert_true(lstat(target, &status) == 0 && S_ISREG(status.st_mode));
        assert_int_equal(read_back(target, found, sizeof found), 3);
        assert_memory_equal(found, word, 3);
    }
    Error e = {0};
    assert_int_equal(unlink(target), 0);
    assert_int_equal(symlink("first", target), 0); // round and round
    assert_null(file_writer_open(first, &e));
    assert_int_equal(e.code, ERROR_IO);
    assert_true(unlink(target) == 0 && unlink(first) == 0 && unlink(second) == 0);
    assert_int_equal(rmdir(inner), 0);
    remove_folder(&folder);
}

static void pipes_are_no_outputs(void **state)
{
    (void)state;
    Folder folder = make_folder();
    Error e = {0};
    assert_int_equal(mkfifo(folder.file, 0600), 0);
    assert_null(file_writer_open(folder.file, &e));
    assert_int_equal(e.code, ERROR_IO);
    assert_null(file_open_regular(folder.file, &e)); // nor waited for as inputs
    assert_int_equal(e.code, ERROR_INPUT);
    remove_folder(&folder);
}

// A writer in another process that is killed in the middle, by a name or without one.
static void killed_writers_leave_nothing_for_long(void **state)
{
    (void)state;
    Folder folder = make_folder();
    write_word(folder.file, "old");
    pid_t child = fork();
    if (child == 0) {
        FileWriter *writer = file_writer_open(folder.file, NULL);
        char *block = calloc(1, LARGE);
        file_writer_bytes(writer, block, LARGE);
        kill(getpid(), SIGKILL);
    }
    assert_int_equal(waitpid(child, NULL, 0), child);
    char stale[160], held[160], other[160], found[8] = "";
    snprintf(stale, sizeof stale, "%s.ramify-4711-0.part", folder.file);
    snprintf(held, sizeof held, "%s.ramify-4711-1.part", folder.file);
    snprintf(other, sizeof other, "%s/other.ramify-4711-0.part", folder.path);
    fclose(fopen(stale, "w")); // as where files need names
    fclose(fopen(other, "w"));
    FILE *writing = fopen(held, "w"); // by a run that goes on
    assert_int_equal(flock(fileno(writing), LOCK_EX), 0);
    assert_int_equal(read_back(folder.file, found, sizeof found), 3);
    assert_memory_equal(found, "old", 3);
    write_word(folder.file, "new");
    assert_int_equal(read_back(folder.file, found, sizeof found), 3);
    assert_memory_equal(found, "new", 3);
    assert_int_equal(access(stale, F_OK), -1);
    assert_int_equal(access(held, F_OK), 0);
    assert_int_equal(access(other, F_OK), 0); // another file's
    assert_int_equal(entries("*.part", folder.path), 2);
    fclose(writing);
    assert_true(unlink(held) == 0 && unlink(other) == 0);
    remove_folder(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_of_every_size_arrive_in_order),
        cmocka_unit_test(what_is_not_kept_leaves_the_old_file),
        cmocka_unit_test(a_full_disk_is_told),
        cmocka_unit_test(links_stay_and_what_they_lead_to_is_written),
        cmocka_unit_test(pipes_are_no_outputs),
        cmocka_unit_test(killed_writers_leave_nothing_for_long),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
