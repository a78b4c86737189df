// Tables of commands and options, from which the command line is parsed and help, man pages and
// completions are generated.
#ifndef RAMIFY_CLI_OPTION_TABLE_H
#define RAMIFY_CLI_OPTION_TABLE_H

#include "cli/options.h"

#include <stddef.h>

typedef enum OptionType {
    OPTION_YES,      // bool
    OPTION_NO,       // bool, only with a scene_key
    OPTION_INT,      // int
    OPTION_REAL,     // double
    OPTION_BYTES,    // double, with K, M, G or T behind it
    OPTION_TEXT,     // const char *
    OPTION_SIZE,     // WxH: width and height of the scene_key
    OPTION_CROP,     // x0,y0,x1,y1, only with a scene_key
    OPTION_SAMPLES,  // A:B: render.first_sample and render.end_sample
    OPTION_KEYS,     // RamifyKeys, a:b:c
    OPTION_SET,      // path=value, repeatable
    OPTION_VARY,     // path=low:high, repeatable
    OPTION_OBJECT,   // name, repeatable
    OPTION_DIRECTIVE // text, repeatable
} OptionType;

typedef struct Option {
    const char *name;  // without the dashes
    const char *value; // name of the value in the help: NULL = takes none; FILE and DIR are paths,
                       // others free
    const char *choices;   // allowed words, separated by blanks; NULL = anything
    size_t offset;         // in Options; unused with a scene_key
    const char *scene_key; // key of the scene that it sets; NULL = none
    double low, high;
    const char *doc; // parts "; COMMAND: ..." apply to that command alone
    OptionType type;
    unsigned commands;
    char letter; // 0 = none
} Option;

typedef struct Command {
    const char *name;
    const char *operand; // "SCENE", "[COMMAND]", ...; "" = none
    const char *doc, *more;
    bool (*run)(const Options *options,
                RamifyError *e); // does the work; see command.h
} Command;

// Options in the order of the help; the last entry has no name.
extern const Option option_table[];
extern const Command command_table[COMMAND_COUNT];

bool option_is_of(const Option *option, CommandId command);

// Writes the option's effect for this command, as a phrase, into text.
void option_doc(const Option *option, CommandId command, char *text, size_t size);

// Parses text (NULL for options without value) and stores it as the option's value.
// RAMIFY_BAD_INPUT for an invalid value.
bool option_take(Options *options, const Option *option, const char *text, RamifyError *e);

#endif
