// Children that misbehave: whatever they do, the parent goes on, knows why, and nothing is left of
// them.
#include "testing.h"

#include "base/child.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
enum { SANITIZED = 1 };
#else
enum { SANITIZED = 0 };
#endif

static const Run quiet = {.threads = 1};

static bool runs(ChildTask *task, const void *data, double seconds, const Run *run, Error *e)
{
    ChildJob job = {.task = task,
                    .data = data,
                    .file = "some.obj",
                    .wanted = "a better one",
                    .seconds = seconds,
                    .memory = 500000000};
    ChildOutput output;
    *e = (Error){0};
    bool done = child_run(&job, run, &output, e);
    child_output_close(&output);
    return done;
}

static void fails_with(ChildTask *task, double seconds, const char *message)
{
    Error e;
    assert_false(runs(task, NULL, seconds, &quiet, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.file, "some.obj");
    assert_string_equal(e.message, message);
}

static bool no_child_is_left(void)
{
    return waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD;
}

// ---- a child that behaves ----

enum { COUNT = 300000, PIECE = 1000 };

static bool count_up(const void *data, ChildOutput *output, Error *e)
{
    int from = *(const int *)data;
    int value[PIECE];
    bool done = true;
    for (int i = 0; done && i < COUNT; i++) {
        value[i % PIECE] = from + i;
        done = i % PIECE < PIECE - 1 || child_write(output, value, PIECE, sizeof value[0], e);
    }
    return done;
}

static void hands_back_what_it_wrote(void **state)
{
    (void)state;
    static int back[COUNT];
    int from = 7;
    ChildJob job = {.task = count_up, .data = &from, .file = "f", .seconds = 60, .memory = 1 << 26};
    ChildOutput output;
    Error e = {0};
    assert_true(child_run(&job, &quiet, &output, &e));
    assert_int_equal(output.left, sizeof back);
    assert_true(child_read(&output, back, COUNT, sizeof back[0], &e));
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(back[i], 7 + i);
    }
    assert_int_equal(output.left, 0);
    assert_false(child_read(&output, back, 1, 1, &e)); // there is no more
    assert_false(child_read(&output, back, INT64_MAX, 16, &e));
    assert_false(child_read(&output, back, -1, 16, &e));
    child_output_close(&output);
    child_output_close(&output);
}

static bool complain(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output;
    error_set(e, ERROR_INPUT, "a \033[31mred\n word");
    error_locate(e, "/etc/elsewhere", 7, -3);
    return false;
}

