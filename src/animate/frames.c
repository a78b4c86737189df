#include "animate/frames.h"

#include "animate/checkpoint.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/random.h"
#include "config/compare.h"
#include "image/image.h"
#include "ramify.h"
#include "scene/picture.h"
#include "scene/spec.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define NAME_DIGITS 6
#define FILM_NAME "film.part"

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text, strlen(text) + 1);
}

uint64_t frame_hash(const Scene *scene)
{
    uint64_t hash = hash_text(HASH_START, RAMIFY_VERSION);
    hash = table_hash(hash, &scene_table, scene, "animation"); // which only concerns other frames
    return random_key(hash, scene->files);
}

uint64_t frames_hash(const Scene *still, const char *isa)
{
    const Table *camera_table = table_find(&scene_table, "camera")->table;
    uint64_t hash = table_hash(HASH_START, camera_table, &still->camera, NULL);
    return hash_text(hash, isa ? isa : "");
}

void frame_mark(const Scene *scene, uint64_t more, char mark[FRAME_MARK_SIZE])
{
    snprintf(mark, FRAME_MARK_SIZE, "%016" PRIx64, random_key(frame_hash(scene), more));
}

bool frame_is_finished(const char *file, const char *mark)
{
    char found[FRAME_MARK_SIZE];
    return access(file, R_OK) == 0 && image_read_text(file, PICTURE_MARK, found, sizeof found) &&
           strcmp(found, mark) == 0;
}

static char *join(const char *a, const char *b, Error *e)
{
    size_t room = strlen(a) + strlen(b) + 1;
    char *text = memory_alloc((int64_t)room, 1, e);
    if (text) {
        snprintf(text, room, "%s%s", a, b);
    }
    return text;
}

char *frames_folder(const char *film, Error *e)
{
    return join(film, ".frames", e);
}

// Percent signs in the folder's name are doubled.
char *frames_pattern(const char *folder, Error *e)
{
    char *doubled = memory_alloc_zero(2 * (int64_t)strlen(folder) + 1, 1, e), *at = doubled;
    for (const char *c = folder; doubled && *c; c++) {
        *at++ = *c;
        if (*c == '%') {
            *at++ = '%';
        }
    }
    char *pattern = doubled ? join(doubled, "/%06d.png", e) : NULL;
    free(doubled);
    return pattern;
}

char *frames_film(const char *folder, Error *e)
{
    return join(folder, "/" FILM_NAME, e);
}

static bool make_folder(const char *folder, Error *e)
{
    struct stat status;
    if (mkdir(folder, 0777) == 0) {
        return true;
    }
    int reason = errno;
    if (reason == EEXIST && stat(folder, &status) == 0 && S_ISDIR(status.st_mode)) {
        return true;
    }
    return error_set(e, ERROR_IO, "folder '%s' cannot be made: %s", folder, strerror(reason));
}

int frames_folder_take(const char *folder, Error *e)
{
    struct stat status;
    for (;;) {
        if (!make_folder(folder, e)) {
            return -1;
        }
        int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) {
            error_set(e, ERROR_IO, "folder '%s' cannot be read: %s", folder, strerror(errno));
            return -1;
        }
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(descriptor);
            error_set(e, ERROR_IO,
                      "another run has its frames in '%s'; wait for it, or name another film",
                      folder);
            return -1;
        } // file systems without locks work unlocked
        if (fstat(descriptor, &status) == 0 && status.st_nlink > 0) {
            return descriptor;
        }
        close(descriptor); // another run, just finished, has removed it
    }
}

// Does the name end so, or with ".ramify-4711-0.part" after it?
static bool is_file(const char *end, const char *wanted)
{
    size_t length = strlen(wanted);
    return strncmp(end, wanted, length) == 0 &&
           (end[length] == 0 || strncmp(end + length, ".ramify-", 8) == 0);
}

// "000012.png" or "000012.begun.exr", or what a killed run has left of them.
static bool is_frame(const char *name)
{
    size_t digits = strspn(name, "0123456789");
    return digits >= NAME_DIGITS &&
           (is_file(name + digits, ".png") || is_file(name + digits, CHECKPOINT_ENDING));
}

void frames_folder_remove(const char *folder)
{
    DIR *stream = opendir(folder);
    for (const struct dirent *entry; stream && (entry = readdir(stream));) {
        if (is_frame(entry->d_name) || strcmp(entry->d_name, FILM_NAME) == 0) {
            unlinkat(dirfd(stream), entry->d_name, 0);
        }
    }
    if (stream) {
        closedir(stream);
    }
    rmdir(folder);
}
