// Ctrl-C and SIGTERM: the first cancels, the second terminates immediately.
#ifndef RAMIFY_CLI_INTERRUPT_H
#define RAMIFY_CLI_INTERRUPT_H

// Installs the signal handlers; the flag becomes non-zero when a signal arrives.
const volatile int *interrupt_flag(void);

#endif
