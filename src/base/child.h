// Runs work on untrusted input in a child process with limits, so that a crash or a hang becomes an
// Error: readers of other programs' files run in one, and so do the writers of pictures, whose
// libraries crash, hang or leave something out when memory runs out.
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
    int file;         // -1 = closed
    int64_t left;     // bytes not yet read
    bool limited;     // in a child: its size is limited by the job, not by the user alone
    bool not_started; // child_run has failed before anything was tried: the system has no process
} ChildOutput;

// Runs in the child on one thread (no OpenMP, no locks that threads of the host may hold; malloc
// and stdio are safe). Writes its result to output, or returns false with an error, of which the
// parent keeps code, message, line and column. An operator new of C++ that fails ends the child
// with ERROR_MEMORY, so that no library has to cope with an exception that it does not expect.
typedef bool ChildTask(const void *data, ChildOutput *output, Error *e);

typedef struct ChildJob {
    ChildTask *task;
    const void *data;   // passed to task
    const char *file;   // the file it reads, for errors; NULL = the caller names it
    const char *worker; // "writer"; NULL = "reader", for errors
    const char *wanted; // "a whole OBJ file": what would be right, for errors
    double seconds;     // limit of processor time; ten times that of wall-clock time
    int64_t memory;     // limit in bytes, beyond what this process has mapped already; the same
                        // again for output; INT64_MAX = the user's own limits. Not enforced
                        // under AddressSanitizer.
} ChildJob;

// Runs the job; true with output open for reading, to be closed by child_output_close. Otherwise e,
// with the file's name: the task's own error; ERROR_INPUT when the child crashed, was killed,
// exceeded a limit or ended without an error; ERROR_CANCELLED; ERROR_IO when no child can be
// started. The child is reaped on return, whatever the host does with SIGCHLD. Thread-safe.
bool child_run(const ChildJob *job, const Run *run, ChildOutput *output, Error *e);

// Runs the task in this process instead, without limits. Errors: the task's own, ERROR_IO.
bool child_run_here(const ChildJob *job, ChildOutput *output, Error *e);

// In the task: appends count elements of size bytes.
bool child_write(ChildOutput *output, const void *data, int64_t count, size_t size, Error *e);

// In the parent: reads the next count elements of size bytes; ERROR_INPUT when there are fewer.
bool child_read(ChildOutput *output, void *data, int64_t count, size_t size, Error *e);

void child_output_close(ChildOutput *output); // closing twice is fine

#endif
