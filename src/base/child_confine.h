// The child's side of base/child.h.
#ifndef RAMIFY_BASE_CHILD_CONFINE_H
#define RAMIFY_BASE_CHILD_CONFINE_H

#include "base/child.h"

#include <sys/types.h>

// In memory shared by parent and child.
typedef struct ChildReport {
    volatile int ended;  // the task returned; error tells whether it succeeded
    volatile int signal; // the fatal signal; 0 = none
    bool own_limit;      // the memory limit is the job's, lower than the user's own
    volatile int call;   // the system call that raised SIGSYS
    Error error;
} ChildReport;

// Drops all that the task does not need, runs it and exits. parent: process id of the parent.
_Noreturn void child_confined(const ChildJob *job, ChildReport *report, int file, pid_t parent);

#endif
