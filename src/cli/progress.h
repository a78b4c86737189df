// Output on stderr: a progress bar with rate and time left on a terminal, sparse lines elsewhere,
// warnings.
#ifndef RAMIFY_CLI_PROGRESS_H
#define RAMIFY_CLI_PROGRESS_H

#include <stdatomic.h>
#include <stdbool.h>

typedef struct Progress {
    bool terminal, quiet, shown; // shown: the bar is on the screen
    double work;                 // total samples of the stage "trace", for the rate; 0 = unknown
    char stage[32];
    double stage_start, last; // clock_seconds at the stage's start and at the last output
    atomic_flag busy;
} Progress;

// Monotonic clock, seconds.
double clock_seconds(void);

void progress_start(Progress *progress, bool quiet);

// RamifyRun callbacks, with a Progress as user.
void progress_report(void *user, const char *stage, double done);
void progress_warn(void *user, const char *message);

// Erases the bar, so that other text can follow.
void progress_end(Progress *progress);

#endif
