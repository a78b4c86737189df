#include "base/file_replace.h"

#include "base/file_writer.h"

bool file_replace(const char *file, const void *bytes, size_t size, Error *e)
{
    FileWriter *writer = file_writer_open(file, e);
    if (!writer) {
        return false;
    }
    file_writer_bytes(writer, bytes, size);
    return file_writer_close(writer, true, e);
}
