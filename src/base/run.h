// Execution parameters: threads, cancellation, progress and warnings. Passed to every function that
// may take long.
#ifndef RAMIFY_BASE_RUN_H
#define RAMIFY_BASE_RUN_H

#include "base/error.h"

#include <stdint.h>
#include <string.h>

typedef struct Run {
    int threads;                   // >= 1; does not affect results
    const volatile int *cancelled; // becomes non-zero to cancel; may be NULL
    void (*progress)(void *user, const char *stage, double done); // done in [0, 1]; may be NULL
    void (*warn)(void *user, const char *message);                // may be NULL
    void *user;
    // Told what objects grow in (objects/common/element.h); may be NULL.
    const struct GrowthObserver *observer;
} Run;

// One thread, silent.
static inline Run run_default(void)
{
    Run run;
    memset(&run, 0, sizeof run); // not = {0}: C++ includes this, too
    run.threads = 1;
    return run;
}

// Another thread or a signal may set the flag meanwhile.
static inline bool run_is_cancelled(const Run *run)
{
    return run->cancelled && __atomic_load_n(run->cancelled, __ATOMIC_RELAXED);
}

// Fills e with ERROR_CANCELLED and returns false.
bool run_cancel_error(Error *e);

// For loops over user-defined counts: false and ERROR_CANCELLED when cancelled. Checks only every
// 1024 turns, which costs next to nothing.
static inline bool run_goes_on(const Run *run, int64_t turn, Error *e)
{
    return (turn & 1023) != 0 || !run_is_cancelled(run) || run_cancel_error(e);
}

static inline void run_progress(const Run *run, const char *stage, double done)
{
    if (run->progress) {
        run->progress(run->user, stage, done);
    }
}

void run_warn(const Run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Monotonic clock, seconds.
double run_seconds(void);

#endif
