// ramify species: prints the library of species.
#include "cli/command.h"

#include <stdio.h>

bool command_species(const Options *options, RamifyError *e)
{
    (void)options;
    char *text = ramify_species(e);
    if (!text) {
        return false;
    }
    fputs(text, stdout);
    ramify_free(text);
    return true;
}
