// Skeletons: SWC files, or TreeQSM's tables if the first byte is a Q (which is then left out).
#include "fuzz.h"
#include "outtree/out_tree_io.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bool table = size > 0 && data[0] == 'Q';
    const char *file = fuzz_file(table ? ".qsm" : ".swc", data + table, size - table);
    Error e = {0};
    out_tree_free(table ? out_tree_read_qsm(file, &e) : out_tree_read_swc(file, &e));
    unlink(file);
    return 0;
}
