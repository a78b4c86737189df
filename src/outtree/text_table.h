// Lines of text files that hold a tree as a table, one row a line (SWC, QSM).
#ifndef RAMIFY_OUTTREE_TEXT_TABLE_H
#define RAMIFY_OUTTREE_TEXT_TABLE_H

#include "outtree/out_tree.h"

#include <stdio.h>

enum { TABLE_MAX_LINE = 4096 };

// How messages speak of a format.
typedef struct TableFormat {
    const char *name; // "SWC"
    const char *file; // "an SWC file"
    const char *row;  // "seven numbers"
} TableFormat;

// Makes a tree of an open stream; file is for messages.
typedef OutTree *TableParse(FILE *stream, const char *file, Error *e);

// Opens a regular file, parses it and closes it; NULL and e on failure, ERROR_INPUT with the file's
// name when it cannot be opened. The caller frees the tree.
OutTree *table_read(const char *file, const TableFormat *format, TableParse *parse, Error *e);

// Reads one line into text, without its end (LF or CRLF); a comment (#) that is too long is cut.
// ERROR_INPUT for a NUL or a line that is too long, ERROR_IO when reading fails. *more: whether
// there was a line.
bool table_read_line(FILE *stream, const TableFormat *format, char text[TABLE_MAX_LINE], bool *more,
                     Error *e);

// The line's first character that is neither blank nor, in line 1, of a byte order mark, which some
// editors write; "" and comments (#) are no rows.
const char *table_line_start(const char *text, long long line);

#endif
