// Ctrl-C and SIGTERM: the first asks for an end, the second ends at once.
#ifndef RAMIFY_CLI_INTERRUPT_H
#define RAMIFY_CLI_INTERRUPT_H

// Catches the signals; the flag becomes non-zero when one came.
const volatile int *interrupt_flag(void);

#endif
