#include "base/file_name.h"

#include <string.h>
#include <strings.h>

const char *file_name_ending(const char *file)
{
    const char *dot = strrchr(file, '.'), *slash = strrchr(file, '/');
    return dot && (!slash || dot > slash) ? dot : "";
}

bool file_name_ends(const char *file, const char *ending)
{
    size_t length = strlen(file), own = strlen(ending);
    return length > own && strcasecmp(file + length - own, ending) == 0;
}