static void passes_its_errors_on(void **state)
{
    (void)state;
    Error e;
    assert_false(runs(complain, NULL, 60, &quiet, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.message, "a ?[31mred? word");
    assert_string_equal(e.file, "some.obj");
    assert_int_equal(e.line, 7);
    assert_int_equal(e.column, 0);
}

static bool look_around(const void *data, ChildOutput *output, Error *e)
{
    const int *host_file = data;
    struct rlimit core = {1, 1}, processor = {0, 0};
    getrlimit(RLIMIT_CORE, &core);
    getrlimit(RLIMIT_CPU, &processor);
    printf("to the terminal\n");
    fflush(stdout);
    (void)output;
    return (fcntl(*host_file, F_GETFD) == -1 && core.rlim_cur == 0 && processor.rlim_cur == 60 &&
            getsid(0) == getpid()) ||
           error_set(e, ERROR_INPUT, "too free");
}

// Not a word reaches our stdout, and what we had not written yet is not written twice.
static void is_confined_and_silent(void **state)
{
    (void)state;
    int pipes[2], kept = dup(STDOUT_FILENO);
    assert_int_equal(pipe(pipes), 0);
    fflush(stdout);
    dup2(pipes[1], STDOUT_FILENO);
    printf("once ");
    Error e;
    bool done = runs(look_around, &pipes[0], 60, &quiet, &e);
    fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    char text[64] = "";
    assert_int_equal(read(pipes[0], text, sizeof text - 1), 5);
    assert_string_equal(text, "once ");
    close(pipes[0]);
    close(pipes[1]);
    close(kept);
    assert_string_equal(e.message, "");
    assert_true(done);
}

// ---- children that do not ----

static bool segfault(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    return raise(SIGSEGV) == 0;
}

static int deeper(volatile char *above)
{
    volatile char here[4096];
    here[0] = above ? above[0] : 1;
    return above && above[0] == 0 ? 0 : deeper(here) + here[0];
}

static bool overflow_stack(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    return deeper(NULL) == 1;
}

static bool abort_itself(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    abort();
}

static bool leave_early(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    _exit(0);
}

static bool close_everything(const void *data, ChildOutput *output, Error *e)
{
    (void)data;
    for (int i = 0; i < 1024; i++) {
        close(i);
    }
    return child_write(output, "x", 1, 1, e);
}

static bool loop(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    volatile int i = 1;
    while (i != 0) {
        i = 1;
    }
    return true;
}

static bool sleep_long(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    sleep(1000);
    return true;
}

// As of one whose machine is busy with other work.
static bool wait_a_little(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    usleep(400000);
    return true;
}

static bool allocate(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output;
    for (int i = 0; i < 1000; i++) {
        volatile char *block = malloc(10000000);
        if (!block) {
            return error_set(e, ERROR_MEMORY, "no more");
        }
        block[0] = 1;
    }
    return true;
}

static bool write_for_ever(const void *data, ChildOutput *output, Error *e)
{
    static const char block[1 << 20];
    (void)data;
    while (child_write(output, block, 1, sizeof block, e)) {
    }
    return false;
}

static bool kill_itself(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output, (void)e;
    return kill(getpid(), SIGKILL) == 0;
}

// ---- children that want more than to read ----

static bool open_socket(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output;
    return socket(AF_INET, SOCK_STREAM, 0) >= 0 || error_set(e, ERROR_INPUT, "no socket");
}

static bool run_program(const void *data, ChildOutput *output, Error *e)
{
    char *const arguments[] = {(char[]){"true"}, NULL};
    (void)data, (void)output;
    execv("/bin/true", arguments);
    return error_set(e, ERROR_INPUT, "no program");
}

static bool trace_parent(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output;
    return ptrace(PTRACE_ATTACH, getppid(), NULL, NULL) == 0 ||
           error_set(e, ERROR_INPUT, "no ptrace");
}

static bool kill_parent(const void *data, ChildOutput *output, Error *e)
{
    (void)data, (void)output;
    return kill(getppid(), SIGWINCH) == 0 || error_set(e, ERROR_INPUT, "no signal");
}

static bool append_to_file(const void *data, ChildOutput *output, Error *e)
{
    (void)output;
    return open(data, O_WRONLY | O_APPEND) >= 0 || error_set(e, ERROR_INPUT, "no file");
}

static bool remove_file(const void *data, ChildOutput *output, Error *e)
{
    (void)output;
    return unlink(data) == 0 || error_set(e, ERROR_INPUT, "not removed");
}

static void *nothing(void *data)
{
    return data;
}

// Libraries may read and have threads, but no processes.
static bool read_with_threads(const void *data, ChildOutput *output, Error *e)
{
    pthread_t thread;
    struct stat status;
    (void)output;
    int file = open(data, O_RDONLY | O_CLOEXEC);
    char *memory = malloc(1 << 22);
    bool done = file >= 0 && memory && fstat(file, &status) == 0 && read(file, memory, 2) == 2 &&
                pthread_create(&thread, NULL, nothing, NULL) == 0 &&
                pthread_join(thread, NULL) == 0 && fork() == -1;
    free(memory);
    return done || error_set(e, ERROR_INPUT, "too tight");
}

static void stopped_at(ChildTask *task, const void *data, const char *call)
{
    char words[64];
    Error e;
    assert_false(runs(task, data, 60, &quiet, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.file, "some.obj");
    snprintf(words, sizeof words, "was stopped at the system call '%s'", call);
    if (!strstr(e.message, words)) {
        fail_msg("no '%s' in '%s'", words, e.message);
    }
}

static void may_only_read(void **state)
{
    (void)state;
    char file[] = "/tmp/ramify_child_XXXXXX";
    int number = mkstemp(file);
    assert_int_equal(write(number, "ab", 2), 2);
    close(number);
    stopped_at(open_socket, NULL, "socket");
    stopped_at(run_program, NULL, "execve");
    stopped_at(trace_parent, NULL, "ptrace");
    stopped_at(kill_parent, NULL, "kill");
    stopped_at(append_to_file, file, "openat");
    stopped_at(remove_file, file, "unlink");
    Error e;
    if (!runs(read_with_threads, file, 60, &quiet, &e)) {
        fail_msg("%s", e.message);
    }
    assert_int_equal(unlink(file), 0);
    assert_true(no_child_is_left());
}

static void survives_them(void **state)
{
    (void)state;
    const char *overflow = "the reader crashed (Segmentation fault); a better one is needed";
    const char *memory =
        "the reader asked for more than the 0.5 GB that it may have; a better one is needed";
    fails_with(segfault, 60, overflow);
    fails_with(overflow_stack, 60, overflow);
    fails_with(abort_itself, 60, "the reader crashed (Aborted); a better one is needed");
    fails_with(leave_early, 60, "the reader ended without a result; a better one is needed");
    fails_with(kill_itself, 60,
               "the reader was killed from outside, as the system does when memory runs out; try "
               "again with more of it free");
    Error e;
    assert_false(runs(close_everything, NULL, 60, &quiet, &e)); // its memory was never short
    assert_int_equal(e.code, ERROR_IO);
    assert_string_equal(e.message, "cannot hand back the result: Bad file descriptor");
    fails_with(write_for_ever, 60, memory);
    fails_with(loop, 0.2, "the reader took longer than 0.2 s; a better one is needed");
    fails_with(sleep_long, 0.2, "the reader took longer than 0.2 s; a better one is needed");
    assert_true(runs(wait_a_little, NULL, 0.2, &quiet, &e));
    if (!SANITIZED) { // whose memory is reserved beforehand
        fails_with(allocate, 60, memory);
    }
    assert_true(no_child_is_left());
}

// Less than the job's limit is left to this process: the file is not to blame.
static void the_users_limit_is_no_fault_of_the_file(void **state)
{
    (void)state;
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    if (SANITIZED) {
        skip();
    }
    long long pages = 0;
    FILE *statm = fopen("/proc/self/statm", "r");
    assert_non_null(statm);
    assert_int_equal(fscanf(statm, "%lld", &pages), 1); // NOLINT
    fclose(statm);
    struct rlimit tight = before;
    tight.rlim_cur = (rlim_t)(pages * sysconf(_SC_PAGESIZE) + 200000000);
    assert_int_equal(setrlimit(RLIMIT_AS, &tight), 0);
    Error e;
    bool done = runs(allocate, NULL, 60, &quiet, &e);
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
    assert_false(done);
    assert_int_equal(e.code, ERROR_MEMORY);
    assert_string_equal(e.message,
                        "out of memory while it is read: this process may have less than the 0.5 "
                        "GB that are set aside for it; raise its limit (ulimit -v)");
}

static void *raise_flag(void *flag)
{
    usleep(50000);
    *(volatile int *)flag = 1;
    return NULL;
}

static void ends_when_cancelled(void **state)
{
    (void)state;
    volatile int cancelled = 0;
    Run run = {.threads = 1, .cancelled = &cancelled};
    Error e;
    pthread_t thread;
    double before = run_seconds();
    assert_int_equal(pthread_create(&thread, NULL, raise_flag, (void *)(uintptr_t)&cancelled), 0);
    assert_false(runs(sleep_long, NULL, 60, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    assert_true(run_seconds() - before < 20.0);
    pthread_join(thread, NULL);
    assert_true(no_child_is_left());
}

// ---- hosts with habits ----

static volatile int reaped;

static void reap_all(int number)
{
    int before = errno;
    (void)number;
    while (waitpid(-1, NULL, WNOHANG) > 0) {
        reaped++;
    }
    errno = before;
}

static void works_whatever_the_host_does_with_sigchld(void **state)
{
    (void)state;
    struct sigaction before, action = {.sa_handler = SIG_IGN};
    int from = 1;
    Error e;
    sigaction(SIGCHLD, &action, &before);
    for (int i = 0; i < 2; i++) {
        assert_true(runs(count_up, &from, 60, &quiet, &e));
        fails_with(segfault, 60, "the reader crashed (Segmentation fault); a better one is needed");
        assert_false(runs(kill_itself, NULL, 60, &quiet, &e)); // why may be lost
        assert_int_equal(e.code, ERROR_INPUT);
        fails_with(sleep_long, 0.1, "the reader took longer than 0.1 s; a better one is needed");
        action.sa_handler = reap_all; // the second time
        sigaction(SIGCHLD, &action, NULL);
    }
    assert_true(reaped > 0);
    sigaction(SIGCHLD, &before, NULL);
    assert_true(no_child_is_left());
}

static void leaves_other_children_alone(void **state)
{
    (void)state;
    pid_t other = fork();
    if (other == 0) {
        _exit(5);
    }
    Error e;
    int from = 1, status = 0;
    assert_true(runs(count_up, &from, 60, &quiet, &e));
    fails_with(sleep_long, 0.1, "the reader took longer than 0.1 s; a better one is needed");
    assert_int_equal(waitpid(other, &status, 0), other);
    assert_int_equal(WEXITSTATUS(status), 5);
}

static int open_files(void)
{
    DIR *folder = opendir("/proc/self/fd");
    int count = 0;
    while (readdir(folder)) {
        count++;
    }
    closedir(folder);
    return count;
}

static void *run_some(void *data)
{
    int number = *(int *)data, wrong = 0;
    for (int i = 0; i < 6; i++) {
        Error e;
        wrong += i % 2 == 0 ? !runs(count_up, &number, 60, &quiet, &e)
                            : runs(segfault, NULL, 60, &quiet, &e) || !strstr(e.message, "Segm");
        free(malloc((size_t)(number + 1) * 1000));
    }
    *(int *)data = wrong;
    return NULL;
}

static void runs_in_many_threads_and_leaks_nothing(void **state)
{
    (void)state;
    enum { THREADS = 8 };
    pthread_t thread[THREADS];
    int data[THREADS], before = open_files();
    for (int i = 0; i < THREADS; i++) {
        data[i] = i;
        assert_int_equal(pthread_create(&thread[i], NULL, run_some, &data[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(thread[i], NULL);
        assert_int_equal(data[i], 0);
    }
    assert_int_equal(open_files(), before);
    assert_true(no_child_is_left());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hands_back_what_it_wrote),
        cmocka_unit_test(passes_its_errors_on),
        cmocka_unit_test(is_confined_and_silent),
        cmocka_unit_test(may_only_read),
        cmocka_unit_test(survives_them),
        cmocka_unit_test(the_users_limit_is_no_fault_of_the_file),
        cmocka_unit_test(ends_when_cancelled),
        cmocka_unit_test(works_whatever_the_host_does_with_sigchld),
        cmocka_unit_test(leaves_other_children_alone),
        cmocka_unit_test(runs_in_many_threads_and_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
