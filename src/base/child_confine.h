// The child's side of base/child.h.
#ifndef RAMIFY_BASE_CHILD_CONFINE_H
#define RAMIFY_BASE_CHILD_CONFINE_H

#include "base/child.h"

#include <sys/types.h>

// On a page that parent and child share.
typedef struct ChildReport {
    volatile int ended;  // the task returned; then error says whether well
    volatile int signal; // that ended it; 0 = none
    bool own_limit;      // of memory: the job's, which is lower than what the user allows anyway
    volatile int call;   // the system call that SIGSYS was for
    Error error;
} ChildReport;

// Gives up what the task does not need, runs it and leaves the process. parent: that forked it.
_Noreturn void child_confined(const ChildJob *job, ChildReport *report, int file, pid_t parent);

#endif
