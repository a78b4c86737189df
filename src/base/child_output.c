// The child's result.
#include "base/child.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

enum {
    LARGEST_WRITE = 1 << 30,
    LARGEST_READ = 1 << 26 // this much is in memory twice for a moment
};

bool child_write(ChildOutput *output, const void *data, int64_t count, size_t size, Error *e)
{
    const char *at = data;
    size_t left;
    if (count < 0 || __builtin_mul_overflow((size_t)count, size, &left)) {
        return error_set(e, ERROR_MEMORY, "too much to hand back");
    }
    while (left > 0) {
        ssize_t put = write(output->file, at, left < LARGEST_WRITE ? left : LARGEST_WRITE);
        if (put < 0 && errno != EINTR) {
            bool memory = errno == ENOMEM || (errno == EFBIG && output->limited);
            return error_set(e, memory ? ERROR_MEMORY : ERROR_IO, "cannot hand back the result: %s",
                             strerror(errno));
        }
        at += put > 0 ? put : 0;
        left -= put > 0 ? (size_t)put : 0;
    }
    return true;
}

// Frees the part of the file that has been read, so that it is not in memory twice.
static void give_back(int file, ssize_t size)
{
    off_t end = lseek(file, 0, SEEK_CUR);
    if (size > 0 && end >= size) {
        fallocate(file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, end - size, size);
    }
}

bool child_read(ChildOutput *output, void *data, int64_t count, size_t size, Error *e)
{
    char *at = data;
    size_t left;
    if (count < 0 || __builtin_mul_overflow((size_t)count, size, &left) ||
        left > (size_t)output->left) {
        return error_set(e, ERROR_INPUT, "it broke off in its result");
    }
    output->left -= (int64_t)left;
    while (left > 0) {
        ssize_t got = read(output->file, at, left < LARGEST_READ ? left : LARGEST_READ);
        if (got == 0 || (got < 0 && errno != EINTR)) {
            return error_set(e, ERROR_IO, "cannot take over the result: %s",
                             got == 0 ? "it shrank" : strerror(errno));
        }
        give_back(output->file, got);
        at += got > 0 ? got : 0;
        left -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

void child_output_close(ChildOutput *output)
{
    if (output->file >= 0) {
        close(output->file);
    }
    output->file = -1;
}
