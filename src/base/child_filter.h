// System call filter (seccomp) of child processes that read untrusted files.
#ifndef RAMIFY_BASE_CHILD_FILTER_H
#define RAMIFY_BASE_CHILD_FILTER_H

#include <stdbool.h>

// From here on this process may only read files, allocate memory, start threads and exit. Calls
// that only an attacker needs (network, other programs and processes, files opened for writing,
// created or removed) raise SIGSYS; all others fail with EPERM. False when the kernel has no
// filters.
bool child_filter(void);

// Writes the name of a system call, for errors, into name.
void child_filter_name(int number, char *name, int size);

#endif
