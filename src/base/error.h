// Errors as values: a fallible function returns false or NULL and fills the Error its caller
// passed. An Error * may be NULL to ignore the error.
#ifndef RAMIFY_BASE_ERROR_H
#define RAMIFY_BASE_ERROR_H

#include <stdbool.h>

typedef enum ErrorCode {
    ERROR_NONE = 0,
    ERROR_INPUT,     // invalid scene, file or parameters: exit status 2
    ERROR_IO,        // reading or writing failed: exit status 1
    ERROR_MEMORY,    // out of memory: exit status 1
    ERROR_CANCELLED, // cancelled by the user: exit status 130
    ERROR_INTERNAL,  // a library failed for reasons not in the input: exit status 1
    ERROR_DIFFERS    // a result differs from what was required (commands only): exit status 1
} ErrorCode;

typedef struct Error {
    ErrorCode code;
    int line, column; // 1-based; 0 when unknown
    char file[256];   // "" when unknown
    // of the parameters, as in a scene file relative to the function called: "growth.levels.0"; ""
    // when unknown
    char key[128];
    char message[768];
} Error;

// Fills e (if not NULL) and returns false, so that callers can `return error_set(...)`.
// The message says what is wrong and, after a semicolon, what would be right.
bool error_set(Error *e, ErrorCode code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Sets the place of an error, unless one is set already. Line and column 0 = unknown.
void error_locate(Error *e, const char *file, int line, int column);

// Prepends a key to the error's key, joined by a dot, so that callers that read the parameters from
// a file can find their place. Returns false. A key that is too long loses its inner end.
bool error_key(Error *e, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Moves the file's name, if no line of it is known, from the place to the front of the message, so
// that another place can be named: that where the file is asked for.
void error_quote_file(Error *e);

// Puts words before the message, once on the way up: error_prefix(e, "object 'oak': ").
void error_prefix(Error *e, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Writes "file:line:column: message" (as much of it as is known) into text; column 0 is left out.
void error_format(const Error *e, char *text, int size);

#endif
