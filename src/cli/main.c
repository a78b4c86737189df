// The ramify command: parses the command line, runs one command, reports errors.
#include "cli/command.h"
#include "cli/last_words.h"
#include "cli/option_table.h"

#include <stdio.h>

// Of the Makefile: the commit that was compiled, "-dirty" behind it if files were changed since, or
// "unknown".
extern const char program_commit[];

static void print_version(void)
{
    char libraries[1024];
    ramify_libraries(libraries, sizeof libraries);
    printf("ramify %s\ncommit %s\nbuilt with %s\n", ramify_version(), program_commit, libraries);
}

// Prints the error and returns the exit status.
static int report(const RamifyError *e)
{
    char text[1200];
    ramify_error_format(e, text, sizeof text);
    // "file:line:column: ..." begins the line, so that editors recognise it
    fprintf(stderr, "%s%s\n", e->file[0] ? "" : "ramify: ", text);
    return e->code == RAMIFY_BAD_INPUT ? 2 : (e->code == RAMIFY_CANCELLED ? 130 : 1);
}

int main(int argc, char **argv)
{
    Options options;
    RamifyError e = {0};
    last_words_begin();
    bool done = options_parse(&options, argc, argv, &e);
    if (done && options.version) {
        print_version();
    } else if (done) {
        const Command *command = &command_table[options.help ? COMMAND_HELP : options.command];
        done = command->run(&options, &e);
    }
    if (done && (fflush(stdout) != 0 || ferror(stdout))) {
        done = fail(&e, RAMIFY_IO, "cannot write to stdout");
    }
    return done ? 0 : report(&e);
}
