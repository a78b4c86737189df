// Which system calls a child process that reads untrusted files may make (seccomp).
#ifndef RAMIFY_BASE_CHILD_FILTER_H
#define RAMIFY_BASE_CHILD_FILTER_H

#include <stdbool.h>

// From here on this process may read files, take memory, start threads and end, and no more. What
// only an attacker wants (network, other programs and processes, files opened for writing, made or
// taken away) raises SIGSYS; all else fails with EPERM. False when the kernel has no such filters.
bool child_filter(void);

// The name of a system call by its number, for errors, into name.
void child_filter_name(int number, char *name, int size);

#endif
