// ramify schema: the JSON Schema of scene files.
#include "cli/command.h"

#include <stdio.h>

bool command_schema(const Options *options, RamifyError *e)
{
    (void)options;
    char *text = ramify_schema(e);
    if (!text) {
        return false;
    }
    fputs(text, stdout);
    ramify_free(text);
    return true;
}
