#include "outtree/text_table.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

static FILE *open_regular(const char *file, const TableFormat *format, Error *e)
{
    struct stat status;
    if (stat(file, &status) != 0) {
        error_set(e, ERROR_INPUT, "cannot read it: %s; name %s", strerror(errno), format->file);
    } else if (!S_ISREG(status.st_mode)) {
        error_set(e, ERROR_INPUT, "not a regular file; name %s", format->file);
    } else {
        FILE *stream = fopen(file, "re");
        if (stream) {
            return stream;
        }
        error_set(e, ERROR_INPUT, "cannot read it: %s; name %s", strerror(errno), format->file);
    }
    error_locate(e, file, 0, 0);
    return NULL;
}

OutTree *table_read(const char *file, const TableFormat *format, TableParse *parse, Error *e)
{
    FILE *stream = open_regular(file, format, e);
    OutTree *tree = stream ? parse(stream, file, e) : NULL;
    if (stream) {
        fclose(stream);
    }
    return tree;
}

bool table_read_line(FILE *stream, const TableFormat *format, char text[TABLE_MAX_LINE], bool *more,
                     Error *e)
{
    int c, length = 0;
    while ((c = getc_unlocked(stream)) != EOF && c != '\n') {
        if (c == 0) {
            return error_set(e, ERROR_INPUT, "not a text file: it holds a NUL; %s is text",
                             format->name);
        }
        if (length < TABLE_MAX_LINE - 1) {
            text[length++] = (char)c;
        } else if (text[0] != '#') {
            return error_set(e, ERROR_INPUT, "longer than %d characters; %s has %s",
                             TABLE_MAX_LINE - 1, format->name, format->row);
        }
    }
    if (c == EOF && ferror(stream)) { // what it gave of the line would be judged as if it were all
        return error_set(e, ERROR_IO, "cannot be read further: %s", strerror(errno));
    }
    *more = c != EOF || length > 0;
    length -= length > 0 && text[length - 1] == '\r';
    text[length] = 0;
    return true;
}

const char *table_line_start(const char *text, long long line)
{
    bool marked = line == 1 && strncmp(text, "\xef\xbb\xbf", 3) == 0;
    const char *start = text + (marked ? 3 : 0);
    return start + strspn(start, " \t");
}
