#include "base/file_writer.h"

#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER = 1 << 20 };

struct FileWriter {
    char *file;                           // as the caller named it
    char target[PATH_MAX], new[PATH_MAX]; // what it stands for; the file beside that
    int descriptor;
    int reason; // errno of the first failure; 0 = none
    size_t used;
    int64_t flushed;
    char buffer[BUFFER];
};

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

FileWriter *file_writer_open(const char *file, Error *e)
{
    FileWriter *writer = memory_alloc(1, sizeof *writer, e);
    if (!writer) {
        return NULL;
    }
    writer->reason = 0;
    writer->used = 0;
    writer->flushed = 0;
    writer->descriptor = -1;
    writer->file = memory_copy_string(file, e);
    if (writer->file && resolve_target(file, writer->target, e)) {
        writer->descriptor = open_beside(writer->target, writer->new);
        if (writer->descriptor >= 0) {
            return writer;
        }
        io_error(e, file);
    }
    free(writer->file);
    free(writer);
    return NULL;
}

static void write_all(FileWriter *writer, const char *bytes, size_t size)
{
    while (size > 0 && !writer->reason) {
        ssize_t written = write(writer->descriptor, bytes, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            writer->reason = errno ? errno : EIO;
            return;
        }
        bytes += written;
        size -= (size_t)written;
        writer->flushed += written;
    }
}

static void flush(FileWriter *writer)
{
    write_all(writer, writer->buffer, writer->used);
    writer->used = 0;
}

void file_writer_bytes(FileWriter *writer, const void *bytes, size_t size)
{
    if (size > BUFFER - writer->used) {
        flush(writer);
    }
    if (size > BUFFER) {
        write_all(writer, bytes, size);
    } else {
        memcpy(writer->buffer + writer->used, bytes, size);
        writer->used += size;
    }
}

void file_writer_text(FileWriter *writer, const char *text)
{
    file_writer_bytes(writer, text, strlen(text));
}

void file_writer_print(FileWriter *writer, const char *format, ...)
{
    for (int attempt = 0; attempt < 2 && !writer->reason; attempt++) {
        size_t room = BUFFER - writer->used;
        va_list arguments;
        va_start(arguments, format);
        int length = vsnprintf(writer->buffer + writer->used, room, format, arguments);
        va_end(arguments);
        if (length >= 0 && (size_t)length < room) {
            writer->used += (size_t)length;
            return;
        }
        flush(writer);
    }
    writer->reason = writer->reason ? writer->reason : EOVERFLOW;
}

void *file_writer_room(FileWriter *writer, size_t size)
{
    if (size > BUFFER - writer->used) {
        flush(writer);
    }
    void *room = writer->buffer + writer->used;
    writer->used += size;
    return writer->reason ? NULL : room;
}

// Whole and on the disk, with the permissions of the file that it takes the place of.
static void bring_to_disk(FileWriter *writer)
{
    struct stat old;
    flush(writer);
    bool done = !writer->reason;
    if (done && stat(writer->target, &old) == 0) {
        done = fchmod(writer->descriptor, old.st_mode & 0777) == 0;
    }
    if (done && fsync(writer->descriptor) != 0) {
        done = false;
    }
    if (!done && !writer->reason) {
        writer->reason = errno;
    }
}

bool file_writer_settle(FileWriter *writer, Error *e)
{
    bring_to_disk(writer);
    errno = writer->reason;
    return writer->reason ? io_error(e, writer->file) : true;
}

bool file_writer_close(FileWriter *writer, bool keep, Error *e)
{
    if (!writer) {
        return false;
    }
    if (keep) {
        bring_to_disk(writer);
    }
    if (close(writer->descriptor) != 0 && !writer->reason) {
        writer->reason = errno;
    }
    if (keep && !writer->reason && rename(writer->new, writer->target) != 0) {
        writer->reason = errno;
    }
    bool done = keep && !writer->reason;
    if (!done) {
        unlink(writer->new);
    }
    if (keep && !done) {
        errno = writer->reason;
        io_error(e, writer->file);
    }
    free(writer->file);
    free(writer);
    return done;
}
