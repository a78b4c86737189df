#include "base/plugin.h"

#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

// Two libraries allocate in constructors and then end the process by an exception that cannot be
// caught: log4cplus (needed by OpenVDB) starts four threads, OpenImageIO fills a table of strings.
// So nothing is loaded unless there is room for the largest plug-in, whose files take 440 MB of
// address space, 100 MB of which are written.
#define START_THREADS 4
#define USUAL_STACK ((size_t)2 << 20) // bytes of a thread's stack if stacks are unlimited
#define START_BYTES ((size_t)512 << 20)
#define START_DATA ((size_t)128 << 20)

static bool memory_to_load(const char *file, Error *e)
{
    struct rlimit stack;
    size_t stacks = START_THREADS * USUAL_STACK;
    if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY) {
        stacks = START_THREADS * (size_t)stack.rlim_cur;
    }
    size_t bytes = stacks + START_BYTES;
    void *room = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    bool fits = room != MAP_FAILED;
    if (fits) { // what can be written counts toward the limit on data
        fits = mprotect(room, stacks + START_DATA, PROT_READ | PROT_WRITE) == 0;
        munmap(room, bytes);
    }
    return fits ||
           error_set(e, ERROR_MEMORY,
                     "out of memory: the libraries of %s need %zu MB more to start; a higher limit "
                     "on memory (ulimit -v, -d) would be right",
                     file, bytes / 1000000);
}

// The folders where the loader looks for what this program or library needs, its RUNPATH among
// them; free() them. dlopen searches the RUNPATH of its caller, which is AddressSanitizer in a
// sanitized build, so open_file searches them itself.
static Dl_serinfo *search_path(void)
{
    static const char here = 0;
    Dl_info info;
    struct link_map *own = NULL;
    Dl_serinfo size;
    if (!dladdr1(&here, &info, (void **)&own, RTLD_DL_LINKMAP) || !own ||
        dlinfo(own, RTLD_DI_SERINFOSIZE, &size) != 0) {
        return NULL;
    }
    Dl_serinfo *path = malloc(size.dls_size);
    if (path &&
        (dlinfo(own, RTLD_DI_SERINFOSIZE, path) != 0 || dlinfo(own, RTLD_DI_SERINFO, path) != 0)) {
        free(path);
        return NULL;
    }
    return path;
}

static void *open_file(const char *file)
{
    char found[PATH_MAX];
    snprintf(found, sizeof found, "%s", file);
    Dl_serinfo *path = search_path();
    for (unsigned i = 0; path && i < path->dls_cnt; i++) {
        char name[PATH_MAX];
        snprintf(name, sizeof name, "%s/%s", path->dls_serpath[i].dls_name, file);
        if (access(name, R_OK) == 0) {
            snprintf(found, sizeof found, "%s", name);
            break;
        }
    }
    free(path);
    // It stays loaded after dlclose, because threads of its libraries may outlive their work.
    return dlopen(found, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
}

static void *load(const char *file, Error *e)
{
    void *handle = dlopen(file, RTLD_LAZY | RTLD_LOCAL | RTLD_NOLOAD);
    if (handle || !memory_to_load(file, e)) {
        return handle;
    }
    handle = open_file(file);
    if (!handle) {
        error_set(e, ERROR_INPUT,
                  "a part of ramify cannot be loaded (%s); %s must lie beside the program or in "
                  "lib/ramify: install ramify anew",
                  dlerror(), file);
    }
    return handle;
}

const void *plugin_table(const char *plugin, const char *table, size_t size, Error *e)
{
    char file[64];
    snprintf(file, sizeof file, "ramify-%s.so", plugin);
    void *handle = load(file, e);
    if (!handle) {
        return NULL;
    }
    const size_t *found = dlsym(handle, table);
    dlclose(handle);
    if (!found || *found != size) {
        error_set(e, ERROR_INPUT, "%s belongs to another build of ramify; install ramify anew",
                  file);
        return NULL;
    }
    return found;
}
