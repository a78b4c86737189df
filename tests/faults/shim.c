// Lets the n-th allocation, reading, writing or starting of a process fail. Loaded before a program
// with LD_PRELOAD; tests/faults/faults.py runs programs under it.
//
// FAULT_LOG names a file of sizeof(Log) zero bytes. It is mapped shared, so that child processes
// count on, and holds, when the program ends, how many calls of each family there were and where
// those were that failed. FAULT=FAMILY:N lets the N-th call of a family fail (from 1),
// FAULT=FAMILY:N+ all from it on, FAULT=trace none: then FAULT_TRACE names a file of sizeof(Trace)
// zero bytes, which gets a hash of each call's stack. FAULT_SERVE=PLUGIN:PLUGIN... loads these
// libraries and then runs the program in a fork for each request that it reads from stdin
// (run_request), which saves the time of loading; the exit status, or the signal's number below 0,
// goes to stdout.
//
// What is not counted: calls before main() and while libraries are loaded (constructors of outside
// libraries cannot report an error), calls after main(), allocations of libseccomp, and writing to
// stderr (else no error could be told).
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MEMORY, READ, WRITE, PROCESS, FAMILIES };
static const char *const family_name[FAMILIES] = {"memory", "read", "write", "process"};

enum { PLACES = 64, DEPTH = 24, PLACE_TEXT = 1536 };

typedef struct Log {
    _Atomic int64_t calls[FAMILIES];
    _Atomic int64_t failed;
    char place[PLACES][PLACE_TEXT]; // backtraces of the first that failed
} Log;

enum { MOST_TRACED = 1 << 20, HASHED = 10 };

// Calls with the same eight places on top of the stack have the same hash.
typedef struct Trace {
    uint64_t stack[FAMILIES][MOST_TRACED];
} Trace;

static struct {
    Log *log;     // NULL = does nothing
    Trace *trace; // NULL = calls are only counted
    int family;
    int64_t at;
    bool further;
    _Atomic bool counting; // main() runs
} fault;

// Above 0 within a library's loading or within this file's own work.
static _Thread_local int quiet __attribute__((tls_model("initial-exec")));

static void note_place(char *text)
{
    void *frames[DEPTH];
    int count = backtrace(frames, DEPTH), used = 0;
    for (int i = 2; i < count && used < PLACE_TEXT - 1; i++) {
        Dl_info info;
        bool known = dladdr(frames[i], &info) && info.dli_fname;
        const char *file = known ? strrchr(info.dli_fname, '/') : NULL;
        long offset = known ? (long)((char *)frames[i] - (char *)info.dli_fbase) : 0;
        int length =
            snprintf(text + used, (size_t)(PLACE_TEXT - used), "%s %s+0x%lx\n",
                     known && info.dli_sname ? info.dli_sname : "?", file ? file + 1 : "?", offset);
        used = length < 0 || used + length >= PLACE_TEXT ? PLACE_TEXT - 1 : used + length;
    }
}

static uint64_t stack_hash(void)
{
    void *frames[DEPTH];
    int count = backtrace(frames, HASHED);
    uint64_t hash = 0xcbf29ce484222325U; // FNV-1a, by words
    for (int i = 2; i < count; i++) {
        hash = (hash ^ (uintptr_t)frames[i]) * 0x100000001b3U;
    }
    return hash;
}

// Counts a call; whether it shall fail, with this errno.
static bool fails(int family, int reason)
{
    if (!fault.log || quiet > 0 || !atomic_load_explicit(&fault.counting, memory_order_relaxed)) {
        return false;
    }
    int64_t number = atomic_fetch_add(&fault.log->calls[family], 1) + 1;
    if (fault.trace && number <= MOST_TRACED) {
        quiet++;
        fault.trace->stack[family][number - 1] = stack_hash();
        quiet--;
    }
    if (family != fault.family || (fault.further ? number < fault.at : number != fault.at)) {
        return false;
    }
    int64_t place = atomic_fetch_add(&fault.log->failed, 1);
    if (place < PLACES) {
        quiet++;
        note_place(fault.log->place[place]);
        quiet--;
    }
    errno = reason;
    return true;
}

