#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool error_set(Error *e, ErrorCode code, const char *format, ...)
{
    if (!e) {
        return false;
    }
    *e = (Error){.code = code};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(e->message, sizeof e->message, format, arguments);
    va_end(arguments);
    return false;
}

void error_locate(Error *e, const char *file, int line, int column)
{
    if (!e || e->file[0]) {
        return;
    }
    snprintf(e->file, sizeof e->file, "%s", file);
    e->line = line;
    e->column = column;
}

bool error_key(Error *e, const char *format, ...)
{
    if (!e) {
        return false;
    }
    char inner[sizeof e->key];
    memcpy(inner, e->key, sizeof inner);
    va_list arguments;
    va_start(arguments, format);
    int used = vsnprintf(e->key, sizeof e->key, format, arguments);
    va_end(arguments);
    if (inner[0] && used >= 0 && used < (int)sizeof e->key) {
        size_t room = sizeof e->key - (size_t)used; // longer keys are truncated
        snprintf(e->key + used, room, ".%.*s", room > 1 ? (int)room - 2 : 0, inner);
    }
    return false;
}

void error_quote_file(Error *e)
{
    if (e && e->file[0] && e->line == 0) {
        error_prefix(e, "%s: ", e->file);
        e->file[0] = 0;
    }
}

void error_prefix(Error *e, const char *format, ...)
{
    if (!e) {
        return;
    }
    char message[sizeof e->message];
    memcpy(message, e->message, sizeof message);
    va_list arguments;
    va_start(arguments, format);
    int used = vsnprintf(e->message, sizeof e->message, format, arguments);
    va_end(arguments);
    if (used >= 0 && used < (int)sizeof e->message) {
        snprintf(e->message + used, sizeof e->message - (size_t)used, "%s", message);
    }
}

void error_format(const Error *e, char *text, int size)
{
    if (!e->file[0]) {
        snprintf(text, (size_t)size, "%s", e->message);
    } else if (e->line > 0 && e->column == 0) {
        snprintf(text, (size_t)size, "%s:%d: %s", e->file, e->line, e->message);
    } else if (e->line > 0) {
        snprintf(text, (size_t)size, "%s:%d:%d: %s", e->file, e->line, e->column, e->message);
    } else {
        snprintf(text, (size_t)size, "%s: %s", e->file, e->message);
    }
}
