// Writing a large file piece by piece so that a failure never harms an old one: everything goes to
// a new file beside it, which takes its name at the end.
#ifndef RAMIFY_BASE_FILE_WRITER_H
#define RAMIFY_BASE_FILE_WRITER_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

typedef struct FileWriter FileWriter;

// Begins a new file beside `file` (beside what it points to, if it is a symbolic link). ERROR_IO
// with the reason; refuses what is not a regular file.
FileWriter *file_writer_open(const char *file, Error *e);

// These go through a buffer. After the first failure they do nothing; file_writer_close tells why.
void file_writer_bytes(FileWriter *writer, const void *bytes, size_t size);
void file_writer_text(FileWriter *writer, const char *text);
void file_writer_print(FileWriter *writer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Room in the buffer for `size` bytes, at most FILE_WRITER_ROOM, to be filled at once; NULL after a
// failure. file_writer_bytes without the copy: for loops over millions of small records.
enum { FILE_WRITER_ROOM = 4096 };
void *file_writer_room(FileWriter *writer, size_t size);

// Brings everything to the disk, so that a close that keeps it can hardly fail: for files that
// belong together. ERROR_IO with the reason.
bool file_writer_settle(FileWriter *writer, Error *e);

// keep: brings everything to the disk and renames it over `file`. Not keep, or after a failure: the
// new file is gone and `file` as it was. Frees the writer (NULL is fine). True when `file` is
// whole; ERROR_IO with the reason when keep was asked for and could not be.
bool file_writer_close(FileWriter *writer, bool keep, Error *e);

#endif
