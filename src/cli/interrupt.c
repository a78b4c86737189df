#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>

// The one piece of global state: a signal handler can reach nothing else.
static volatile int interrupted;

static void on_signal(int number)
{
    (void)number;
    interrupted = 1;
}

const volatile int *interrupt_flag(void)
{
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    struct sigaction before;
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) { // not under nohup
        sigaction(SIGHUP, &action, NULL);
    }
    return &interrupted;
}
