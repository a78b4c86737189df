// Exits early when memory is too short for the libraries' initialisation. Two of them allocate in
// constructors and then end the process by an exception that cannot be caught: log4cplus (needed by
// OpenVDB) starts four threads, OpenImageIO fills a table of strings. A program's .preinit_array
// runs before its libraries' constructors.
#include <stdio.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#define START_THREADS 4
#define USUAL_STACK ((size_t)2 << 20)  // bytes of a thread's stack if stacks are unlimited
#define START_BYTES ((size_t)48 << 20) // all but the stacks; 29 MB measured

static size_t bytes_to_start(void)
{
    struct rlimit stack;
    size_t each = USUAL_STACK;
    if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY) {
        each = (size_t)stack.rlim_cur;
    }
    return START_THREADS * each + START_BYTES;
}

// Only system calls and functions that need no memory: no library but libc is initialised yet.
static void check_memory(int argc, char **argv, char **environment)
{
    (void)argc, (void)argv, (void)environment;
    size_t bytes = bytes_to_start();
    void *room = mmap(NULL, bytes, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room != MAP_FAILED) {
        munmap(room, bytes);
        return;
    }
    char text[256];
    int length =
        snprintf(text, sizeof text,
                 "ramify: out of memory: its libraries need %zu MB more to start; a higher "
                 "limit on memory (ulimit -v, -d) would be right\n",
                 bytes / 1000000);
    ssize_t written = write(STDERR_FILENO, text, (size_t)length);
    (void)written;
    _exit(1);
}

__attribute__((section(".preinit_array"),
               used)) static void (*const before_libraries)(int, char **, char **) = check_memory;
