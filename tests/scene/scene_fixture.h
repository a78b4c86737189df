// A temporary folder with files in it, and scenes read from text in it.
#ifndef RAMIFY_TESTS_SCENE_FIXTURE_H
#define RAMIFY_TESTS_SCENE_FIXTURE_H

#include "scene/build.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "testing.h"

typedef struct Fixture {
    char folder[64];
    char path[128];
} Fixture;

static inline int fixture_set_up(void **state)
{
    Fixture *fixture = calloc(1, sizeof *fixture);
    strcpy(fixture->folder, "/tmp/ramify_scene_XXXXXX");
    *state = fixture;
    return mkdtemp(fixture->folder) ? 0 : -1;
}

static inline int fixture_tear_down(void **state)
{
    Fixture *fixture = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", fixture->folder);
    int status = system(command);
    free(fixture);
    return status;
}

// Writes a file into the folder and returns its path, good until the next call.
static inline const char *fixture_write(Fixture *fixture, const char *name, const void *bytes,
                                        size_t size)
{
    snprintf(fixture->path, sizeof fixture->path, "%s/%s", fixture->folder, name);
    FILE *stream = fopen(fixture->path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size, stream), size);
    fclose(stream);
    return fixture->path;
}

// Reads a scene from text that must be right.
static inline Scene *fixture_read(Fixture *fixture, const char *text)
{
    Error e = {0};
    Scene *scene =
        scene_read(fixture_write(fixture, "scene.yaml", text, strlen(text)), NULL, 0, &e);
    if (!scene) {
        fail_msg("%s", e.message);
    }
    return scene;
}

// Grows the object of this name, which must be possible.
static inline OutTree *fixture_grow(const Scene *scene, const char *name, int threads)
{
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    OutTree *tree = scene_grow_object(scene, scene_find_object(scene, name), &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

// Reads a scene from text that must be refused, in these words and in this line.
static inline void fixture_refuse(Fixture *fixture, const char *text, const char *why, int line)
{
    Error e = {0};
    assert_null(scene_read(fixture_write(fixture, "scene.yaml", text, strlen(text)), NULL, 0, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    if (!strstr(e.message, why)) {
        fail_msg("'%s' does not say '%s'", e.message, why);
    }
    assert_int_equal(e.line, line);
}

#endif
