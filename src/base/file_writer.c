#include "base/file_writer.h"

#include "base/file_beside.h"
#include "base/memory.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER = 1 << 20 };

struct FileWriter {
    char *file;            // as named by the caller
    char target[PATH_MAX]; // with links resolved
    FileBeside beside;     // the new file
    int reason;            // errno of the first failure; 0 = none
    size_t used;
    int64_t flushed;
    char buffer[BUFFER];
};

static bool io_error(Error *e, const char *file)
{
    return error_set(e, ERROR_IO, "'%s' cannot be written: %s", file, strerror(errno));
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
    writer->file = memory_copy_string(file, e);
    if (writer->file && file_target(file, writer->target, e)) {
        if (file_beside_open(&writer->beside, writer->target)) {
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
        ssize_t written = write(writer->beside.descriptor, bytes, size);
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

// Syncs the complete file to disk, with the permissions of the file that it replaces.
static void bring_to_disk(FileWriter *writer)
{
    struct stat old;
    flush(writer);
    bool done = !writer->reason;
    if (done && stat(writer->target, &old) == 0) {
        done = fchmod(writer->beside.descriptor, old.st_mode & 0777) == 0;
    }
    if (done && fsync(writer->beside.descriptor) != 0) {
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
    bool done = keep && !writer->reason;
    if (done && !file_beside_publish(&writer->beside, writer->target)) {
        writer->reason = errno;
        done = false;
    }
    file_beside_close(&writer->beside); // fsync has reported all failures
    if (keep && !done) {
        errno = writer->reason;
        io_error(e, writer->file);
    }
    free(writer->file);
    free(writer);
    return done;
}
