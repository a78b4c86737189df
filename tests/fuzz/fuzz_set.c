// Overrides as of --set, one a line, on a scene with most kinds of values.
#include "fuzz.h"
#include "scene/scene.h"

#include <string.h>

static const char SCENE[] =
    "seed: 3\n"
    "camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}\n"
    "film: {width: 32, height: 24, crop: [0, 0, 1, 1]}\n"
    "materials:\n  - {name: a, kind: principled, color: [0.1, 0.2, 0.3], pattern: bark}\n"
    "lights:\n  - {kind: sphere, position: [0, 3, 0], radius: 0.1, radiance: 20}\n"
    "objects:\n"
    "  - name: oak\n    material: a\n    tree: {height: 3, leaves: {max_count: 50}}\n"
    "  - {name: ball, shape: {envelope: [{shape: sphere, size: [0.2, 0.3, 0.2]}]}}\n"
    "  - {name: frost, frost: {fields: [{kind: nuclei, turn: 90}]}}\n"
    "targets:\n  - {object: oak, measure: branch_angle, low: 30, high: 70}\n";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { MOST = 8 };
    const char *lines[MOST];
    int count = 0;
    char *text = fuzz_text(data, size), *rest = text;
    while (count < MOST && rest) {
        lines[count++] = strsep(&rest, "\n");
    }
    Error e = {0};
    scene_free(scene_read_text(SCENE, strlen(SCENE), "fuzz.yaml", "", lines, count, &e));
    free(text);
    return 0;
}
