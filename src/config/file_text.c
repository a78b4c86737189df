#include "config/file_text.h"

#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LARGEST_FILE (16 << 20) // bytes

static char *read_open(int descriptor, size_t size, size_t *length, Error *e)
{
    char *text = memory_alloc((int64_t)size + 1, 1, e);
    ssize_t count = 0;
    *length = 0;
    while (text && (count = read(descriptor, text + *length, size - *length)) > 0) {
        *length += (size_t)count;
    }
    if (text && count < 0) {
        error_set(e, ERROR_IO, "cannot read it: %s", strerror(errno));
        free(text);
        return NULL;
    }
    return text;
}

char *file_text_read(const char *file, const char *what, size_t *length, Error *e)
{
    struct stat status;
    char *text = NULL;
    int descriptor = open(file, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0 || fstat(descriptor, &status) != 0) {
        error_set(e, ERROR_INPUT, "cannot read it: %s; name a %s file", strerror(errno), what);
    } else if (!S_ISREG(status.st_mode)) {
        error_set(e, ERROR_INPUT, "a %s; name a %s file",
                  S_ISDIR(status.st_mode) ? "folder" : "device or pipe", what);
    } else if (status.st_size > LARGEST_FILE) {
        error_set(e, ERROR_INPUT, "%.1f MB long; a %s has at most %d MB",
                  (double)status.st_size / 1048576.0, what, LARGEST_FILE >> 20);
    } else {
        text = read_open(descriptor, (size_t)status.st_size, length, e);
    }
    if (descriptor >= 0) {
        close(descriptor);
    }
    if (!text) {
        error_locate(e, file, 0, 0);
    }
    return text;
}
