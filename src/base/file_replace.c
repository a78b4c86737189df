#include "base/file_replace.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool io_error(Error *e, const char *file)
{
    return error_set(e, ERROR_IO, "'%s' cannot be written: %s", file, strerror(errno));
}

// The file behind a symbolic link, or the name itself; refuses folders, pipes and devices.
static bool resolve_target(const char *file, char target[PATH_MAX], Error *e)
{
    struct stat status;
    if (stat(file, &status) == 0) {
        if (!S_ISREG(status.st_mode)) {
            return error_set(e, ERROR_IO, "'%s' cannot be written: it is not a regular file", file);
        }
        return realpath(file, target) ? true : io_error(e, file);
    }
    if (strlen(file) >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return io_error(e, file);
    }
    memcpy(target, file, strlen(file) + 1);
    return true;
}

// Makes a file nobody else has, in the folder of target, with the permissions of any new file.
static int open_beside(const char *target, char name[PATH_MAX])
{
    const char *slash = strrchr(target, '/');
    int folder = slash ? (int)(slash - target) + 1 : 0;
    for (int attempt = 0; attempt < 10000; attempt++) {
        int length = snprintf(name, PATH_MAX, "%.*s.ramify-%ld-%d.part", folder, target,
                              (long)getpid(), attempt);
        if (length < 0 || length >= PATH_MAX) {
            errno = ENAMETOOLONG;
            return -1;
        }
        int descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0 || errno != EEXIST) {
            return descriptor;
        }
    }
    return -1;
}

static bool write_all(int descriptor, const char *bytes, size_t size)
{
    while (size > 0) {
        ssize_t written = write(descriptor, bytes, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            return false;
        }
        bytes += written;
        size -= (size_t)written;
    }
    return true;
}

bool file_replace(const char *file, const void *bytes, size_t size, Error *e)
{
    char target[PATH_MAX], name[PATH_MAX];
    if (!resolve_target(file, target, e)) {
        return false;
    }
    int descriptor = open_beside(target, name);
    if (descriptor < 0) {
        return io_error(e, file);
    }
    struct stat old;
    bool done = write_all(descriptor, bytes, size);
    if (done && stat(target, &old) == 0) {
        done = fchmod(descriptor, old.st_mode & 0777) == 0;
    }
    done = done && fsync(descriptor) == 0;
    int reason = errno;
    if (close(descriptor) != 0 && done) {
        done = false;
        reason = errno;
    }
    if (done && rename(name, target) != 0) {
        done = false;
        reason = errno;
    }
    if (!done) {
        unlink(name);
        errno = reason;
        return io_error(e, file);
    }
    return true;
}
