#include "base/child.h"

#include "base/child_confine.h"
#include "base/child_filter.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/pidfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    TICK = 20,     // ms between checks of run->cancelled
    SHORT_TICK = 2 // the same if the kernel has no pidfd, which signals the end
};
// s: longer ticks do not count, since the machine slept or the process was stopped
#define LONGEST_TICK 1.0
// Wall-clock time against the limit of processor time: the child may share the processors with
// many.
#define PATIENCE 10.0

typedef struct Child {
    pid_t pid;
    int pidfd;   // -1 = not supported by the kernel
    int status;  // from waitpid, once known
    bool reaped; // status is known
    bool gone;
} Child;

// ---- waiting ----

// Forks with signals blocked until the child has its own handlers.
static bool start(const ChildJob *job, ChildReport *report, int file, Child *child, Error *e)
{
    sigset_t all, before;
    pid_t self = getpid();
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    pid_t pid = fork();
    if (pid == 0) {
        child_confined(job, report, file, self);
    }
    int why = errno;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    *child = (Child){.pid = pid, .pidfd = pid > 0 ? pidfd_open(pid, 0) : -1};
    return pid > 0 || error_set(e, ERROR_IO, "no process can be started for it: %s", strerror(why));
}

// Checks whether the child has ended. A host that ignores SIGCHLD, or waits for any child, receives
// the status; then there is no child left (ECHILD).
static void look(Child *child, int flags)
{
    pid_t got;
    do {
        got = waitpid(child->pid, &child->status, flags);
    } while (got < 0 && errno == EINTR);
    child->reaped = got == child->pid;
    child->gone = got != 0;
}

// Kills by pidfd if possible: the process id may have been reused.
static void end(Child *child)
{
    if (child->gone) {
        return;
    }
    if (child->pidfd < 0 || pidfd_send_signal(child->pidfd, SIGKILL, NULL, 0) != 0) {
        kill(child->pid, SIGKILL);
    }
    look(child, 0);
}

typedef enum Outcome { OUTCOME_ENDED, OUTCOME_LATE, OUTCOME_CANCELLED } Outcome;

static Outcome wait_for(Child *child, double seconds, const Run *run)
{
    // A child that ends before the first look leaves a cancelled run cancelled.
    Outcome outcome = run_is_cancelled(run) ? OUTCOME_CANCELLED : OUTCOME_ENDED;
    double waited = 0.0, last = run_seconds();
    struct pollfd watched = {.fd = child->pidfd, .events = POLLIN};
    for (look(child, WNOHANG); !child->gone && outcome == OUTCOME_ENDED; look(child, WNOHANG)) {
        poll(&watched, 1, child->pidfd >= 0 ? TICK : SHORT_TICK); // a descriptor of -1 is ignored
        double now = run_seconds();
        waited += now - last < LONGEST_TICK ? now - last : LONGEST_TICK;
        last = now;
        outcome = run_is_cancelled(run)         ? OUTCOME_CANCELLED
                  : waited > PATIENCE * seconds ? OUTCOME_LATE
                                                : OUTCOME_ENDED;
    }
    return outcome;
}

// ---- errors ----

// Removes control characters from the child's text, which comes from the file, and terminates it.
static void clean(char *text, size_t size)
{
    text[size - 1] = '\0';
    for (; *text; text++) {
        *text = (unsigned char)*text < ' ' || *text == 127 ? '?' : *text;
    }
}

static const char *worker(const ChildJob *job)
{
    return job->worker ? job->worker : "reader";
}

// A reader that fails has a bad file, a writer bad luck.
static ErrorCode blame(const ChildJob *job)
{
    return job->worker ? ERROR_INTERNAL : ERROR_INPUT;
}

static bool too_late(const ChildJob *job, Error *e)
{
    return error_set(e, blame(job), "the %s took longer than %g s; %s is needed", worker(job),
                     job->seconds, job->wanted);
}

static bool crashed(const ChildJob *job, int signal, int call, Error *e)
{
    if (signal == SIGSYS) {
        char name[64];
        child_filter_name(call, name, sizeof name);
        return error_set(e, blame(job),
                         "the %s was stopped at the system call '%s', which it does not need%s: %s "
                         "is needed",
                         worker(job), name, job->worker ? "" : "; the file may be an attack",
                         job->wanted);
    }
    if (signal == SIGXCPU) {
        return too_late(job, e);
    }
    if (signal == SIGKILL) {
        return error_set(e, blame(job),
                         "the %s was killed from outside, as the system does when memory runs "
                         "out; try again with more of it free",
                         worker(job));
    }
    const char *name = sigdescr_np(signal);
    return error_set(e, blame(job), "the %s crashed (%s); %s is needed", worker(job),
                     name ? name : "unknown signal", job->wanted);
}

