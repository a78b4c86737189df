// Scene files, from the text to the checked scene.
#include "fuzz.h"
#include "scene/scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Error e = {0};
    scene_free(scene_read_text((const char *)data, size, "fuzz.yaml", "", NULL, 0, &e));
    return 0;
}
