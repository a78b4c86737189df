// Runs another program and takes what it prints.
#ifndef RAMIFY_CLI_BATCH_PROGRAM_H
#define RAMIFY_CLI_BATCH_PROGRAM_H

#include "ramify.h"

// Runs argv[0], found by PATH, and fills `said` with the first size - 1 bytes of its stdout and
// stderr, without the newline at the end. RAMIFY_BAD_INPUT when there is no such program, RAMIFY_IO
// with what it said when it fails.
bool program_run(char *const argv[], char *said, size_t size, RamifyError *e);

#endif
