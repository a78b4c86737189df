#include "base/file_replace.h"

#include "base/file_beside.h"
#include "base/file_writer.h"
#include "base/memory.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool file_replace(const char *file, const void *bytes, size_t size, Error *e)
{
    FileWriter *writer = file_writer_open(file, e);
    if (!writer) {
        return false;
    }
    file_writer_bytes(writer, bytes, size);
    return file_writer_close(writer, true, e);
}

static bool is_folder(const char *name)
{
    struct stat status;
    errno = 0;
    if (stat(name, &status) == 0 && !S_ISDIR(status.st_mode)) {
        errno = ENOTDIR;
    }
    return errno == 0;
}

bool file_replace_fits(const char *file, int extra, Error *e)
{
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file;
    if ((int64_t)strlen(name) + extra <= NAME_MAX) {
        return true;
    }
    return error_set(
        e, ERROR_IO,
        "cannot write '%.40s...': %zu bytes are too long a name; at most %d are possible "
        "here",
        name, strlen(name), NAME_MAX - extra);
}

bool file_replace_check(const char *file, Error *e)
{
    struct stat status;
    if (!file_replace_fits(file, 0, e)) {
        return false;
    }
    if (stat(file, &status) == 0 && !S_ISREG(status.st_mode)) {
        return error_set(e, ERROR_IO, "cannot write '%s': it is not a regular file; name another",
                         file);
    }
    char target[PATH_MAX];
    if (!file_target(file, target, e)) {
        return false;
    }
    const char *slash = strrchr(target, '/');
    char *folder = memory_copy_string(slash ? target : ".", e);
    if (!folder) {
        return false;
    }
    if (slash) {
        folder[slash == target ? 1 : slash - target] = 0;
    }
    bool done = is_folder(folder) && access(folder, W_OK | X_OK) == 0;
    if (!done) {
        error_set(e, ERROR_IO, "cannot write '%s': folder '%s': %s", file, folder, strerror(errno));
    }
    free(folder);
    return done;
}
