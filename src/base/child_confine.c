#include "base/child_confine.h"

#include "base/child_filter.h"
#include "base/new_handler.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

enum { OUTPUT_FILE = 3, MOST_FILES = 64, SIGNAL_STACK = 65536 };

// Global for handlers, which have no argument; set only in the child.
static ChildReport *crash_report;

static void on_crash(int number, siginfo_t *info, void *context)
{
    (void)context;
    crash_report->call = number == SIGSYS ? info->si_syscall : 0;
    crash_report->signal = number;
    _exit(EXIT_FAILURE);
}

// In any thread.
static void out_of_memory(void)
{
    error_set(&crash_report->error, ERROR_MEMORY, "out of memory");
    crash_report->ended = 1;
    _exit(EXIT_SUCCESS);
}

// The child records a crash itself, because its exit status may be lost to a host that ignores
// SIGCHLD or waits for any child. On an alternate stack, since the task's may have overflowed.
static void catch_crashes(ChildReport *report)
{
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGXCPU};
    struct sigaction action = {.sa_handler = SIG_DFL};
    sigemptyset(&action.sa_mask);
    for (int i = 1; i < NSIG; i++) {
        sigaction(i, &action, NULL); // fails for signals that cannot be caught
    }
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, NULL);
    sigaction(SIGXFSZ, &action, NULL); // write returns EFBIG instead
    void *memory =
        mmap(NULL, SIGNAL_STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    stack_t stack = {.ss_sp = memory, .ss_size = SIGNAL_STACK};
    crash_report = report;
    if (memory != MAP_FAILED && sigaltstack(&stack, NULL) == 0) {
        action.sa_sigaction = on_crash;
        action.sa_flags = SA_ONSTACK | SA_SIGINFO;
        for (size_t i = 0; i < sizeof crashes / sizeof crashes[0]; i++) {
            sigaction(crashes[i], &action, NULL);
        }
    }
    sigemptyset(&action.sa_mask);
    sigprocmask(SIG_SETMASK, &action.sa_mask, NULL);
}

// Closes all files of the host except the output, and discards printed text.
static bool leave_files(int file)
{
    int null = open("/dev/null", O_RDWR);
    int output = fcntl(file, F_DUPFD, OUTPUT_FILE + 1); // moved above the numbers used below
    if (null < 0 || output < 0) {
        return false;
    }
    for (int i = 0; i < OUTPUT_FILE; i++) {
        if (dup2(null, i) < 0) {
            return false;
        }
    }
    if (dup2(output, OUTPUT_FILE) != OUTPUT_FILE) {
        return false;
    }
    closefrom(OUTPUT_FILE + 1); // works on kernels without close_range, too
    return true;
}

// Size of this process's address space, bytes; 0 if unknown.
static int64_t mapped_bytes(void)
{
    char text[64] = "";
    int file = open("/proc/self/statm", O_RDONLY);
    if (file >= 0) {
        ssize_t got = read(file, text, sizeof text - 1);
        text[got > 0 ? got : 0] = '\0';
        close(file);
    }
    return strtoll(text, NULL, 10) * sysconf(_SC_PAGESIZE);
}

// Never raises the user's own limit. Returns whether the value is the limit now.
static bool lower_limit(__rlimit_resource_t what, int64_t value)
{
    struct rlimit limit = {0};
    if (getrlimit(what, &limit) == 0 && limit.rlim_max > (rlim_t)value) {
        limit.rlim_max = (rlim_t)value;
    }
    limit.rlim_cur = limit.rlim_cur > limit.rlim_max ? limit.rlim_max : limit.rlim_cur;
    return setrlimit(what, &limit) == 0 && limit.rlim_cur == (rlim_t)value;
}

// The output is in memory, so the user's limit of files holds only if it cannot be raised.
static void limit_output(int64_t most)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0) {
        limit.rlim_max = limit.rlim_max > (rlim_t)most ? (rlim_t)most : limit.rlim_max;
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_FSIZE, &limit);
    }
}

static void set_limits(const ChildJob *job, ChildReport *report)
{
    int64_t seconds = (int64_t)ceil(job->seconds);
    int64_t mapped = mapped_bytes(), memory;
    struct rlimit processor = {.rlim_cur = (rlim_t)seconds, .rlim_max = (rlim_t)seconds + 1};
    setrlimit(RLIMIT_CPU, &processor);
    if (mapped > 0 && !__builtin_add_overflow(mapped, job->memory, &memory)) {
        report->own_limit = lower_limit(RLIMIT_AS, memory);
    }
    limit_output(job->memory);
    lower_limit(RLIMIT_CORE, 0);
    lower_limit(RLIMIT_NOFILE, MOST_FILES);
}

// Makes this process the first that the kernel kills when memory runs out.
static void offer_to_die(void)
{
    int file = open("/proc/self/oom_score_adj", O_WRONLY);
    if (file >= 0) {
        ssize_t ignored = write(file, "1000", 4);
        (void)ignored; // not essential
        close(file);
    }
}

_Noreturn void child_confined(const ChildJob *job, ChildReport *report, int file, pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) { // the parent ended before prctl
        _exit(EXIT_FAILURE);
    }
    setsid(); // detaches from the terminal: interrupts go to the parent
    catch_crashes(report);
    offer_to_die();
    prctl(PR_SET_DUMPABLE, 0);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    Error e = {0};
    if (!leave_files(file)) {
        error_set(&e, ERROR_IO, "files cannot be closed before it is read; too many are open");
    } else {
        set_limits(job, report);
        new_handler_set(out_of_memory);
        child_filter(); // on kernels without filters the limits still apply
        ChildOutput output = {.file = OUTPUT_FILE, .limited = job->memory != INT64_MAX};
        if (job->task(job->data, &output, &e)) {
            e.code = ERROR_NONE;
        } else if (e.code == ERROR_NONE) {
            error_set(&e, ERROR_INTERNAL, "no reason is known");
        }
    }
    report->error = e;
    report->ended = 1;
    _exit(EXIT_SUCCESS); // skips the host's atexit handlers and buffers
}
