// Talk on stderr: a bar with rate and time left on a terminal, sparse lines elsewhere, warnings.
#ifndef RAMIFY_CLI_PROGRESS_H
#define RAMIFY_CLI_PROGRESS_H

#include <stdatomic.h>
#include <stdbool.h>

typedef struct Progress {
    bool terminal, quiet, shown; // shown: a bar is on the screen
    double work;                 // samples in all of the stage "trace", for the rate; 0 = unknown
    char stage[32];
    double stage_start, last; // clock_seconds of the stage's start and of the last word
    atomic_flag busy;
} Progress;

// Seconds on a clock that never goes back.
double clock_seconds(void);

void progress_start(Progress *progress, bool quiet);

// RamifyRun callbacks with a Progress as user.
void progress_report(void *user, const char *stage, double done);
void progress_warn(void *user, const char *message);

// Removes the bar, so that other text can follow.
void progress_end(Progress *progress);

#endif
