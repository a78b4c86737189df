// The command line: one table of all options (option_table.c) parses it and prints the help.
#ifndef RAMIFY_CLI_OPTIONS_H
#define RAMIFY_CLI_OPTIONS_H

#include "ramify.h"

#define MAX_OVERRIDES 256
#define MAX_OBJECTS 64

enum { MAX_KEYS = 16, MAX_KEY_TEXT = 160 };

typedef enum CommandId {
    COMMAND_RENDER,
    COMMAND_TURNTABLE,
    COMMAND_GROW,
    COMMAND_MEASURE,
    COMMAND_EXPORT,
    COMMAND_COMPARE,
    COMMAND_GOLDEN,
    COMMAND_INFO,
    COMMAND_SCHEMA,
    COMMAND_COMPLETION,
    COMMAND_HELP,
    COMMAND_COUNT
} CommandId;

// What the command line says. Options that stand for keys of the scene become overrides; of the
// others option_given tells whether they are there.
typedef struct Options {
    CommandId command;
    const char *operand;                  // SCENE, or the command to be helped with; NULL = none
    const char *second;                   // operand of compare; NULL = none
    const char *output;                   // NULL = the command's default
    const char *overrides[MAX_OVERRIDES]; // of --set
    int override_count;
    char keys[MAX_KEYS][MAX_KEY_TEXT]; // overrides that other options stand for; they come last
    int key_count;
    uint64_t given; // bit i: option_at(i) is there
    int threads;    // 0 = all processors
    bool quiet, json, resolved, help;
    bool markdown, paths;                    // what schema and info print instead
    bool man;                                // help: the man page
    bool spin, vary_noise;                   // of a turntable
    const char *isa;                         // NULL = the best there is; golden: its own
    double max_rmse, threshold, max_failing; // of compare and golden
    bool update, exact, statistical;         // golden
    int series;                              // golden; 0 = the first
    const char *report, *junit, *filter;     // NULL = none
    const char *objects[MAX_OBJECTS];        // to export
    int object_count;                        // 0 = all
    const char *instances, *colors;          // NULL = the format's own
    int tube_sides;                          // 0 = the default
    int end;                                 // the last frame
    int frame;                               // to be rendered alone
    double time;                             // likewise
    double turns;
    const char *ease;          // NULL = the usual
    RamifyTurntable turntable; // the rest of it
} Options;

// Parses argv[1..]. RAMIFY_BAD_INPUT names what is wrong and what would be right. --help and
// --version set command to COMMAND_HELP and *version.
bool options_parse(Options *options, int argc, char **argv, bool *version, RamifyError *e);

// Is the option of this name, without its dashes, on the command line?
bool option_given(const Options *options, const char *name);

// Prints the help of a command, or of the program when command is COMMAND_HELP, to stdout.
void options_print_help(CommandId command);

// The command of this name; COMMAND_COUNT when there is none.
CommandId command_by_name(const char *name);

// RAMIFY_BAD_INPUT, naming the command that may have been meant. Returns false.
bool options_unknown_command(const char *name, RamifyError *e);

#endif
