#include "cli/batch/folder.h"

#include "base/file_replace.h"
#include "cli/command.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool folder_absolute(const char *path, bool pattern, char out[BATCH_PATH], RamifyError *e)
{
    char here[PATH_MAX];
    size_t used = 0;
    if (path[0] != '/') {
        if (!getcwd(here, sizeof here)) {
            return fail(e, RAMIFY_IO, "the current folder has no name: %s", strerror(errno));
        }
        for (const char *c = here; *c && used < BATCH_PATH - 4; c++) {
            out[used++] = *c;
            if (pattern && *c == '%') {
                out[used++] = '%';
            }
        }
        out[used++] = '/';
    }
    int length = snprintf(out + used, BATCH_PATH - used, "%s", path);
    return used + (size_t)length + 64 < BATCH_PATH ||
           fail(e, RAMIFY_BAD_INPUT, "'%.40s...' has too long a name; give it a shorter one", path);
}

bool folder_make(const char *folder, const char *name, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    snprintf(path, sizeof path, "%s%s%s", folder, *name ? "/" : "", name);
    struct stat status;
    return mkdir(path, 0777) == 0 ||
           (errno == EEXIST && stat(path, &status) == 0 && S_ISDIR(status.st_mode)) ||
           fail(e, RAMIFY_IO, "folder '%s' cannot be made: %s", path, strerror(errno));
}

char *folder_read(const char *folder, const char *name, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *stream = fopen(path, "r");
    struct stat status;
    bool sized = stream && fstat(fileno(stream), &status) == 0;
    char *text = sized ? allocate((int64_t)status.st_size + 1, 1, e) : NULL;
    bool read = text && fread(text, 1, (size_t)status.st_size, stream) == (size_t)status.st_size;
    if (!sized) {
        fail(e, RAMIFY_BAD_INPUT,
             "'%s' cannot be read: %s; name the folder of a batch, as ramify batch SCENE makes it",
             path, strerror(errno));
    } else if (text && !read) {
        fail(e, RAMIFY_IO, "'%s' cannot be read whole", path);
    }
    if (stream) {
        fclose(stream);
    }
    if (!read) {
        free(text);
        return NULL;
    }
    return text;
}

bool folder_write(const char *folder, const char *name, const char *text, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    Error why = {0};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return file_replace(path, text, strlen(text), &why) || fail(e, RAMIFY_IO, "%s", why.message);
}
