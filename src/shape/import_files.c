#include "shape/import_files.h"

#include "base/file_beside.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static FILE *stream_of(struct aiFile *file)
{
    return (FILE *)(void *)file->UserData;
}

static size_t read_file(struct aiFile *file, char *to, size_t size, size_t count)
{
    return size > 0 && count > 0 ? fread(to, size, count, stream_of(file)) : 0;
}

static size_t write_nothing(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    long at = ftell(stream_of(file));
    return at > 0 ? (size_t)at : 0;
}

static size_t file_size(struct aiFile *file)
{
    struct stat status;
    bool known = fstat(fileno(stream_of(file)), &status) == 0 && status.st_size > 0;
    return known ? (size_t)status.st_size : 0;
}

static aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    int from = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    return fseek(stream_of(file), (long)offset, from) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static void flush_nothing(struct aiFile *file)
{
    (void)file;
}

// Whether the path, compared textually, lies in the folder of main or below it.
static bool is_near(const char *path, const char *main)
{
    const char *slash = strrchr(main, '/');
    size_t folder = slash ? (size_t)(slash - main) + 1 : 0;
    if (strncmp(path, main, folder) != 0 || (folder == 0 && path[0] == '/')) {
        return false;
    }
    for (const char *word = path + folder; word; word = strchr(word, '/')) {
        word += *word == '/';
        if (strncmp(word, "..", 2) == 0 && (word[2] == '/' || word[2] == '\0')) {
            return false;
        }
    }
    return true;
}

static struct aiFile *open_file(struct aiFileIO *files, const char *path, const char *mode)
{
    const char *main = files->UserData;
    if (mode[0] != 'r' || (strcmp(path, main) != 0 && !is_near(path, main))) {
        return NULL;
    }
    FILE *stream = file_open_regular(path, NULL);
    struct aiFile *file = stream ? malloc(sizeof *file) : NULL;
    if (!file) {
        if (stream) {
            fclose(stream);
        }
        return NULL;
    }
    *file = (struct aiFile){.ReadProc = read_file,
                            .WriteProc = write_nothing,
                            .TellProc = tell,
                            .FileSizeProc = file_size,
                            .SeekProc = seek,
                            .FlushProc = flush_nothing,
                            .UserData = (char *)(void *)stream};
    return file;
}

static void close_file(struct aiFileIO *files, struct aiFile *file)
{
    (void)files;
    fclose(stream_of(file));
    free(file);
}

struct aiFileIO import_files(const char *file)
{
    char *data;
    memcpy(&data, &file, sizeof data); // never modified, although the type lacks const
    return (struct aiFileIO){.OpenProc = open_file, .CloseProc = close_file, .UserData = data};
}
