// Pictures, as they are read in the child process: textures, skies, the films and metadata of
// ramify's own, golden images and stored means and variances. The first byte selects what is read.
#include "fuzz.h"
#include "image/decode.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const names[] = {"R", "albedo.R", "samples.V"};
    if (size < 1 || size > 1 << 16) {
        return -1;
    }
    DecodeKind kind = (DecodeKind)(data[0] % (DECODE_METADATA + 1));
    bool stored = data[0] & 0x80;
    const char *file = fuzz_file(".exr", data + 1, size - 1);
    DecodeJob job = {.file = file,
                     .kind = kind,
                     .layer = stored ? "variance" : "",
                     .channels = "RGB",
                     .names = names,
                     .count = 3,
                     .key = "ramify:settings"};
    fuzz_task(decode_picture, &job, file);
    return 0;
}
