// Man pages and shell completions, generated from the tables of commands and options.
#ifndef RAMIFY_CLI_MANUAL_H
#define RAMIFY_CLI_MANUAL_H

#include "cli/option_table.h"

// Prints the page of a command or, if program, of ramify itself, in mdoc(7).
void manual_print(CommandId command, bool program);

#endif