// libseccomp runs in circles when its memory is short. It works in a child process that has just
// got its own limit, which holds far more than that, and the child's time is limited.
static const char *seccomp_from, *seccomp_to;

static int find_seccomp(struct dl_phdr_info *info, size_t size, void *data)
{
    (void)size, (void)data;
    for (int i = 0;
         info->dlpi_name && strstr(info->dlpi_name, "/libseccomp.") && i < info->dlpi_phnum; i++) {
        const char *from = (const char *)info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
        if (info->dlpi_phdr[i].p_type == PT_LOAD && info->dlpi_phdr[i].p_flags & PF_X) {
            seccomp_from = from;
            seccomp_to = from + info->dlpi_phdr[i].p_memsz;
        }
    }
    return 0;
}

static bool allocation_fails(const void *caller)
{
    bool seccomp = (const char *)caller >= seccomp_from && (const char *)caller < seccomp_to;
    return !seccomp && fails(MEMORY, ENOMEM);
}
#define ALLOCATION_FAILS() allocation_fails(__builtin_return_address(0))

// ---- the functions behind

static char early[65536]; // what dlsym allocates before it has found malloc
static size_t early_used;

static void *early_alloc(size_t size)
{
    early_used = (early_used + 15) / 16 * 16;
    void *memory = early + early_used;
    early_used += size;
    return early_used <= sizeof early ? memory : NULL;
}

static bool is_early(const void *memory)
{
    return (const char *)memory >= early && (const char *)memory < early + sizeof early;
}

