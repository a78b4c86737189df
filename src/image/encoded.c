#include "image/encoded.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

bool encoded_reserve(Encoded *encoded, size_t more, Error *e)
{
    return memory_reserve(&encoded->bytes, &encoded->room, encoded->size + (int64_t)more, 1, e);
}

bool encoded_append(Encoded *encoded, const void *bytes, size_t size, Error *e)
{
    if (!encoded_reserve(encoded, size, e)) {
        return false;
    }
    memcpy(encoded->bytes + encoded->size, bytes, size);
    encoded->size += (int64_t)size;
    return true;
}

void encoded_clear(Encoded *encoded)
{
    free(encoded->bytes);
    *encoded = (Encoded){0};
}
