// ramify schema: prints the scene file's schema, for editors, readers and shells.
#include "cli/command.h"

#include <stdio.h>

bool command_schema(const Options *options, RamifyError *e)
{
    char *text = options->markdown ? ramify_schema_markdown(e)
                 : options->paths  ? ramify_schema_paths(e)
                                   : ramify_schema(e);
    if (!text) {
        return false;
    }
    fputs(text, stdout);
    ramify_free(text);
    return true;
}
