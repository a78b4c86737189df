#include "cli/batch/program.h"

#include "cli/fail.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Reads until the end; keeps the beginning.
static void read_all(int file, char *said, size_t size)
{
    char rest[4096] = "";
    size_t used = 0;
    for (ssize_t count = 1; count != 0;) {
        bool fits = used + 1 < size;
        count = read(file, fits ? said + used : rest, fits ? size - 1 - used : sizeof rest);
        if (count < 0 && errno != EINTR) {
            break;
        }
        used += fits && count > 0 ? (size_t)count : 0;
    }
    while (used > 0 && said[used - 1] == '\n') {
        used--;
    }
    said[used] = 0;
}

bool program_run(char *const argv[], char *said, size_t size, RamifyError *e)
{
    int ends[2];
    pid_t process;
    posix_spawn_file_actions_t actions;
    if (pipe2(ends, O_CLOEXEC) != 0 || posix_spawn_file_actions_init(&actions) != 0) {
        return fail(e, RAMIFY_IO, "'%s' cannot be started: %s", argv[0], strerror(errno));
    }
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    int reason = posix_spawnp(&process, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    int status = -1;
    if (reason == 0) {
        read_all(ends[0], said, size);
        while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
        }
    }
    close(ends[0]);
    if (reason != 0) {
        return fail(e, reason == ENOENT ? RAMIFY_BAD_INPUT : RAMIFY_IO,
                    "'%s' cannot be started: %s; is it installed here?", argv[0], strerror(reason));
    }
    return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
           fail(e, RAMIFY_IO, "%s: %s", argv[0], *said ? said : "it failed without a word");
}
