// The tables of commands and options, from which the command line is parsed and the
// help, the man pages and the shells' completions are written.
#ifndef RAMIFY_CLI_OPTION_TABLE_H
#define RAMIFY_CLI_OPTION_TABLE_H

#include "cli/options.h"

#include <stddef.h>

typedef enum OptionType {
    OPTION_YES,   // bool
    OPTION_NO,    // bool, of a scene_key alone
    OPTION_INT,   // int
    OPTION_REAL,  // double
    OPTION_TEXT,  // const char *
    OPTION_SIZE,  // WxH: width and height of the scene_key
    OPTION_CROP,  // x0,y0,x1,y1, of a scene_key
    OPTION_KEYS,  // RamifyKeys, a:b:c
    OPTION_SET,   // path=value, may be repeated
    OPTION_OBJECT // name, may be repeated
} OptionType;

typedef struct Option {
    const char *name;  // without the dashes
    const char *value; // as the help calls it: NULL = takes none, FILE and DIR are such, else free
    const char *choices;   // words that it may be, parted by blanks; NULL = anything
    size_t offset;         // in Options; not used where there is a scene_key
    const char *scene_key; // the key of the scene that it stands for; NULL = none
    double low, high;
    const char *doc; // parts "; COMMAND: ..." are of that command alone
    OptionType type;
    unsigned commands;
    char letter; // 0 = none
} Option;

typedef struct Command {
    const char *name;
    const char *operand; // "SCENE", "[COMMAND]", ...; "" = none
    const char *doc, *more;
} Command;

// Options in the order of the help, index from 0; NULL after the last.
const Option *option_at(int index);

bool option_is_of(const Option *option, CommandId command);

// What the option does for this command, as a phrase, in text.
void option_doc(const Option *option, CommandId command, char *text, size_t size);

// Puts what text says where the option goes. RAMIFY_BAD_INPUT when it is no value of the option.
bool option_take(Options *options, const Option *option, const char *text, RamifyError *e);
void option_take_flag(Options *options, const Option *option); // of an option without value

const Command *command_at(CommandId command); // command < COMMAND_COUNT

#endif
