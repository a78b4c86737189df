// ramify schema: the JSON Schema of scene files.
#include "cli/command.h"

#include <stdio.h>
#include <stdlib.h>

bool command_schema(const Options *options, Error *e)
{
    (void)options;
    char *text = scene_schema_json(e);
    if (!text) {
        return false;
    }
    fputs(text, stdout);
    free(text);
    return true;
}
