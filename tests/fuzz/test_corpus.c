// The seeds of libFuzzer's targets, and the inputs that once failed, which are kept beside them:
// each is read again as `make fuzz` reads it, in memory of its own size, and within a time limit.
#include "testing.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define LLVMFuzzerTestOneInput fuzz_heights
#include "fuzz/fuzz_heights.c"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_mesh
int fuzz_mesh(const uint8_t *data, size_t size);
#include "fuzz/fuzz_mesh.c"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_picture
int fuzz_picture(const uint8_t *data, size_t size);
#include "fuzz/fuzz_picture.c"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_rules
int fuzz_rules(const uint8_t *data, size_t size);
#include "fuzz/fuzz_rules.c"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_scene
int fuzz_scene(const uint8_t *data, size_t size);
#include "fuzz/fuzz_scene.c"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_set
int fuzz_set(const uint8_t *data, size_t size);
#include "fuzz/fuzz_set.c"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_swc
int fuzz_swc(const uint8_t *data, size_t size);
#include "fuzz/fuzz_swc.c"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_vdb
int fuzz_vdb(const uint8_t *data, size_t size);
#include "fuzz/fuzz_vdb.c"
#undef LLVMFuzzerTestOneInput

enum { SECONDS = 120, LARGEST = 1 << 20 };

static const char *folder_of(const char *target)
{
    static char path[64];
    snprintf(path, sizeof path, "tests/fuzz/corpus/%s", target);
    return path;
}

// Reads every file of the target's folder; the number of files.
static int replay(const char *target, int (*read)(const uint8_t *data, size_t size))
{
    DIR *folder = opendir(folder_of(target));
    assert_non_null(folder);
    uint8_t *bytes = malloc(LARGEST);
    assert_non_null(bytes);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", folder_of(target), entry->d_name);
        FILE *stream = entry->d_name[0] == '.' ? NULL : fopen(path, "rb");
        if (!stream) {
            continue;
        }
        size_t size = fread(bytes, 1, LARGEST, stream);
        fclose(stream);
        fprintf(stderr, "%s\n", path); // the last one is that which fails
        alarm(SECONDS);
        uint8_t *tight = malloc(size ? size : 1); // so that a sanitizer sees the end
        assert_non_null(tight);
        memcpy(tight, bytes, size);
        read(tight, size);
        free(tight);
        alarm(0);
        count++;
    }
    free(bytes);
    closedir(folder);
    return count;
}

static void test_corpora(void **state)
{
    (void)state;
    assert_true(replay("heights", fuzz_heights) >= 2);
    assert_true(replay("mesh", fuzz_mesh) >= 5);
    assert_true(replay("picture", fuzz_picture) >= 6);
    assert_true(replay("rules", fuzz_rules) >= 3);
    assert_true(replay("scene", fuzz_scene) >= 10);
    assert_true(replay("set", fuzz_set) >= 3);
    assert_true(replay("swc", fuzz_swc) >= 4);
    assert_true(replay("vdb", fuzz_vdb) >= 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_corpora)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