// `real` is the next definition of the function that this stands in.
#define REAL(type, name, ...)                  \
    static type (*real)(__VA_ARGS__);          \
    if (!real) {                               \
        quiet++;                               \
        void *found = dlsym(RTLD_NEXT, #name); \
        memcpy(&real, &found, sizeof real);    \
        quiet--;                               \
    }

// ---- memory

static _Thread_local bool finding __attribute__((tls_model("initial-exec")));

void *malloc(size_t size)
{
    if (finding) {
        return early_alloc(size);
    }
    finding = true;
    REAL(void *, malloc, size_t)
    finding = false;
    return ALLOCATION_FAILS() ? NULL : real(size);
}

void *calloc(size_t count, size_t size)
{
    if (finding) {
        return early_alloc(count * size);
    }
    finding = true;
    REAL(void *, calloc, size_t, size_t)
    finding = false;
    return ALLOCATION_FAILS() ? NULL : real(count, size);
}

void *realloc(void *memory, size_t size)
{
    if (finding && !memory) {
        return early_alloc(size);
    }
    REAL(void *, realloc, void *, size_t)
    if (is_early(memory)) {
        void *copy = malloc(size);
        return copy ? memcpy(copy, memory, size) : NULL;
    }
    return ALLOCATION_FAILS() ? NULL : real(memory, size);
}

// What dlsym frees before it has found free is lost: an error's text, which AddressSanitizer left.
void free(void *memory)
{
    if (finding || is_early(memory)) {
        return;
    }
    finding = true;
    REAL(void, free, void *)
    finding = false;
    real(memory);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    REAL(int, posix_memalign, void **, size_t, size_t)
    return ALLOCATION_FAILS() ? ENOMEM : real(memory, alignment, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    REAL(void *, aligned_alloc, size_t, size_t)
    return ALLOCATION_FAILS() ? NULL : real(alignment, size);
}

void *memalign(size_t alignment, size_t size)
{
    REAL(void *, memalign, size_t, size_t)
    return ALLOCATION_FAILS() ? NULL : real(alignment, size);
}

// operator new and new[] of AddressSanitizer, which do not call malloc and end the program where
// those of C++ throw. Others do call it, so only these are counted here.
void __asan_init(void) __attribute__((weak));

static void out_of_memory(void)
{
    void (*(*get_handler)(void))(void), (*throw_bad_alloc)(void);
    quiet++;
    void *get = dlsym(RTLD_DEFAULT, "_ZSt15get_new_handlerv");
    void *throw = dlsym(RTLD_DEFAULT, "_ZSt17__throw_bad_allocv");
    quiet--;
    memcpy(&get_handler, &get, sizeof get);
    memcpy(&throw_bad_alloc, &throw, sizeof throw);
    void (*handler)(void) = get_handler();
    (handler ? handler : throw_bad_alloc)();
}

#define NEW(name)                                \
    void *name(size_t size);                     \
    void *name(size_t size)                      \
    {                                            \
        REAL(void *, name, size_t)               \
        if (__asan_init && ALLOCATION_FAILS()) { \
            out_of_memory();                     \
        }                                        \
        return real(size);                       \
    }
NEW(_Znwm)
NEW(_Znam)

#define NEW_ALIGNED(name)                        \
    void *name(size_t size, size_t alignment);   \
    void *name(size_t size, size_t alignment)    \
    {                                            \
        REAL(void *, name, size_t, size_t)       \
        if (__asan_init && ALLOCATION_FAILS()) { \
            out_of_memory();                     \
        }                                        \
        return real(size, alignment);            \
    }
NEW_ALIGNED(_ZnwmSt11align_val_t)
NEW_ALIGNED(_ZnamSt11align_val_t)

#define NEW_NOTHROW(name)                                                      \
    void *name(size_t size, const void *nothrow);                              \
    void *name(size_t size, const void *nothrow)                               \
    {                                                                          \
        REAL(void *, name, size_t, const void *)                               \
        return __asan_init && ALLOCATION_FAILS() ? NULL : real(size, nothrow); \
    }
NEW_NOTHROW(_ZnwmRKSt9nothrow_t)
NEW_NOTHROW(_ZnamRKSt9nothrow_t)

void *mmap(void *at, size_t size, int protection, int flags, int file, off_t offset)
{
    REAL(void *, mmap, void *, size_t, int, int, int, off_t)
    return fails(file < 0 ? MEMORY : READ, ENOMEM)
               ? MAP_FAILED
               : real(at, size, protection, flags, file, offset);
}

// ---- opening

static bool opening_fails(int flags)
{
    bool writes = (flags & O_ACCMODE) != O_RDONLY;
    return fails(writes ? WRITE : READ, writes ? ENOSPC : EMFILE);
}

static mode_t mode_of(int flags, va_list arguments)
{
    return flags & (O_CREAT | __O_TMPFILE) ? va_arg(arguments, mode_t) : 0;
}

#define OPEN(name)                                                  \
    int name(const char *file, int flags, ...)                      \
    {                                                               \
        REAL(int, name, const char *, int, ...)                     \
        va_list arguments;                                          \
        va_start(arguments, flags);                                 \
        mode_t mode = mode_of(flags, arguments);                    \
        va_end(arguments);                                          \
        return opening_fails(flags) ? -1 : real(file, flags, mode); \
    }
OPEN(open)
OPEN(open64)

int openat(int folder, const char *file, int flags, ...)
{
    REAL(int, openat, int, const char *, int, ...)
    va_list arguments;
    va_start(arguments, flags);
    mode_t mode = mode_of(flags, arguments);
    va_end(arguments);
    return opening_fails(flags) ? -1 : real(folder, file, flags, mode);
}

#define FOPEN(name)                                                                       \
    FILE *name(const char *file, const char *how)                                         \
    {                                                                                     \
        REAL(FILE *, name, const char *, const char *)                                    \
        return opening_fails(*how == 'r' ? O_RDONLY : O_WRONLY) ? NULL : real(file, how); \
    }
FOPEN(fopen)
FOPEN(fopen64)

DIR *opendir(const char *folder)
{
    REAL(DIR *, opendir, const char *)
    return fails(READ, EMFILE) ? NULL : real(folder);
}

int memfd_create(const char *name, unsigned flags)
{
    REAL(int, memfd_create, const char *, unsigned)
    return fails(WRITE, EMFILE) ? -1 : real(name, flags);
}

// ---- reading

#define STREAM_ERROR 0x20 // _IO_ERR_SEEN: what ferror tells

static bool stream_fails(FILE *stream, int family)
{
    bool failed = stream != stderr && fails(family, family == READ ? EIO : ENOSPC);
    if (failed) {
        stream->_flags |= STREAM_ERROR;
    }
    return failed;
}

ssize_t read(int file, void *bytes, size_t size)
{
    REAL(ssize_t, read, int, void *, size_t)
    return fails(READ, EIO) ? -1 : real(file, bytes, size);
}

#define PREAD(name)                                                     \
    ssize_t name(int file, void *bytes, size_t size, off_t offset)      \
    {                                                                   \
        REAL(ssize_t, name, int, void *, size_t, off_t)                 \
        return fails(READ, EIO) ? -1 : real(file, bytes, size, offset); \
    }
PREAD(pread)
PREAD(pread64)

size_t fread(void *bytes, size_t size, size_t count, FILE *stream)
{
    REAL(size_t, fread, void *, size_t, size_t, FILE *)
    return stream_fails(stream, READ) ? 0 : real(bytes, size, count, stream);
}

size_t __fread_chk(void *bytes, size_t room, size_t size, size_t count, FILE *stream);
size_t __fread_chk(void *bytes, size_t room, size_t size, size_t count, FILE *stream)
{
    REAL(size_t, __fread_chk, void *, size_t, size_t, size_t, FILE *)
    return stream_fails(stream, READ) ? 0 : real(bytes, room, size, count, stream);
}

char *fgets(char *text, int size, FILE *stream)
{
    REAL(char *, fgets, char *, int, FILE *)
    return stream_fails(stream, READ) ? NULL : real(text, size, stream);
}

#define GETC(name)                                              \
    int name(FILE *stream)                                      \
    {                                                           \
        REAL(int, name, FILE *)                                 \
        return stream_fails(stream, READ) ? EOF : real(stream); \
    }
#undef getc
GETC(getc)
GETC(fgetc)

int __isoc99_fscanf(FILE *stream, const char *format, ...);
int __isoc99_fscanf(FILE *stream, const char *format, ...)
{
    if (stream_fails(stream, READ)) {
        return EOF;
    }
    va_list arguments;
    va_start(arguments, format);
    int done = vfscanf(stream, format, arguments);
    va_end(arguments);
    return done;
}

struct dirent *readdir(DIR *folder)
{
    REAL(struct dirent *, readdir, DIR *)
    return fails(READ, EIO) ? NULL : real(folder);
}

// ---- writing

ssize_t write(int file, const void *bytes, size_t size)
{
    REAL(ssize_t, write, int, const void *, size_t)
    return file != STDERR_FILENO && fails(WRITE, ENOSPC) ? -1 : real(file, bytes, size);
}

#define PWRITE(name)                                                        \
    ssize_t name(int file, const void *bytes, size_t size, off_t offset)    \
    {                                                                       \
        REAL(ssize_t, name, int, const void *, size_t, off_t)               \
        return fails(WRITE, ENOSPC) ? -1 : real(file, bytes, size, offset); \
    }
PWRITE(pwrite)
PWRITE(pwrite64)

size_t fwrite(const void *bytes, size_t size, size_t count, FILE *stream)
{
    REAL(size_t, fwrite, const void *, size_t, size_t, FILE *)
    return stream_fails(stream, WRITE) ? 0 : real(bytes, size, count, stream);
}

int fputs(const char *text, FILE *stream)
{
    REAL(int, fputs, const char *, FILE *)
    return stream_fails(stream, WRITE) ? EOF : real(text, stream);
}

#define PUTC(name)                                                  \
    int name(int c, FILE *stream)                                   \
    {                                                               \
        REAL(int, name, int, FILE *)                                \
        return stream_fails(stream, WRITE) ? EOF : real(c, stream); \
    }
#undef putc
PUTC(putc)
PUTC(fputc)

int puts(const char *text)
{
    REAL(int, puts, const char *)
    return stream_fails(stdout, WRITE) ? EOF : real(text);
}

// printf's functions as -D_FORTIFY_SOURCE calls them: to the stream, with the further parameters.
#define PRINTF(name, to, ...)                                                      \
    int name(__VA_ARGS__ int flag, const char *format, ...);                       \
    int name(__VA_ARGS__ int flag, const char *format, ...)                        \
    {                                                                              \
        (void)flag;                                                                \
        va_list arguments;                                                         \
        va_start(arguments, format);                                               \
        int done = stream_fails(to, WRITE) ? -1 : vfprintf(to, format, arguments); \
        va_end(arguments);                                                         \
        return done;                                                               \
    }
#define OF_STREAM FILE *stream,
PRINTF(__fprintf_chk, stream, OF_STREAM)
PRINTF(__printf_chk, stdout)

int fflush(FILE *stream)
{
    REAL(int, fflush, FILE *)
    return stream && stream_fails(stream, WRITE) ? EOF : real(stream);
}

int fsync(int file)
{
    REAL(int, fsync, int)
    return fails(WRITE, EIO) ? -1 : real(file);
}

// As on a network's file system: the file is closed, but what was written is lost.
int close(int file)
{
    REAL(int, close, int)
    int flags = fcntl(file, F_GETFL);
    bool writes = flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
    bool failed = writes && fails(WRITE, EIO);
    int reason = errno, done = real(file);
    if (failed) {
        errno = reason;
    }
    return failed ? -1 : done;
}

int rename(const char *from, const char *to)
{
    REAL(int, rename, const char *, const char *)
    return fails(WRITE, EIO) ? -1 : real(from, to);
}

int link(const char *from, const char *to)
{
    REAL(int, link, const char *, const char *)
    return fails(WRITE, EIO) ? -1 : real(from, to);
}

int linkat(int from_folder, const char *from, int to_folder, const char *to, int flags)
{
    REAL(int, linkat, int, const char *, int, const char *, int)
    return fails(WRITE, EIO) ? -1 : real(from_folder, from, to_folder, to, flags);
}

int mkdir(const char *folder, mode_t mode)
{
    REAL(int, mkdir, const char *, mode_t)
    return fails(WRITE, ENOSPC) ? -1 : real(folder, mode);
}

// ---- processes and threads

pid_t fork(void)
{
    REAL(pid_t, fork, void)
    return fails(PROCESS, EAGAIN) ? -1 : real();
}

int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*work)(void *), void *data)
{
    REAL(int, pthread_create, pthread_t *, const pthread_attr_t *, void *(*)(void *), void *)
    if (fails(PROCESS, EAGAIN)) {
        return EAGAIN;
    }
    quiet++; // its stack; a thread for which there is none fails in the same way
    int done = real(thread, how, work, data);
    quiet--;
    return done;
}

