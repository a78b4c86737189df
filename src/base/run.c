#include "base/run.h"

#include <stdarg.h>
#include <stdio.h>
#include <time.h>

bool run_cancel_error(Error *e)
{
    return error_set(e, ERROR_CANCELLED, "interrupted");
}

void run_warn(const Run *run, const char *format, ...)
{
    if (!run->warn) {
        return;
    }
    char message[768];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    run->warn(run->user, message);
}

double run_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