// Whether to blame the file, which needed more than any such file should, or the machine, if it or
// the user's limits (ulimit) leave less than that.
static bool short_of_memory(const ChildJob *job, const ChildReport *report, Error *e)
{
    if (job->memory == INT64_MAX) {
        return error_set(e, ERROR_MEMORY, "out of memory");
    }
    if (report->own_limit) {
        return error_set(
            e, ERROR_INPUT,
            "the reader asked for more than the %.3g GB that it may have; %s is needed",
            (double)job->memory * 1e-9, job->wanted);
    }
    return error_set(e, ERROR_MEMORY,
                     "out of memory while it is read: this process may have less than the %.3g GB "
                     "that are set aside for it; raise its limit (ulimit -v)",
                     (double)job->memory * 1e-9);
}

static bool task_failed(const ChildJob *job, const ChildReport *report, Error *e)
{
    Error copy = report->error;
    clean(copy.message, sizeof copy.message);
    if (copy.code == ERROR_MEMORY) {
        return short_of_memory(job, report, e);
    }
    bool known = copy.code == ERROR_INPUT || copy.code == ERROR_IO;
    error_set(e, known ? copy.code : ERROR_INTERNAL, "%s", copy.message);
    clean(copy.key, sizeof copy.key);
    if (copy.key[0]) {
        error_key(e, "%s", copy.key);
    }
    if (job->file) {
        error_locate(e, job->file, copy.line > 0 ? copy.line : 0,
                     copy.column > 0 ? copy.column : 0);
    }
    return false;
}

static bool judge(const ChildJob *job, Outcome outcome, const Child *child,
                  const ChildReport *report, Error *e)
{
    int by_status = child->reaped && WIFSIGNALED(child->status) ? WTERMSIG(child->status) : 0;
    int signal = report->signal ? report->signal : by_status;
    if (outcome == OUTCOME_CANCELLED) {
        return run_cancel_error(e);
    }
    if (outcome == OUTCOME_LATE) {
        return too_late(job, e);
    }
    if (signal != 0) {
        return crashed(job, signal, report->call, e);
    }
    if (!report->ended) {
        return error_set(e, blame(job), "the %s ended without a result; %s is needed", worker(job),
                         job->wanted);
    }
    return report->error.code == ERROR_NONE || task_failed(job, report, e);
}

// Rewinds the output; its size is final only now that nothing writes to it.
static bool rewind_output(ChildOutput *output, Error *e)
{
    struct stat status;
    if (fstat(output->file, &status) != 0 || lseek(output->file, 0, SEEK_SET) != 0) {
        return error_set(e, ERROR_IO, "cannot take over the result: %s", strerror(errno));
    }
    output->left = status.st_size;
    return true;
}

static bool run_child(const ChildJob *job, ChildReport *report, const Run *run, ChildOutput *output,
                      Error *e)
{
    Child child;
    if (!start(job, report, output->file, &child, e)) {
        output->not_started = true;
        return false;
    }
    Outcome outcome = wait_for(&child, job->seconds, run);
    end(&child);
    if (child.pidfd >= 0) {
        close(child.pidfd);
    }
    return judge(job, outcome, &child, report, e) && rewind_output(output, e);
}

bool child_run(const ChildJob *job, const Run *run, ChildOutput *output, Error *e)
{
    *output = (ChildOutput){.file = memfd_create("ramify", MFD_CLOEXEC)};
    ChildReport *report =
        mmap(NULL, sizeof *report, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    bool done = output->file >= 0 && report != MAP_FAILED;
    if (!done) {
        error_set(e, ERROR_IO, "no memory can be shared with another process: %s", strerror(errno));
    }
    done = done && run_child(job, report, run, output, e);
    if (report != MAP_FAILED) {
        munmap(report, sizeof *report);
    }
    if (!done) {
        child_output_close(output);
        if (job->file) {
            error_locate(e, job->file, 0, 0);
        }
    }
    return done;
}

bool child_run_here(const ChildJob *job, ChildOutput *output, Error *e)
{
    *output = (ChildOutput){.file = memfd_create("ramify", MFD_CLOEXEC)};
    Error own = {0};
    bool done = output->file >= 0
                    ? job->task(job->data, output, &own)
                    : error_set(&own, ERROR_IO, "no memory for a file: %s", strerror(errno));
    done = done && rewind_output(output, &own);
    if (!done) {
        child_output_close(output);
        error_set(e, own.code, "%s", own.message);
    }
    return done;
}
