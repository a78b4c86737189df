#include "base/child_confine.h"

#include "base/child_filter.h"

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

// Where the handler of a crash can find it; set in the child alone.
static ChildReport *crash_report;

static void on_crash(int number, siginfo_t *info, void *context)
{
    (void)context;
    crash_report->call = number == SIGSYS ? info->si_syscall : 0;
    crash_report->signal = number;
    _exit(EXIT_FAILURE);
}

// A crash is written down by the child itself, as its status may be lost: a host that ignores
// SIGCHLD, or waits for any child, takes it. On a stack of its own, for the task's may be full.
static void catch_crashes(ChildReport *report)
{
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGXCPU};
    struct sigaction action = {.sa_handler = SIG_DFL};
    sigemptyset(&action.sa_mask);
    for (int i = 1; i < NSIG; i++) {
        sigaction(i, &action, NULL); // fails for those that cannot be changed
    }
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, NULL);
    sigaction(SIGXFSZ, &action, NULL); // write says EFBIG instead
    void *memory =
        mmap(NULL, SIGNAL_STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    stack_t stack = {.ss_sp = memory, .ss_size = SIGNAL_STACK};
    if (memory != MAP_FAILED && sigaltstack(&stack, NULL) == 0) {
        crash_report = report;
        action.sa_sigaction = on_crash;
        action.sa_flags = SA_ONSTACK | SA_SIGINFO;
        for (size_t i = 0; i < sizeof crashes / sizeof crashes[0]; i++) {
            sigaction(crashes[i], &action, NULL);
        }
    }
    sigemptyset(&action.sa_mask);
    sigprocmask(SIG_SETMASK, &action.sa_mask, NULL);
}

// No file of the host's stays open but the output, and nothing is printed.
static bool leave_files(int file)
{
    int null = open("/dev/null", O_RDWR);
    int output = fcntl(file, F_DUPFD, OUTPUT_FILE + 1); // out of the way of the numbers below
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
    closefrom(OUTPUT_FILE + 1); // also where the kernel has no close_range
    return true;
}

// Bytes of this process's address space; 0 when it is not known.
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

// Never above what the user allows already. Is the value the limit now?
static bool lower_limit(__rlimit_resource_t what, int64_t value)
{
    struct rlimit limit = {0};
    if (getrlimit(what, &limit) == 0 && limit.rlim_max > (rlim_t)value) {
        limit.rlim_max = (rlim_t)value;
    }
    limit.rlim_cur = limit.rlim_cur > limit.rlim_max ? limit.rlim_max : limit.rlim_cur;
    return setrlimit(what, &limit) == 0 && limit.rlim_cur == (rlim_t)value;
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
    lower_limit(RLIMIT_FSIZE, job->memory);
    lower_limit(RLIMIT_CORE, 0);
    lower_limit(RLIMIT_NOFILE, MOST_FILES);
}

// The first that the kernel ends when memory runs out.
static void offer_to_die(void)
{
    int file = open("/proc/self/oom_score_adj", O_WRONLY);
    if (file >= 0) {
        ssize_t ignored = write(file, "1000", 4);
        (void)ignored; // a courtesy
        close(file);
    }
}

_Noreturn void child_confined(const ChildJob *job, ChildReport *report, int file, pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) { // gone before that
        _exit(EXIT_FAILURE);
    }
    setsid(); // no terminal: an interrupt is the parent's business
    catch_crashes(report);
    offer_to_die();
    prctl(PR_SET_DUMPABLE, 0);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    Error e = {0};
    if (!leave_files(file)) {
        error_set(&e, ERROR_IO, "files cannot be closed before it is read; too many are open");
    } else {
        set_limits(job, report);
        child_filter(); // without it, on a kernel that has none, the limits still hold
        ChildOutput output = {.file = OUTPUT_FILE};
        if (job->task(job->data, &output, &e)) {
            e.code = ERROR_NONE;
        } else if (e.code == ERROR_NONE) {
            error_set(&e, ERROR_INTERNAL, "no reason is known");
        }
    }
    report->error = e;
    report->ended = 1;
    _exit(EXIT_SUCCESS); // without the host's atexit and without writing out its buffers
}