// ---- when to count

// of LeakSanitizer
void __lsan_disable(void) __attribute__((weak));
void __lsan_enable(void) __attribute__((weak));

void *dlopen(const char *file, int how)
{
    REAL(void *, dlopen, const char *, int)
    quiet++;
    if (__lsan_disable) { // what the loader keeps, and constructors of outside libraries
        __lsan_disable();
    }
    void *library = real(file, how);
    if (__lsan_enable) {
        __lsan_enable();
    }
    quiet--;
    return library;
}

static int (*real_main)(int, char **, char **);
int __lsan_do_recoverable_leak_check(void) __attribute__((weak)); // of AddressSanitizer

static int counted_main(int argc, char **argv, char **environment)
{
    atomic_store(&fault.counting, true);
    int status = real_main(argc, argv, environment);
    atomic_store(&fault.counting, false);
    return status;
}

static void *map_file(const char *file, size_t size)
{
    int opened = file ? open(file, O_RDWR | O_CLOEXEC) : -1;
    void *mapped =
        opened >= 0 ? mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0) : MAP_FAILED;
    if (opened >= 0) {
        close(opened);
    }
    return mapped != MAP_FAILED ? mapped : NULL;
}

static void choose(const char *what)
{
    fault.family = -1;
    for (int i = 0; what && i < FAMILIES; i++) {
        size_t length = strlen(family_name[i]);
        if (strncmp(what, family_name[i], length) == 0 && what[length] == ':') {
            fault.family = i;
            fault.at = atoll(what + length + 1);
            fault.further = what[strlen(what) - 1] == '+';
        }
    }
    if (what && strcmp(what, "trace") == 0) {
        fault.trace = map_file(getenv("FAULT_TRACE"), sizeof(Trace));
    }
}

