// OpenVDB files, as they are read in the child process: as a mesh, as a volume, or as a cloud.
#include "fuzz.h"
#include "shape/vdb.h"

extern const VdbReaders vdb_readers;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1 || size > 1 << 16) {
        return -1;
    }
    const char *file = fuzz_file(".vdb", data + 1, size - 1);
    Error e = {0};
    if ((data[0] & 3) == 2) {
        sparse_volume_free(vdb_readers.sparse(file, NULL, &e));
        vdb_readers.sparse_bytes(file, NULL, &e);
    } else if (data[0] & 1) {
        volume_free(vdb_readers.volume(file, NULL, &e));
    } else {
        mesh_free(vdb_readers.surface(file, &e));
    }
    unlink(file);
    return 0;
}
