// Grids of heights: Esri's ASCII grids.
#include "fuzz.h"
#include "land/height_measure.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = fuzz_text(data, size);
    Error e = {0};
    height_field_free(height_field_parse_asc(text, "fuzz.asc", &e));
    free(text);
    return 0;
}
