// Texts of the man pages beyond the tables of commands and options.
#ifndef RAMIFY_CLI_MANUAL_TEXT_H
#define RAMIFY_CLI_MANUAL_TEXT_H

// Fixed, so that a page does not change with the day it is built.
#define MANUAL_DATE "November 21, 2026"

typedef struct ManualExample {
    const char *what;    // a phrase
    const char *command; // a shell command line; pine.yaml is the reader's scene
} ManualExample;

typedef struct ManualText {
    const char *command; // name of the command; "" = the program itself
    const char *paragraphs[6];
    const char *failure; // further conditions for exit status 1; NULL = only errors
    ManualExample examples[8];
} ManualText;

// The texts of a command, or of the program (""); NULL if there are none.
const ManualText *manual_text(const char *command);

#endif