// ---- many runs of a program that is loaded once

enum { LONGEST_REQUEST = 8192, MOST_ARGUMENTS = 64, LEAKED = 99 };

static bool serving;

// Within a fork, no destructors: threads of libraries that were loaded before it are not here to be
// waited for.
void exit(int status)
{
    REAL(void, exit, int)
    if (serving) {
        fflush(NULL);
        _exit(status);
    }
    real(status);
    abort();
}

static void redirect(const char *file, int number)
{
    int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (opened < 0 || dup2(opened, number) < 0) {
        _exit(LEAKED + 1);
    }
    close(opened);
}

// The words of a request end with tabs: FAULT, folder to run in, files for stdout and stderr,
// seconds until SIGALRM, arguments.
static _Noreturn void run_request(char *request, char **environment)
{
    char *word[MOST_ARGUMENTS + 1];
    int count = 0;
    for (char *rest = request, *at; count < MOST_ARGUMENTS && (at = strsep(&rest, "\t")) && rest;) {
        word[count++] = at;
    }
    word[count] = NULL;
    if (count < 6 || chdir(word[1]) != 0) {
        _exit(LEAKED + 1);
    }
    redirect("/dev/null", STDIN_FILENO);
    redirect(word[2], STDOUT_FILENO);
    redirect(word[3], STDERR_FILENO);
    alarm((unsigned)atoi(word[4]));
    choose(word[0]);
    int status = counted_main(count - 5, word + 5, environment);
    exit(__lsan_do_recoverable_leak_check && __lsan_do_recoverable_leak_check() ? LEAKED : status);
}

