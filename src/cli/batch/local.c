// The engine of one machine: a process for each task, some at once.
#include "cli/batch/batch.h"

#include "cli/command.h"
#include "cli/interrupt.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

// A task that runs.
typedef struct Task {
    pid_t process; // 0 = none
    int first, last;
} Task;

typedef struct Crew {
    const Batch *batch;
    const Options *options;
    const volatile int *interrupted;
    Task *task; // `jobs` of them
    int jobs, pack, threads;
    int next; // the part at which the next task begins
} Crew;

static void name_log(const Crew *crew, int first, char log[BATCH_PATH + 64])
{
    snprintf(log, BATCH_PATH + 64, "%s/logs/%06d.log", crew->batch->folder, first);
}

// In the child: becomes `ramify batch run`.
static void become_task(const Crew *crew, const Task *task)
{
    char log[BATCH_PATH + 64], parts[32], threads[16];
    name_log(crew, task->first, log);
    snprintf(parts, sizeof parts, "%d-%d", task->first, task->last);
    snprintf(threads, sizeof threads, "%d", crew->threads);
    prctl(PR_SET_PDEATHSIG, SIGTERM); // a task does not outlive the command
    int file = open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0) {
        fprintf(stderr, "ramify: cannot write '%s': %s\n", log, strerror(errno));
        _exit(1);
    }
    execl("/proc/self/exe", "ramify", "batch", "run", crew->batch->folder, "--parts", parts,
          "--threads", threads, (char *)NULL);
    fprintf(stderr, "ramify: cannot start a task: %s\n", strerror(errno));
    _exit(1);
}

static bool start_task(Crew *crew, Task *task, RamifyError *e)
{
    task->first = crew->next;
    task->last = crew->next + crew->pack - 1;
    task->last = task->last < crew->batch->last ? task->last : crew->batch->last;
    crew->next = task->last + 1;
    fflush(NULL);
    task->process = fork();
    if (task->process == 0) {
        become_task(crew, task);
    }
    if (task->process < 0) {
        task->process = 0;
        return fail(e, RAMIFY_IO, "a task cannot be started: %s", strerror(errno));
    }
    return true;
}

static void stop_tasks(const Crew *crew)
{
    for (int i = 0; i < crew->jobs; i++) {
        if (crew->task[i].process > 0) {
            kill(crew->task[i].process, SIGTERM);
        }
    }
}

static void report(const Crew *crew, const Task *task, int status)
{
    bool done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (done && !crew->options->quiet) {
        fprintf(stderr, "%ss %d-%d: done\n", batch_noun(crew->batch), task->first, task->last);
    } else if (!done && !*crew->interrupted) {
        char log[BATCH_PATH + 64];
        name_log(crew, task->first, log);
        fprintf(stderr, "ramify: warning: %ss %d-%d %s %d; see '%s'\n", batch_noun(crew->batch),
                task->first, task->last, WIFSIGNALED(status) ? "ended by signal" : "failed with",
                WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), log);
    }
}

// Waits until a task ends or a signal comes. False when there is none to wait for.
static bool await_task(Crew *crew)
{
    int status;
    pid_t ended = waitpid(-1, &status, 0);
    for (int i = 0; ended > 0 && i < crew->jobs; i++) {
        if (crew->task[i].process == ended) {
            report(crew, &crew->task[i], status);
            crew->task[i].process = 0;
        }
    }
    return ended > 0 || errno == EINTR;
}

// Skips the parts that are done; false when none is left.
static bool find_next(Crew *crew)
{
    while (crew->next <= crew->batch->last && batch_part_done(crew->batch, crew->next)) {
        crew->next++;
    }
    return crew->next <= crew->batch->last;
}

static bool run_tasks(Crew *crew, RamifyError *e)
{
    bool sound = true, stopped = false;
    do {
        for (int i = 0; i < crew->jobs; i++) {
            if (crew->task[i].process == 0 && sound && !*crew->interrupted && find_next(crew)) {
                sound = start_task(crew, &crew->task[i], e);
            }
        }
        if (*crew->interrupted && !stopped) {
            stop_tasks(crew);
            stopped = true;
        }
    } while (await_task(crew));
    return sound && (!*crew->interrupted ||
                     fail(e, RAMIFY_CANCELLED, "interrupted; ramify batch submit '%s' goes on",
                          crew->batch->folder));
}

// Without --pack, each job has one task: the scene is grown as often as there are jobs.
static int local_pack(const Batch *batch, const Options *options, int jobs)
{
    int parts = batch->last - batch->first + 1;
    return options->pack > 0 ? options->pack : (parts + jobs - 1) / jobs;
}

bool batch_local(const Batch *batch, const Options *options, RamifyError *e)
{
    int jobs = options->jobs > 0 ? options->jobs : 1;
    Crew crew = {.batch = batch,
                 .options = options,
                 .interrupted = interrupt_flag(),
                 .jobs = jobs,
                 .pack = local_pack(batch, options, jobs),
                 .threads = batch_threads(options),
                 .next = batch->first};
    crew.task = allocate(crew.jobs, sizeof *crew.task, e);
    bool done = crew.task && run_tasks(&crew, e);
    free(crew.task);
    return done && batch_merge(batch, options, e);
}
