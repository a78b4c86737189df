#include "base/key_path.h"

#include <stdbool.h>
#include <string.h>

const char *key_path_end(const char *path)
{
    const char *end = path + strlen(path);
    bool is_number = true; // of a list's entry, which tells nothing alone
    while (end > path && (end[-1] != '.' || is_number)) {
        end--;
        is_number = is_number && (*end == '.' || (*end >= '0' && *end <= '9'));
    }
    return end;
}