static int serve(char **environment)
{
    char request[LONGEST_REQUEST];
    while (fgets(request, sizeof request, stdin)) {
        pid_t child = fork();
        if (child == 0) {
            serving = true;
            run_request(request, environment);
        }
        int status = 0;
        waitpid(child, &status, 0);
        printf("%d\n", WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status));
        fflush(stdout);
    }
    return 0;
}

static int begin(int argc, char **argv, char **environment)
{
    const char *plugins = getenv("FAULT_SERVE");
    void *frame;
    backtrace(&frame, 1); // loads the unwinder
    fault.log = map_file(getenv("FAULT_LOG"), sizeof(Log));
    dl_iterate_phdr(find_seccomp, NULL);
    if (!plugins) {
        choose(getenv("FAULT"));
        return counted_main(argc, argv, environment);
    }
    char *list = strdup(plugins), *rest = list, *one;
    while ((one = strsep(&rest, ":"))) {
        if (*one && !dlopen(one, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE)) {
            fprintf(stderr, "%s\n", dlerror());
            return LEAKED + 1;
        }
    }
    free(list);
    return serve(environment);
}

int __libc_start_main(int (*program)(int, char **, char **), int argc, char **argv,
                      void (*init)(void), void (*fini)(void), void (*loader_fini)(void),
                      void *stack);
int __libc_start_main(int (*program)(int, char **, char **), int argc, char **argv,
                      void (*init)(void), void (*fini)(void), void (*loader_fini)(void),
                      void *stack)
{
    REAL(int, __libc_start_main, int (*)(int, char **, char **), int, char **, void (*)(void),
         void (*)(void), void (*)(void), void *)
    unsetenv("LD_PRELOAD"); // for this program alone
    real_main = program;
    return real(begin, argc, argv, init, fini, loader_fini, stack);
}
