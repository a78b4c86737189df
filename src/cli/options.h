// The command line, parsed by the table of options (option_table.c).
#ifndef RAMIFY_CLI_OPTIONS_H
#define RAMIFY_CLI_OPTIONS_H

#include "ramify.h"

#define MAX_OVERRIDES 256
#define MAX_OBJECTS 64
#define MAX_VARIED 32
#define MAX_DIRECTIVES 32

enum { MAX_KEYS = 16, MAX_KEY_TEXT = 160, MAX_OPTIONS = 96 };

typedef enum CommandId {
    COMMAND_RENDER,
    COMMAND_TURNTABLE,
    COMMAND_GROW,
    COMMAND_MEASURE,
    COMMAND_FIT,
    COMMAND_EXPORT,
    COMMAND_MERGE,
    COMMAND_DEVELOP,
    COMMAND_BATCH,
    COMMAND_REPLAY,
    COMMAND_COMPARE,
    COMMAND_GOLDEN,
    COMMAND_INFO,
    COMMAND_SPECIES,
    COMMAND_SCHEMA,
    COMMAND_COMPLETION,
    COMMAND_HELP,
    COMMAND_COUNT
} CommandId;

// The parsed command line. Options that set keys of the scene become overrides; for the others
// option_given tells whether they are present.
typedef struct Options {
    CommandId command;
    const char *operand;         // SCENE, or the command to explain; NULL = none
    const char *second;          // second operand of compare; NULL = none
    const char *const *operands; // all of them: the parts to merge
    int operand_count;
    const char *output;                   // NULL = the command's default
    const char *overrides[MAX_OVERRIDES]; // of --set
    int override_count;
    char keys[MAX_KEYS][MAX_KEY_TEXT]; // overrides by other options; applied last
    int key_count;
    bool given[MAX_OPTIONS]; // [i]: option_table[i] is present
    int threads;             // 0 = all processors
    bool quiet, json, resolved, help, version, no_preview;
    bool markdown, paths;                    // output format of schema and info
    bool estimate;                           // info
    bool targets;                            // measure: only objects that targets name
    bool man;                                // help: print the man page
    bool spin, vary_noise;                   // turntable
    const char *isa;                         // NULL = the best available; golden: its own
    double max_rmse, threshold, max_failing; // compare and golden
    bool update, exact, statistical;         // golden
    int series;                              // golden; 0 = the first
    const char *report, *junit, *filter;     // NULL = none
    const char *objects[MAX_OBJECTS];        // to export
    int object_count;                        // 0 = all
    const char *varied[MAX_VARIED];          // fit: PATH=LOW:HIGH
    int vary_count;
    const char *until, *picture;    // fit; NULL = the default, none
    int evaluations;                // fit; 0 = the default
    const char *instances, *colors; // NULL = the format's own
    const char *tile;               // grow, of land: X,Y or ranges of them; NULL = the whole
    const char *map;                // grow, of land; NULL = its heights
    int tube_sides;                 // 0 = the default
    int end;                        // the last frame to render
    bool resume;                    // render
    int add_samples;                // render
    double checkpoint;              // s; render
    double memory;                  // bytes; 0 = no limit
    const char *pixel;              // replay; NULL = none
    int sample;                     // replay
    int frame;                      // the single frame to render
    double time;                    // likewise, by time
    const char *tiles, *range, *engine,
        *folder;                            // batch; NULL = none, none, local, beside the output
    const char *parts;                      // batch run: the parts of one task
    const char *partition, *account;        // batch, Slurm's; NULL = its default
    const char *directives[MAX_DIRECTIVES]; // batch, Slurm's
    int directive_count;
    int jobs, pack; // batch; 0 = the default
    int sample_ranges;
    double turns;
    const char *ease;          // NULL = default
    RamifyTurntable turntable; // remaining turntable options
} Options;

// Parses argv[1..]. RAMIFY_BAD_INPUT names what is wrong and what would be right. --help and
// --version without a command set command to COMMAND_HELP.
bool options_parse(Options *options, int argc, char **argv, RamifyError *e);

// Whether the option of this name, without dashes, is present.
bool option_given(const Options *options, const char *name);

// The command of this name; COMMAND_COUNT if there is none.
CommandId command_by_name(const char *name);

// Sets RAMIFY_BAD_INPUT, suggesting a similar command. Returns false.
bool options_unknown_command(const char *name, RamifyError *e);

#endif
