#include "base/file_beside.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    MOST_LINKS = 40,
    MOST_ATTEMPTS = 10000,
    KEPT_NAME = 200 // most bytes of the target's name in its new file's name
};

static bool io_error(Error *e, const char *file, int reason)
{
    return error_set(e, ERROR_IO, "'%s' cannot be written: %s", file, strerror(reason));
}

// Length of the folder's name with its slash; 0 = none.
static int folder_length(const char *file)
{
    const char *slash = strrchr(file, '/');
    return slash ? (int)(slash - file) + 1 : 0;
}

bool file_target(const char *file, char target[PATH_MAX], Error *e)
{
    struct stat status;
    if (strlen(file) >= PATH_MAX) {
        return io_error(e, file, ENAMETOOLONG);
    }
    memcpy(target, file, strlen(file) + 1);
    for (int i = 0; i <= MOST_LINKS; i++) {
        char link[PATH_MAX], next[2 * PATH_MAX];
        ssize_t length = readlink(target, link, sizeof link - 1);
        if (length < 0) { // not a link, or missing
            return stat(target, &status) != 0 || S_ISREG(status.st_mode) ||
                   error_set(e, ERROR_IO, "'%s' cannot be written: it is not a regular file", file);
        }
        link[length] = '\0';
        int size = snprintf(next, sizeof next, "%.*s%s", link[0] == '/' ? 0 : folder_length(target),
                            target, link);
        if (size >= PATH_MAX) {
            return io_error(e, file, ENAMETOOLONG);
        }
        memcpy(target, next, (size_t)size + 1);
    }
    return io_error(e, file, ELOOP);
}

// ---- names of temporary files ----

static bool is_part_of(const char *name, const char *base, size_t length)
{
    size_t size = strlen(name);
    return strncmp(name, base, length) == 0 && strncmp(name + length, ".ramify-", 8) == 0 &&
           size > length + 8 + 5 && strcmp(name + size - 5, ".part") == 0;
}

// A file is locked while a process writes it.
static void remove_if_stale(int folder, const char *name)
{
    int file = openat(folder, name, O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (file >= 0) {
        if (flock(file, LOCK_EX | LOCK_NB) == 0) {
            unlinkat(folder, name, 0);
        }
        close(file);
    }
}

static size_t base_length(const char *base)
{
    return strnlen(base, KEPT_NAME);
}

static void remove_stale(const char *folder, const char *base)
{
    DIR *stream = opendir(folder);
    for (const struct dirent *entry; stream && (entry = readdir(stream));) {
        if (is_part_of(entry->d_name, base, base_length(base))) {
            remove_if_stale(dirfd(stream), entry->d_name);
        }
    }
    if (stream) {
        closedir(stream);
    }
}

static bool part_name(char name[PATH_MAX], const char *target, int attempt)
{
    int folder = folder_length(target);
    int length =
        snprintf(name, PATH_MAX, "%.*s.ramify-%ld-%d.part",
                 folder + (int)base_length(target + folder), target, (long)getpid(), attempt);
    errno = ENAMETOOLONG;
    return length >= 0 && length < PATH_MAX;
}

// ---- opening ----

// Opens an unnamed file if it can be linked to a name later.
static bool open_nameless(FileBeside *beside, const char *folder)
{
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0) {
        beside->descriptor = open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    }
#endif
    return beside->descriptor >= 0;
}

// Until locked, another process may consider the file stale and remove it.
static bool lock_named(const FileBeside *beside)
{
    struct stat status;
    flock(beside->descriptor, LOCK_EX); // file systems without locks work unlocked
    return fstat(beside->descriptor, &status) == 0 && status.st_nlink > 0;
}

static bool open_named(FileBeside *beside, const char *target)
{
    for (int attempt = 0; attempt < MOST_ATTEMPTS && part_name(beside->name, target, attempt);
         attempt++) {
        beside->descriptor = open(beside->name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (beside->descriptor >= 0 && lock_named(beside)) {
            return true;
        }
        if (beside->descriptor < 0 && errno != EEXIST) {
            break;
        }
        if (beside->descriptor >= 0) {
            close(beside->descriptor);
            beside->descriptor = -1;
        }
    }
    beside->name[0] = '\0';
    return false;
}

bool file_beside_open(FileBeside *beside, const char *target)
{
    char folder[PATH_MAX];
    int length = folder_length(target);
    snprintf(folder, sizeof folder, "%.*s.", length, target);
    beside->descriptor = -1;
    beside->name[0] = '\0';
    remove_stale(folder, target + length);
    return open_nameless(beside, folder) || open_named(beside, target);
}

// ---- publishing ----

// Names an unnamed file: as target if that does not exist, else as a locked file beside it.
static bool give_name(FileBeside *beside, const char *target)
{
    char self[64];
    snprintf(self, sizeof self, "/proc/self/fd/%d", beside->descriptor);
    if (linkat(AT_FDCWD, self, AT_FDCWD, target, AT_SYMLINK_FOLLOW) == 0) {
        return true;
    }
    int reason = errno;
    flock(beside->descriptor, LOCK_EX); // keeps other processes from removing it as stale
    for (int attempt = 0; reason == EEXIST && attempt < MOST_ATTEMPTS; attempt++) {
        bool named = part_name(beside->name, target, attempt);
        if (named && linkat(AT_FDCWD, self, AT_FDCWD, beside->name, AT_SYMLINK_FOLLOW) == 0) {
            return true;
        }
        reason = errno;
    }
    beside->name[0] = '\0';
    errno = reason;
    return false;
}

bool file_beside_publish(FileBeside *beside, const char *target)
{
    if (!beside->name[0] && !give_name(beside, target)) {
        return false;
    }
    if (beside->name[0] && rename(beside->name, target) != 0) {
        return false;
    }
    beside->name[0] = '\0'; // it has become target
    return true;
}

bool file_beside_close(FileBeside *beside)
{
    if (beside->name[0]) {
        unlink(beside->name);
        beside->name[0] = '\0';
    }
    int descriptor = beside->descriptor;
    beside->descriptor = -1;
    return descriptor < 0 || close(descriptor) == 0;
}

// ---- reading ----

FILE *file_open_regular(const char *file, Error *e)
{
    struct stat status;
    int number = open(file, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    FILE *stream = NULL;
    if (number < 0 || fstat(number, &status) != 0) {
        error_set(e, ERROR_INPUT, "'%s' cannot be read: %s", file, strerror(errno));
    } else if (!S_ISREG(status.st_mode)) {
        error_set(e, ERROR_INPUT, "'%s' cannot be read: it is not a regular file", file);
    } else if (!(stream = fdopen(number, "rb"))) {
        error_set(e, ERROR_MEMORY, "'%s' cannot be read: out of memory", file);
    }
    if (!stream && number >= 0) {
        close(number);
    }
    return stream;
}
