// Writes a large file piece by piece and atomically: into a new file that gets its name at the end.
#ifndef RAMIFY_BASE_FILE_WRITER_H
#define RAMIFY_BASE_FILE_WRITER_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

typedef struct FileWriter FileWriter;

// Creates a new file beside `file` (beside its target, if it is a symbolic link). ERROR_IO with the
// reason; refuses what is not a regular file.
FileWriter *file_writer_open(const char *file, Error *e);

// Buffered writes. After a failure they do nothing; file_writer_close reports it.
void file_writer_bytes(FileWriter *writer, const void *bytes, size_t size);
void file_writer_text(FileWriter *writer, const char *text);
void file_writer_print(FileWriter *writer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Returns space for `size` bytes in the buffer, at most FILE_WRITER_ROOM, to be filled immediately;
// NULL after a failure. Avoids the copy of file_writer_bytes in loops over millions of small
// records.
enum { FILE_WRITER_ROOM = 4096 };
void *file_writer_room(FileWriter *writer, size_t size);

// Syncs the file to disk, after which closing hardly fails: for files that belong together.
// ERROR_IO with the reason.
bool file_writer_settle(FileWriter *writer, Error *e);

// keep: syncs to disk and renames to `file`. Otherwise, or after a failure, the new file is removed
// and `file` is unchanged. Frees the writer (NULL is fine). True if `file` was written; ERROR_IO
// with the reason if keep failed.
bool file_writer_close(FileWriter *writer, bool keep, Error *e);

#endif
