// Meshes, as they are read in the child process. The first byte selects the format.
#include "fuzz.h"
#include "shape/import_read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const endings[] = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    if (size < 1 || size > 1 << 16) {
        return -1;
    }
    const char *file = fuzz_file(endings[data[0] % 5], data + 1, size - 1);
    fuzz_task(import_read, &(ImportJob){.file = file}, file);
    return 0;
}
