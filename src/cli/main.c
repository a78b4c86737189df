// The ramify command: parses the command line, runs one command, reports what went wrong.
#include "cli/command.h"
#include "cli/manual.h"

#include <stdio.h>

static int exit_status(const RamifyError *e)
{
    switch (e->code) {
    case RAMIFY_BAD_INPUT:
        return 2;
    case RAMIFY_CANCELLED:
        return 130;
    default:
        return 1;
    }
}

static int report(const RamifyError *e)
{
    char text[1200];
    ramify_error_format(e, text, sizeof text);
    // "file:line:column: ..." begins the line, so that editors recognise it
    fprintf(stderr, "%s%s\n", e->file[0] ? "" : "ramify: ", text);
    return exit_status(e);
}

static bool help(const Options *options, RamifyError *e)
{
    CommandId command = options->command;
    if (options->operand && command == COMMAND_HELP) {
        command = command_by_name(options->operand);
    }
    if (command == COMMAND_COUNT) {
        return options_unknown_command(options->operand, e);
    }
    if (options->man) {
        manual_print(command, !options->operand);
    } else {
        options_print_help(command);
    }
    return true;
}

static bool run_command(const Options *options, RamifyError *e)
{
    switch (options->command) {
    case COMMAND_RENDER:
        return command_render(options, e);
    case COMMAND_TURNTABLE:
        return command_turntable(options, e);
    case COMMAND_GROW:
        return command_grow(options, e);
    case COMMAND_MEASURE:
        return command_measure(options, e);
    case COMMAND_EXPORT:
        return command_export(options, e);
    case COMMAND_COMPARE:
        return command_compare(options, e);
    case COMMAND_GOLDEN:
        return command_golden(options, e);
    case COMMAND_INFO:
        return command_info(options, e);
    case COMMAND_COMPLETION:
        return command_completion(options, e);
    default:
        return command_schema(options, e);
    }
}

int main(int argc, char **argv)
{
    Options options;
    bool version;
    RamifyError e = {0};
    if (!options_parse(&options, argc, argv, &version, &e)) {
        return report(&e);
    }
    bool helps = options.help || options.command == COMMAND_HELP;
    if (version) {
        printf("ramify %s\n", ramify_version());
    } else if (!(helps ? help(&options, &e) : run_command(&options, &e))) {
        return report(&e);
    }
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fprintf(stderr, "ramify: cannot write to stdout\n");
        return 1;
    }
    return 0;
}
