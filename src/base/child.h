// Work on untrusted input in a child process with limits, so that a crash or a hang of it is an
// Error here: readers of other programs' files run in one.
//
// The child is a fork of this process: it shares nothing but a report and a file in memory, talks
// to no terminal, and dies with its parent. A filter (base/child_filter.h) lets it read files and
// no more, where the kernel has such filters: an attacker who takes the reader over may read what
// the user may read, but cannot write, run or send anything; only its result is his.
#ifndef RAMIFY_BASE_CHILD_H
#define RAMIFY_BASE_CHILD_H

#include "base/run.h"

#include <stddef.h>

// What a child hands back: bytes in memory, written in the child and read here. Nothing in them is
// to be believed before it is checked.
typedef struct ChildOutput {
    int file;     // -1 = closed
    int64_t left; // bytes not read yet
} ChildOutput;

// Runs in the child, on one thread (no OpenMP of ours, no locks that threads of the host may hold;
// malloc and stdio are fine): writes its result to output, or returns false with an error, of which
// the parent keeps code, message, line and column.
typedef bool ChildTask(const void *data, ChildOutput *output, Error *e);

typedef struct ChildJob {
    ChildTask *task;
    const void *data;   // handed to task
    const char *file;   // that it reads, for errors
    const char *wanted; // "a whole OBJ file": what would be right, for errors
    double seconds;     // at most, of time and of the processor's
    int64_t memory;     // bytes at most, beyond what this process has mapped already; as much again
                        // in output. Not held to under AddressSanitizer.
} ChildJob;

// Runs the job; true with output open for reading, to be closed by child_output_close. Else e, with
// the file's name: what the task said; ERROR_INPUT when the child crashed, was killed, took too
// long, wanted too much memory or ended without a word; ERROR_CANCELLED; ERROR_IO when no child can
// be started. The child is gone and reaped when this returns, whatever the host does with SIGCHLD.
// Any number of threads may do this at once.
bool child_run(const ChildJob *job, const Run *run, ChildOutput *output, Error *e);

// In the task: appends count elements of size bytes.
bool child_write(ChildOutput *output, const void *data, int64_t count, size_t size, Error *e);

// In the parent: the next count elements of size bytes; ERROR_INPUT when there are not so many.
bool child_read(ChildOutput *output, void *data, int64_t count, size_t size, Error *e);

void child_output_close(ChildOutput *output); // a closed one is fine

#endif
