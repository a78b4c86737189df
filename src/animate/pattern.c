#include "animate/pattern.h"

#include "base/memory.h"

#include <stdio.h>
#include <string.h>

// A conversion, starting at a percent sign.
typedef struct Mark {
    int length; // length of its text; 0 = invalid
    bool number;
    int digits; // minimum digits of the number
} Mark;

static Mark read_mark(const char *at)
{
    if (at[1] == '%') {
        return (Mark){.length = 2};
    }
    int i = 1, digits = 1;
    if (at[i] == '0') {
        i++;
    }
    if (at[i] >= '1' && at[i] <= '9') {
        digits = at[i++] - '0';
    } else if (i > 1) {
        return (Mark){0}; // "%0d"
    }
    return at[i] == 'd' ? (Mark){i + 1, true, digits} : (Mark){0};
}

bool pattern_check(const char *pattern, Error *e)
{
    int numbers = 0;
    for (const char *at = strchr(pattern, '%'); at;) {
        Mark mark = read_mark(at);
        if (mark.length == 0) {
            return error_set(e, ERROR_INPUT,
                             "'%s' has '%.4s' in it; write %%04d for the frame's number and %%%% "
                             "for a percent sign",
                             pattern, at);
        }
        numbers += mark.number;
        at = strchr(at + mark.length, '%');
    }
    if (numbers != 1) {
        return error_set(e, ERROR_INPUT,
                         "'%s' holds %s frame number; write one, as in oak-%%04d.png", pattern,
                         numbers ? "more than one" : "no");
    }
    return true;
}

char *pattern_name(const char *pattern, int frame, Error *e)
{
    size_t room = strlen(pattern) + 32, used = 0;
    char *name = memory_alloc((int64_t)room, 1, e);
    while (name && *pattern) {
        Mark mark = *pattern == '%' ? read_mark(pattern) : (Mark){0};
        if (mark.number) {
            used += (size_t)snprintf(name + used, room - used, "%0*d", mark.digits, frame);
        } else {
            name[used++] = *pattern;
        }
        pattern += mark.length ? mark.length : 1;
    }
    if (name) {
        name[used] = 0;
    }
    return name;
}
