// Grids of heights: Esri's ASCII grids.
#include "fuzz.h"
#include "land/height_measure.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *file = fuzz_file(".asc", data, size);
    Error e = {0};
    height_field_free(height_field_read_asc(file, &e));
    unlink(file);
    return 0;
}
