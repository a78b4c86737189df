// Skeletons: SWC files, or TreeQSM's tables if the first byte is a Q (which is then left out).
#include "fuzz.h"
#include "outtree/out_tree_io.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bool table = size > 0 && data[0] == 'Q';
    // An empty stream opens too.
    FILE *stream = fmemopen((void *)(uintptr_t)(data + table), size - table, "r");
    if (!stream) {
        abort();
    }
    Error e = {0};
    out_tree_free(table ? out_tree_parse_qsm(stream, "fuzz.qsm", &e)
                        : out_tree_parse_swc(stream, "fuzz.swc", &e));
    fclose(stream);
    return 0;
}
