// What the man pages say beyond the tables of commands and options.
#ifndef RAMIFY_CLI_MANUAL_TEXT_H
#define RAMIFY_CLI_MANUAL_TEXT_H

// Of a page that does not change with the day it is built on.
#define MANUAL_DATE "November 21, 2026"

typedef struct ManualExample {
    const char *what;    // a phrase
    const char *command; // a line for the shell; pine.yaml is the reader's scene
} ManualExample;

typedef struct ManualText {
    const char *command; // its name; "" = the program itself
    const char *paragraphs[6];
    const char *failure; // when else it ends with status 1; NULL = only when something failed
    ManualExample examples[6];
} ManualText;

// The texts of a command, or of the program (""); NULL = there are none.
const ManualText *manual_text(const char *command);

#endif
