// Runs work on untrusted input in a child process with limits, so that a crash or a hang becomes an
// Error: readers of other programs' files run in one.
//
// The child is a fork that shares only a report and a file in memory with its parent, has no
// terminal, and dies with its parent. If the kernel supports it, a system call filter
// (base/child_filter.h) permits reading files and nothing else: an attacker who takes over the
// reader can read what the user can read, but cannot write, execute or send anything except the
// result.
#ifndef RAMIFY_BASE_CHILD_H
#define RAMIFY_BASE_CHILD_H

#include "base/run.h"

#include <stddef.h>

// The child's result: bytes in memory, written in the child and read in the parent. Untrusted until
// checked.
typedef struct ChildOutput {
    int file;     // -1 = closed
    int64_t left; // bytes not yet read
} ChildOutput;

// Runs in the child on one thread (no OpenMP, no locks that threads of the host may hold; malloc
// and stdio are safe). Writes its result to output, or returns false with an error, of which the
// parent keeps code, message, line and column.
typedef bool ChildTask(const void *data, ChildOutput *output, Error *e);

typedef struct ChildJob {
    ChildTask *task;
    const void *data;   // passed to task
    const char *file;   // the file it reads, for errors
    const char *wanted; // "a whole OBJ file": what would be right, for errors
    double seconds;     // limit of wall-clock and of processor time
    int64_t memory;     // limit in bytes, beyond what this process has mapped already; the same
                        // again for output. Not enforced under AddressSanitizer.
} ChildJob;

// Runs the job; true with output open for reading, to be closed by child_output_close. Otherwise e,
// with the file's name: the task's own error; ERROR_INPUT when the child crashed, was killed,
// exceeded a limit or ended without an error; ERROR_CANCELLED; ERROR_IO when no child can be
// started. The child is reaped on return, whatever the host does with SIGCHLD. Thread-safe.
bool child_run(const ChildJob *job, const Run *run, ChildOutput *output, Error *e);

// In the task: appends count elements of size bytes.
bool child_write(ChildOutput *output, const void *data, int64_t count, size_t size, Error *e);

// In the parent: reads the next count elements of size bytes; ERROR_INPUT when there are fewer.
bool child_read(ChildOutput *output, void *data, int64_t count, size_t size, Error *e);

void child_output_close(ChildOutput *output); // closing twice is fine

#endif
